#include <supple/mesh.h>

#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>

#include <sstream>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** det [x1-x0, x2-x0, x3-x0], six times the volume. */
    double
    six_volumes(const SerialMesh &mesh, const std::array<unsigned int, 4> &cell)
    {
      const Point<3> &origin = mesh.vertices[cell[0]];
      return cross_product_3d(mesh.vertices[cell[1]] - origin, mesh.vertices[cell[2]] - origin) *
             (mesh.vertices[cell[3]] - origin);
    }


    void
    create_triangulation(const SerialMesh &mesh, Triangulation<3> &triangulation)
    {
      std::vector<CellData<3>> cells;
      cells.reserve(mesh.cells.size());
      for (const auto &vertices : mesh.cells)
        {
          cells.emplace_back(4);
          std::copy(vertices.begin(), vertices.end(), cells.back().vertices.begin());
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
  } // namespace


  SerialMesh
  box_mesh(const MeshParameters &parameters)
  {
    SerialMesh mesh;
    const auto [nx, ny, nz] = parameters.cubes;

    for (unsigned int k = 0; k <= nz; ++k)
      for (unsigned int j = 0; j <= ny; ++j)
        for (unsigned int i = 0; i <= nx; ++i)
          mesh.vertices.emplace_back(parameters.origin[0] + parameters.size[0] * i / nx,
                                     parameters.origin[1] + parameters.size[1] * j / ny,
                                     parameters.origin[2] + parameters.size[2] * k / nz);

    // Corner c of a cube lies at its 0/1-coordinates (c & 1, c & 2, c & 4).
    const std::array<std::array<unsigned int, 2>, 6> paths = {
      {{{1, 3}}, {{1, 5}}, {{2, 3}}, {{2, 6}}, {{4, 5}}, {{4, 6}}}};
    const std::array<unsigned int, 3> stride = {{1, nx + 1, (nx + 1) * (ny + 1)}};
    const std::array<unsigned int, 3> n      = {{nx, ny, nz}};

    for (unsigned int k = 0; k < nz; ++k)
      for (unsigned int j = 0; j < ny; ++j)
        for (unsigned int i = 0; i < nx; ++i)
          for (const auto &path : paths)
            {
              const std::array<unsigned int, 3> cube = {{i, j, k}};
              std::array<unsigned int, 4> corners    = {{0, path[0], path[1], 7}}, cell;
              const auto vertex                      = [&](const unsigned int corner) {
                unsigned int index = 0;
                for (unsigned int d = 0; d < 3; ++d)
                  index += (cube[d] + ((corner >> d) & 1)) * stride[d];
                return index;
              };
              std::transform(corners.begin(), corners.end(), cell.begin(), vertex);
              if (six_volumes(mesh, cell) < 0)
                {
                  std::swap(cell[1], cell[2]);
                  std::swap(corners[1], corners[2]);
                }
              mesh.cells.push_back(cell);

              // A face opposite to a vertex lies on the boundary if its corners share a coordinate
              // there.
              for (unsigned int opposite = 0; opposite < 4; ++opposite)
                for (unsigned int d = 0; d < 3; ++d)
                  for (const unsigned int side : {0u, 1u})
                    {
                      bool on_side = cube[d] == (side == 0 ? 0 : n[d] - 1);
                      std::array<unsigned int, 3> face;
                      for (unsigned int a = 0, f = 0; a < 4; ++a)
                        if (a != opposite)
                          {
                            on_side   = on_side && ((corners[a] >> d) & 1) == side;
                            face[f++] = cell[a];
                          }
                      if (on_side)
                        mesh.boundary.push_back({face, 2 * d + side});
                    }
            }
    return mesh;
  }


  Mesh::Mesh(const MeshParameters &parameters, const MPI_Comm communicator)
    : communicator(communicator)
    , triangulation(communicator)
  {
    const SerialMesh mesh = box_mesh(parameters);
    measure(mesh);

    Triangulation<3> serial;
    create_triangulation(mesh, serial);
    GridTools::partition_triangulation(Utilities::MPI::n_mpi_processes(communicator),
                                       serial,
                                       SparsityTools::Partitioner::metis);
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
    n_vertices   = mesh.vertices.size();
    bounding_box = BoundingBox<3>(mesh.vertices);
    volume       = 0.;
    for (const auto &cell : mesh.cells)
      volume += six_volumes(mesh, cell) / 6.;
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
    const auto &corners = bounding_box.get_boundary_points();
    std::ostringstream text;
    for (unsigned int d = 0; d < 3; ++d)
      text << (d == 0 ? "[" : " x [") << corners.first[d] << ", " << corners.second[d] << "]";
    return text.str();
  }
} // namespace Supple
