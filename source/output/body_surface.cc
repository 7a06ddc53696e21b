#include <supple/output/body_surface.h>

#include <supple/base/gather.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** Where each of these comes to stand when they are sorted. */
    template <class Key>
    std::vector<unsigned int>
    places_when_sorted(const std::vector<Key> &keys)
    {
      std::vector<unsigned int> order(keys.size()), place(keys.size());
      std::iota(order.begin(), order.end(), 0);
      std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
        return keys[a] < keys[b];
      });
      for (unsigned int i = 0; i < order.size(); ++i)
        place[order[i]] = i;
      return place;
    }


    /** The four triangles between the corners and the middles of the edges of a face. */
    std::array<LocalFace, 4>
    quarters(const LocalFace &face, const std::array<unsigned int, 3> &middles)
    {
      std::array<LocalFace, 4> parts;
      parts.fill(face);
      for (unsigned int v = 0; v < 3; ++v)
        parts[v].nodes = {{face.nodes[v], middles[v], middles[(v + 2) % 3]}};
      parts[3].nodes = middles;
      return parts;
    }
  } // namespace


  BodySurface::BodySurface(const Body &body)
    : communicator(body.mesh.communicator)
  {
    find(body);
    gather(body);
  }


  void
  BodySurface::find(const Body &body)
  {
    const DistributedMesh &parts = *body.mesh.parts;
    std::vector<bool> on_surface(body.n_local, false);
    std::vector<unsigned int> material_of(parts.n_cells);
    const auto add = [&](const auto &part, const unsigned int cell_index) {
      const std::array<unsigned int, 3> nodes = {{part.nodes[0], part.nodes[1], part.nodes[2]}};
      for (const unsigned int node : nodes)
        on_surface[node] = true;
      if (part.owned)
        own_triangles.push_back({nodes, cell_index, material_of[cell_index]});
    };
    for (const LocalCell &cell : parts.cells)
      {
        material_of[cell.index] = cell.material_id;
        if (body.mesh.section.plane())
          add(cell, cell.index);
      }
    if (parts.is_quadratic())
      for (std::size_t f = 0; f < parts.faces.size(); ++f)
        for (const LocalFace &part : quarters(parts.faces[f], parts.face_middles[f]))
          add(part, part.cell_index);
    else if (!body.mesh.section.plane())
      for (const LocalFace &face : parts.faces)
        add(face, face.cell_index);
    for (unsigned int node = 0; node < body.n_owned; ++node)
      if (on_surface[node])
        own_nodes.push_back(node);
  }


  void
  BodySurface::gather(const Body &body)
  {
    std::vector<unsigned int> vertices, corners;
    std::vector<float> positions;
    for (const unsigned int node : own_nodes)
      {
        vertices.push_back(body.serial_vertex[node]);
        positions.insert(positions.end(), body.positions[node].begin(), body.positions[node].end());
      }
    std::vector<unsigned int> unsorted_materials;
    for (const Triangle &triangle : own_triangles)
      {
        for (const unsigned int node : triangle.nodes)
          corners.push_back(body.serial_vertex[node]);
        unsorted_materials.push_back(triangle.material);
      }

    vertices           = gathered_on_first(vertices, communicator);
    corners            = gathered_on_first(corners, communicator);
    positions          = gathered_on_first(positions, communicator);
    unsorted_materials = gathered_on_first(unsorted_materials, communicator);
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      sort(vertices, positions, corners, unsorted_materials);
  }


  void
  BodySurface::sort(std::vector<unsigned int> vertices,
                    const std::vector<float> &positions,
                    const std::vector<unsigned int> &corners,
                    const std::vector<unsigned int> &unsorted_materials)
  {
    vertex_place = places_when_sorted(vertices);
    rest.resize(positions.size());
    for (std::size_t i = 0; i < vertices.size(); ++i)
      std::copy_n(&positions[3 * i], 3, &rest[3 * vertex_place[i]]);
    std::sort(vertices.begin(), vertices.end());
    index_in_mesh = vertices;
    std::vector<std::array<unsigned int, 3>> unsorted(corners.size() / 3);
    for (std::size_t i = 0; i < corners.size(); ++i)
      unsorted[i / 3][i % 3] =
        std::lower_bound(vertices.begin(), vertices.end(), corners[i]) - vertices.begin();
    for (std::array<unsigned int, 3> &triangle : unsorted) // deal.II may begin with any of them
      std::rotate(triangle.begin(),
                  std::min_element(triangle.begin(), triangle.end()),
                  triangle.end());
    triangle_place = places_when_sorted(unsorted);
    triangles.resize(unsorted.size());
    materials.resize(unsorted.size());
    for (std::size_t i = 0; i < unsorted.size(); ++i)
      {
        triangles[triangle_place[i]] = unsorted[i];
        materials[triangle_place[i]] = unsorted_materials[i];
      }
  }


  std::vector<float>
  BodySurface::gathered(const Vector &displacement) const
  {
    std::vector<float> nodal;
    nodal.reserve(3 * own_nodes.size());
    for (const unsigned int node : own_nodes)
      for (unsigned int d = 0; d < 3; ++d)
        nodal.push_back(displacement.local_element(3 * node + d));
    nodal = gathered_on_first(nodal, communicator);
    std::vector<float> values(nodal.size());
    for (std::size_t i = 0; i < vertex_place.size(); ++i)
      std::copy_n(&nodal[3 * i], 3, &values[3 * vertex_place[i]]);
    return values;
  }
} // namespace Supple
