#include <supple/mesh/edge_middles.h>

#include <supple/base/error.h>

#include <algorithm>
#include <sstream>

namespace Supple
{
  using namespace dealii;

  void
  add_middles(SerialMesh &mesh, const Bisection::Middle &middle)
  {
    std::vector<std::array<unsigned int, 2>> edges;
    edges.reserve(6 * mesh.cells.size());
    for (const auto &cell : mesh.cells)
      for (const auto &[a, b] : tetrahedron_edges)
        edges.push_back({{std::min(cell[a], cell[b]), std::max(cell[a], cell[b])}});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    mesh.middles.reserve(edges.size());
    for (const auto &ends : edges)
      mesh.middles.push_back({ends, middle(mesh.vertices[ends[0]], mesh.vertices[ends[1]])});
  }


  void
  find_parts_of_middles(SerialMesh &mesh)
  {
    if (mesh.middles.empty())
      return;
    // A vertex that several parts share has the number of the first: the largest of a cell is its
    // own.
    for (SerialMesh::Middle &middle : mesh.middles)
      middle.part = numbers::invalid_unsigned_int;
    for (const auto &cell : mesh.cells)
      {
        unsigned int part = 0;
        for (const unsigned int vertex : cell)
          part = std::max(part, mesh.parts[vertex]);
        for (const auto &[a, b] : tetrahedron_edges)
          {
            unsigned int &of_middle = mesh.middles[mesh.middle(cell[a], cell[b])].part;
            of_middle               = std::min(of_middle, part);
          }
      }
  }


  namespace
  {
    /** dx/dL_k at a place, of which the differences over k make the determinant. */
    std::array<Point<3>, 4>
    slopes(const SerialMesh &mesh, const std::size_t cell, const std::array<double, 4> &L)
    {
      const auto &corners = mesh.cells[cell];
      std::array<Point<3>, 4> slopes;
      for (unsigned int k = 0; k < 4; ++k)
        slopes[k] = (4. * L[k] - 1.) * mesh.vertices[corners[k]];
      for (const auto &[v, w] : tetrahedron_edges)
        {
          const Point<3> &place = mesh.middles[mesh.middle(corners[v], corners[w])].place;
          slopes[v] += 4. * L[w] * place;
          slopes[w] += 4. * L[v] * place;
        }
      return slopes;
    }


    double
    determinant_over_six(const std::array<Point<3>, 4> &slopes)
    {
      return cross_product_3d(slopes[1] - slopes[0], slopes[2] - slopes[0]) *
             (slopes[3] - slopes[0]) / 6.;
    }
  } // namespace


  std::array<double, 14>
  volumes_at_places(const SerialMesh &mesh, const std::size_t cell)
  {
    constexpr double a = 0.58541019662496852, b = 0.13819660112501050;
    std::array<double, 14> volumes;
    for (unsigned int k = 0; k < 4; ++k)
      {
        std::array<double, 4> point{{b, b, b, b}}, vertex{};
        point[k]       = a;
        vertex[k]      = 1.;
        volumes[k]     = determinant_over_six(slopes(mesh, cell, point));
        volumes[4 + k] = determinant_over_six(slopes(mesh, cell, vertex));
      }
    for (unsigned int e = 0; e < 6; ++e)
      {
        std::array<double, 4> middle{};
        for (const unsigned int end : tetrahedron_edges[e])
          middle[end] = 0.5;
        volumes[8 + e] = determinant_over_six(slopes(mesh, cell, middle));
      }
    return volumes;
  }


  double
  quadratic_volume(const SerialMesh &mesh, const std::size_t cell)
  {
    const std::array<double, 14> volumes = volumes_at_places(mesh, cell);
    return 0.25 * (volumes[0] + volumes[1] + volumes[2] + volumes[3]);
  }


  void
  check_middles(const SerialMesh &mesh, const std::string &origin)
  {
    if (mesh.middles.empty())
      return;
    for (std::size_t cell = 0; cell < mesh.cells.size(); ++cell)
      {
        const std::array<double, 14> volumes = volumes_at_places(mesh, cell);
        if (*std::min_element(volumes.begin(), volumes.end()) > 0.)
          continue;
        Point<3> center;
        for (const unsigned int vertex : mesh.cells[cell])
          center += mesh.vertices[vertex] / 4.;
        std::ostringstream text;
        text << origin << ": the curved edges of cell " << cell << ", near (" << center
             << "), fold it: nodes are too far from the middles of their edges (Mesh/Order). A "
                "finer mesh is less curved from cell to cell.";
        throw InputError(text.str());
      }
  }
} // namespace Supple
