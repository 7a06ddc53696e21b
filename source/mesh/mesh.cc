#include <supple/mesh/mesh.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>
#include <supple/base/first_process.h>
#include <supple/mesh/mesh_generators.h>
#include <supple/mesh/mesh_reader.h>
#include <supple/mesh/partition.h>
#include <supple/mesh/patches.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <boost/crc.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <utility>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** Of those vertices that cells have. */
    BoundingBox<3>
    box_around(const SerialMesh &mesh)
    {
      Point<3> low = mesh.vertices[mesh.cells[0][0]], high = low;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (const unsigned int v : mesh.cell_vertices(c))
          for (unsigned int d = 0; d < 3; ++d)
            {
              low[d]  = std::min(low[d], mesh.vertices[v][d]);
              high[d] = std::max(high[d], mesh.vertices[v][d]);
            }
      return BoundingBox<3>({low, high});
    }


    double
    volume_of(const SerialMesh &mesh, const std::size_t cell, const Section &section)
    {
      if (!section.plane())
        return mesh.volume(cell);
      double centroid = 0.;
      for (const unsigned int v : mesh.cell_vertices(cell))
        centroid += mesh.vertices[v][0] / 3.;
      return mesh.volume(cell) * section.thickness_at(centroid);
    }


    /** The same on all machines that read or generate the same mesh. */
    unsigned int
    checksum_of(const SerialMesh &mesh)
    {
      boost::crc_32_type sum;
      const auto add = [&](const auto &values) {
        sum.process_bytes(values.data(), values.size() * sizeof(values[0]));
      };
      add(mesh.vertices);
      add(mesh.cells);
      add(mesh.materials);
      for (const auto &face : mesh.boundary)
        {
          add(face.vertices);
          sum.process_bytes(&face.boundary_id, sizeof(face.boundary_id));
        }
      return sum.checksum();
    }


    /** Boundary ids by expressions: those that the user gives are stronger. */
    void
    assign_boundary_regions(SerialMesh &mesh, const std::string &regions, const std::string &origin)
    {
      for (const std::string &item : Utilities::split_string_list(regions, ';'))
        {
          if (item.empty())
            continue;
          const auto colon = item.find(':');
          const std::string id =
            Utilities::trim(item.substr(0, colon == std::string::npos ? 0 : colon));
          if (id.empty() || id.size() > 6 ||
              id.find_first_not_of("0123456789") != std::string::npos)
            throw InputError(origin + ": '" + item + "' is not of the form id: expression.");
          const Expression inside(item.substr(colon + 1), 1, origin);

          unsigned int n_faces = 0;
          for (auto &face : mesh.boundary)
            {
              const auto vertices = mesh.face_vertices(face);
              if (std::all_of(vertices.begin(), vertices.end(), [&](const unsigned int v) {
                    return inside.value(mesh.vertices[v], 0.) != 0.;
                  }))
                {
                  face.boundary_id = std::stoul(id);
                  ++n_faces;
                }
            }
          if (n_faces == 0)
            throw InputError(origin + ": no face of the surface has all its vertices in '" +
                             item.substr(colon + 1) + "'. The body lies in " +
                             extent_in_words(box_around(mesh), mesh.dimension) + " m.");
        }
    }


    SerialMesh
    generate_or_read(const MeshParameters &parameters, const ParameterFile &scene)
    {
      switch (parameters.shape)
        {
          case MeshParameters::Shape::box:
            return box_mesh(parameters);
          case MeshParameters::Shape::hollow_cylinder:
            return hollow_cylinder_mesh(parameters);
          case MeshParameters::Shape::rectangle:
            return rectangle_mesh(parameters);
          default:
            {
              const auto file = std::filesystem::path(scene.folder()) / parameters.file;
              SerialMesh mesh = read_mesh(file.string(), scene.origin("Mesh/File"));
              for (auto &vertex : mesh.vertices)
                vertex *= parameters.scale;
              return mesh;
            }
        }
    }


    /** @throws InputError where the map gives no place, or leaves the plane of a plane body */
    Point<3>
    mapped(const Expression &map,
           const Point<3> &vertex,
           const bool plane,
           const std::string &origin)
    {
      const Point<3> place(map.value(vertex, 0., 0),
                           map.value(vertex, 0., 1),
                           map.value(vertex, 0., 2));
      const bool finite =
        std::isfinite(place[0]) && std::isfinite(place[1]) && std::isfinite(place[2]);
      if (finite && (!plane || place[2] == 0.))
        return place;
      std::ostringstream text;
      text << origin << ": the vertex at (" << vertex << ") is put at (" << place << "); "
           << (finite ? "a plane body stays in the plane z = 0."
                      : "there must be a place for each vertex.");
      throw InputError(text.str());
    }


    /** Puts the vertices where the user wants them. A map may turn all cells around, as a mirror
     * does, but not some: it folds the body then. */
    void
    apply_map(SerialMesh &mesh, const std::string &expressions, const std::string &origin)
    {
      const Expression map(expressions, 3, origin);
      if (map.depends_on_time())
        throw InputError(origin + ": the body at rest does not depend on t.");

      std::vector<bool> was_positive(mesh.cells.size());
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        was_positive[c] = mesh.volume(c) > 0.;
      for (Point<3> &vertex : mesh.vertices)
        vertex = mapped(map, vertex, mesh.dimension == 2, origin);

      std::size_t n_turned = 0;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        n_turned += (mesh.volume(c) > 0.) != was_positive[c];
      if (n_turned > 0 && n_turned < mesh.cells.size())
        throw InputError(origin + ": it turns " + std::to_string(n_turned) + " of " +
                         std::to_string(mesh.cells.size()) +
                         " cells inside out; it must not fold the body.");
    }
  } // namespace


  Mesh::Mesh(const MeshParameters &parameters,
             const PlaneParameters &plane,
             const bool with_patches,
             const ParameterFile &scene,
             const MPI_Comm communicator)
    : communicator(communicator)
  {
    SerialMesh whole;
    std::vector<unsigned int> owner;
    on_first_process(communicator, [&] {
      whole = make_whole(parameters, plane, with_patches, scene);
      owner = partition(whole, Utilities::MPI::n_mpi_processes(communicator));
    });
    share();
    parts = std::make_unique<DistributedMesh>(
      distribute(std::move(whole), std::move(owner), communicator), communicator);
    if (parts->dimension == 2)
      section = plane.section;
  }


  SerialMesh
  Mesh::make_whole(const MeshParameters &parameters,
                   const PlaneParameters &plane,
                   const bool with_patches,
                   const ParameterFile &scene)
  {
    const bool from_file = parameters.shape == MeshParameters::Shape::file;
    SerialMesh mesh      = generate_or_read(parameters, scene);
    if (!parameters.map.empty())
      apply_map(mesh, parameters.map, scene.origin("Mesh/Map"));
    if (mesh.dimension == 2)
      section = plane.section;
    report = check_mesh(mesh, scene.origin(from_file ? "Mesh/File" : "Mesh/Shape"));
    if (section.axisymmetric())
      fit_to_axis(mesh, scene.origin(from_file ? "Mesh/File" : "Mesh/Rectangle origin"));
    assign_boundary_regions(mesh,
                            parameters.boundary_regions,
                            scene.origin("Mesh/Boundary regions"));
    measure(mesh);
    if (with_patches)
      mesh.patches = make_patches(mesh);
    return mesh;
  }


  void
  Mesh::measure(const SerialMesh &mesh)
  {
    n_cells      = mesh.cells.size();
    n_vertices   = mesh.vertices.size() - report.unused_vertices;
    bounding_box = box_around(mesh);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        volume += volume_of(mesh, c, section);
        ++materials[mesh.materials[c]];
      }
    for (const auto &face : mesh.boundary)
      ++boundaries[face.boundary_id];
    boundary_names = mesh.boundary_names;
    material_names = mesh.material_names;
    checksum       = checksum_of(mesh);
  }


  void
  Mesh::share()
  {
    const auto share = [&](auto &value) { value = Utilities::MPI::broadcast(communicator, value); };
    share(n_cells);
    share(n_vertices);
    share(volume);
    share(bounding_box);
    share(boundaries);
    share(materials);
    share(boundary_names);
    share(material_names);
    share(checksum);
    share(report);
  }


  double
  Mesh::diameter() const
  {
    const auto &corners = bounding_box.get_boundary_points();
    return corners.first.distance(corners.second);
  }


  std::string
  Mesh::extent() const
  {
    return extent_in_words(bounding_box, section.plane() ? 2 : 3);
  }


  std::string
  Mesh::cell_name() const
  {
    return section.plane() ? "triangles" : "tetrahedra";
  }
} // namespace Supple
