#include <supple/mesh.h>

#include <supple/error.h>
#include <supple/expression.h>

#include <deal.II/base/utilities.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    void
    create_triangulation(const SerialMesh &mesh, Triangulation<3> &triangulation)
    {
      std::vector<CellData<3>> cells;
      cells.reserve(mesh.cells.size());
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          cells.emplace_back(4);
          std::copy(mesh.cells[c].begin(), mesh.cells[c].end(), cells.back().vertices.begin());
          cells.back().material_id = mesh.materials[c];
        }
      SubCellData faces;
      faces.boundary_quads.reserve(mesh.boundary.size());
      for (const auto &triangle : mesh.boundary)
        {
          faces.boundary_quads.emplace_back(3);
          std::copy(triangle.vertices.begin(),
                    triangle.vertices.end(),
                    faces.boundary_quads.back().vertices.begin());
          faces.boundary_quads.back().boundary_id = triangle.boundary_id;
        }
      triangulation.create_triangulation(mesh.vertices, cells, faces);
    }


    /** "[0, 4] x [0, 12] x [0, 4]" */
    std::string
    extent_of(const BoundingBox<3> &box)
    {
      std::ostringstream text;
      for (unsigned int d = 0; d < 3; ++d)
        text << (d == 0 ? "[" : " x [") << box.lower_bound(d) << ", " << box.upper_bound(d) << "]";
      return text.str();
    }


    /** Of those vertices that cells have. */
    BoundingBox<3>
    box_around(const SerialMesh &mesh)
    {
      Point<3> low = mesh.vertices[mesh.cells[0][0]], high = low;
      for (const auto &cell : mesh.cells)
        for (const unsigned int v : cell)
          for (unsigned int d = 0; d < 3; ++d)
            {
              low[d]  = std::min(low[d], mesh.vertices[v][d]);
              high[d] = std::max(high[d], mesh.vertices[v][d]);
            }
      return BoundingBox<3>({low, high});
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
          for (auto &triangle : mesh.boundary)
            if (std::all_of(triangle.vertices.begin(),
                            triangle.vertices.end(),
                            [&](const unsigned int v) {
                              return inside.value(mesh.vertices[v], 0.) != 0.;
                            }))
              {
                triangle.boundary_id = std::stoul(id);
                ++n_faces;
              }
          if (n_faces == 0)
            throw InputError(origin + ": no face of the surface has all its vertices in '" +
                             item.substr(colon + 1) + "'. The body lies in " +
                             extent_of(box_around(mesh)) + " m.");
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
    , triangulation(communicator)
  {
    SerialMesh mesh = make_serial_mesh(parameters);
    report          = check_mesh(mesh,
                        parameters.origin(parameters.mesh.shape == MeshParameters::Shape::file
                                            ? "Mesh/File"
                                            : "Mesh/Shape"));
    assign_boundary_regions(mesh, parameters);
    measure(mesh);

    Triangulation<3> serial;
    create_triangulation(mesh, serial);
    GridTools::partition_triangulation(Utilities::MPI::n_mpi_processes(communicator),
                                       serial,
                                       SparsityTools::Partitioner::metis);
    std::vector<unsigned int> cells_of(Utilities::MPI::n_mpi_processes(communicator));
    for (const auto &cell : serial.active_cell_iterators())
      ++cells_of[cell->subdomain_id()];
    if (*std::min_element(cells_of.begin(), cells_of.end()) == 0)
      throw InputError(std::to_string(cells_of.size()) + " processes are too many for " +
                       std::to_string(n_cells) + " cells: one of them would have none.");
    triangulation.create_triangulation(
      TriangulationDescription::Utilities::create_description_from_triangulation(serial,
                                                                                 communicator));

    serial_vertex.resize(triangulation.n_vertices());
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        serial_vertex[cell->vertex_index(v)] = mesh.cells[cell->id().get_coarse_cell_id()][v];
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
        volume += mesh.volume(c);
        ++materials[mesh.materials[c]];
      }
    for (const auto &triangle : mesh.boundary)
      ++boundaries[triangle.boundary_id];
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
    return extent_of(bounding_box);
  }
} // namespace Supple
