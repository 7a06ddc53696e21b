#include <supple/mesh.h>

#include <supple/error.h>
#include <supple/expression.h>
#include <supple/patches.h>
#include <supple/plane_check.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

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


    /** Boundary ids by expressions: those that the user gives are stronger. */
    void
    assign_boundary_regions(SerialMesh &mesh, const Parameters &parameters)
    {
      const std::string origin = parameters.origin("Mesh/Boundary regions");
      for (const std::string &item :
           Utilities::split_string_list(parameters.mesh.boundary_regions, ';'))
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
  } // namespace


  SerialMesh
  make_serial_mesh(const Parameters &parameters)
  {
    switch (parameters.mesh.shape)
      {
        case MeshParameters::Shape::box:
          return box_mesh(parameters.mesh);
        case MeshParameters::Shape::hollow_cylinder:
          return hollow_cylinder_mesh(parameters.mesh);
        case MeshParameters::Shape::rectangle:
          return rectangle_mesh(parameters.mesh);
        default:
          {
            const auto file = std::filesystem::path(parameters.scene_folder) / parameters.mesh.file;
            SerialMesh mesh = read_mesh(file.string(), parameters.origin("Mesh/File"));
            for (auto &vertex : mesh.vertices)
              vertex *= parameters.mesh.scale;
            return mesh;
          }
      }
  }


  Mesh::Mesh(const Parameters &parameters, const MPI_Comm communicator)
    : communicator(communicator)
  {
    SerialMesh mesh = make_serial_mesh(parameters);
    if (mesh.dimension == 2)
      section = parameters.plane.section;
    check_directions(parameters, section);
    report = check_mesh(mesh,
                        parameters.origin(parameters.mesh.shape == MeshParameters::Shape::file
                                            ? "Mesh/File"
                                            : "Mesh/Shape"));
    if (section.axisymmetric())
      fit_to_axis(mesh, parameters);
    assign_boundary_regions(mesh, parameters);
    measure(mesh);

    if (parameters.material.cure == MaterialParameters::LockingCure::patches)
      {
        if (section.geometry == Geometry::plane_stress)
          throw InputError(parameters.origin("Material/Volumetric locking cure") +
                           ": in plane stress nothing locks, and there are no patches; it must be "
                           "none.");
        mesh.patches = make_patches(mesh);
      }
    parts = DistributedMesh::create(mesh, communicator);
  }


  void
  Mesh::measure(const SerialMesh &mesh)
  {
    n_cells      = mesh.cells.size();
    n_vertices   = mesh.vertices.size() - report.unused_vertices;
    bounding_box = box_around(mesh);
    volume       = 0.;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        volume += volume_of(mesh, c, section);
        ++materials[mesh.materials[c]];
      }
    for (const auto &face : mesh.boundary)
      ++boundaries[face.boundary_id];
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
