#include <supple/mesh/distributed_mesh.h>

#include <supple/base/compatibility.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/grid/tria.h>
#include <deal.II/grid/tria_description.h>

#include <algorithm>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    std::vector<CellData<dim>>
    cell_data(const SerialMesh &mesh)
    {
      std::vector<CellData<dim>> cells;
      cells.reserve(mesh.cells.size());
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          const auto vertices = mesh.cell_vertices(c);
          cells.emplace_back(vertices.size());
          std::copy(vertices.begin(), vertices.end(), cells.back().vertices.begin());
        }
      return cells;
    }


    /** What deal.II wants to know of a part. */
    template <int dim>
    TriangulationDescription::Description<dim, 3>
    description(const MeshPart &part, const MPI_Comm communicator)
    {
      TriangulationDescription::Description<dim, 3> description;
      description.comm                                = communicator;
      description.settings                            = TriangulationDescription::default_setting;
      description.smoothing                           = Triangulation<dim, 3>::none;
      description.coarse_cells                        = cell_data<dim>(part.mesh);
      description.coarse_cell_vertices                = part.mesh.vertices;
      description.coarse_cell_index_to_coarse_cell_id = {part.serial_cell.begin(),
                                                         part.serial_cell.end()};
      description.cell_infos.emplace_back();
      for (std::size_t c = 0; c < part.serial_cell.size(); ++c)
        {
          TriangulationDescription::CellData<dim> cell;
          cell.id                 = CellId(part.serial_cell[c], {}).template to_binary<dim>();
          cell.subdomain_id       = part.owner[c];
          cell.level_subdomain_id = numbers::invalid_subdomain_id;
          cell.manifold_id        = numbers::flat_manifold_id;
          cell.manifold_line_ids.fill(numbers::flat_manifold_id);
          cell.manifold_quad_ids.fill(numbers::flat_manifold_id);
          description.cell_infos.back().push_back(cell);
        }
      return description;
    }


    /** deal.II's mesh of a part: a distributed one where there are others. */
    template <int dim>
    std::unique_ptr<Triangulation<dim, 3>>
    triangulate(const MeshPart &part, const MPI_Comm communicator)
    {
      if (Utilities::MPI::n_mpi_processes(communicator) == 1)
        {
          auto mesh = std::make_unique<Triangulation<dim, 3>>();
          mesh->create_triangulation(part.mesh.vertices, cell_data<dim>(part.mesh), SubCellData());
          return mesh;
        }
      auto mesh = std::make_unique<parallel::fullydistributed::Triangulation<dim, 3>>(communicator);
      mesh->create_triangulation(description<dim>(part, communicator));
      return mesh;
    }


    /** What points along the normal of a face, out of the body if the nodes are in that order. */
    Tensor<1, 3>
    normal_direction(const std::vector<Point<3>> &x)
    {
      if (x.size() == 3)
        return cross_product_3d(x[1] - x[0], x[2] - x[0]);
      return cross_product_3d(x[1] - x[0], Point<3>(0., 0., 1.));
    }


    /** What own nodes of quadratic cells are sorted by. */
    using EdgeKey = std::array<unsigned int, 2>;


    /** The place of each vertex in the order in which cells come upon them. */
    std::vector<unsigned int>
    order_of_vertices(const SerialMesh &mesh)
    {
      std::vector<unsigned int> place(mesh.vertices.size(), numbers::invalid_unsigned_int);
      unsigned int n = 0;
      for (const auto &cell : mesh.cells)
        for (const unsigned int vertex : cell)
          if (place[vertex] == numbers::invalid_unsigned_int)
            place[vertex] = n++;
      return place;
    }


    /** Calls visit(v, w, object) for each vertex, v = w, and each edge of each cell, with what
     * deal.II has the degrees of freedom of. */
    template <int dim, class Visit>
    void
    for_nodes_of_cells(const DoFHandler<dim, 3> &dof_handler, const Visit &visit)
    {
      for (const auto &cell : dof_handler.active_cell_iterators())
        {
          for (const unsigned int a : cell->vertex_indices())
            visit(cell->vertex_index(a), cell->vertex_index(a), [&](const unsigned int i) {
              return cell->vertex_dof_index(a, i);
            });
          if (dof_handler.get_fe().n_dofs_per_line() > 0)
            for (const unsigned int l : cell->line_indices())
              visit(cell->line(l)->vertex_index(0),
                    cell->line(l)->vertex_index(1),
                    [&](const unsigned int i) { return cell->line(l)->dof_index(i); });
        }
    }


    /** Numbers own nodes by the vertices of their edges. */
    template <int dim>
    void
    sort_nodes(DoFHandler<dim, 3> &dof_handler, const SerialMesh &mesh)
    {
      const std::vector<unsigned int> place = order_of_vertices(mesh);
      const IndexSet owned                  = dof_handler.locally_owned_dofs();
      std::vector<std::pair<EdgeKey, std::array<types::global_dof_index, 3>>> nodes;
      for_nodes_of_cells(dof_handler, [&](const auto v, const auto w, const auto &dof) {
        const EdgeKey key = {{std::min(place[v], place[w]), std::max(place[v], place[w])}};
        if (owned.is_element(dof(0)))
          nodes.push_back({key, {{dof(0), dof(1), dof(2)}}});
      });
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      std::vector<types::global_dof_index> number(owned.n_elements());
      for (std::size_t n = 0; n < nodes.size(); ++n)
        for (unsigned int i = 0; i < 3; ++i)
          number[owned.index_within_set(nodes[n].second[i])] = owned.nth_index_in_set(3 * n + i);
      dof_handler.renumber_dofs(number);
    }


    Point<3>
    center(const SerialMesh &mesh, const std::size_t cell)
    {
      Point<3> center;
      for (const unsigned int vertex : mesh.cell_vertices(cell))
        center += mesh.vertices[vertex] / (mesh.dimension + 1.);
      return center;
    }
  } // namespace


  DistributedMesh::DistributedMesh(const MeshPart &part, const MPI_Comm communicator)
    : dimension(part.mesh.dimension)
  {
    const Numbers numbers =
      dimension == 2 ? number_nodes<2>(part, communicator) : number_nodes<3>(part, communicator);
    n_owned = partitioner->locally_owned_size() / 3;
    n_local = n_owned + partitioner->n_ghost_indices() / 3;
    n_cells = part.mesh.cells.size();
    collect_nodes(part, numbers);
    collect_cells(part, numbers);
    collect_faces(part, numbers);
    if (part.n_patches > 0)
      find_patch_partitioner(part.n_patches, communicator);
  }


  template <int dim>
  DistributedMesh::Numbers
  DistributedMesh::number_nodes(const MeshPart &part, const MPI_Comm communicator)
  {
    const std::unique_ptr<Triangulation<dim, 3>> mesh = triangulate<dim>(part, communicator);
    const bool quadratic                              = !part.mesh.middles.empty();
    DoFHandler<dim, 3> dof_handler(*mesh);
    dof_handler.distribute_dofs(FESystem<dim, 3>(FE_SimplexP<dim, 3>(quadratic ? 2 : 1), 3));
    if (quadratic)
      sort_nodes(dof_handler, part.mesh);
    partitioner =
      std::make_shared<Utilities::MPI::Partitioner>(dof_handler.locally_owned_dofs(),
                                                    Compatibility::locally_relevant_dofs(
                                                      dof_handler),
                                                    communicator);

    Numbers node;
    node.of_vertices.resize(part.mesh.vertices.size());
    node.of_middles.resize(part.mesh.middles.size());
    for_nodes_of_cells(dof_handler, [&](const auto v, const auto w, const auto &dof) {
      std::array<unsigned int, 3> numbers;
      for (unsigned int i = 0; i < 3; ++i)
        numbers[i] = partitioner->global_to_local(dof(i));
      // The rest of the program counts on three numbers in a row for each node.
      AssertThrow(numbers[0] % 3 == 0 && numbers[1] == numbers[0] + 1 &&
                    numbers[2] == numbers[0] + 2,
                  ExcInternalError());
      (v == w ? node.of_vertices[v] : node.of_middles[part.mesh.middle(v, w)]) = numbers[0] / 3;
    });
    return node;
  }


  void
  DistributedMesh::collect_nodes(const MeshPart &part, const Numbers &numbers)
  {
    positions.resize(n_local);
    serial_vertex.resize(n_local);
    parts.resize(n_local);
    const auto set = [&](const unsigned int node,
                         const Point<3> &place,
                         const unsigned int serial,
                         const unsigned int of_body) {
      for (unsigned int d = 0; d < 3; ++d)
        positions[node][d] = place[d];
      serial_vertex[node] = serial;
      parts[node]         = of_body;
    };
    for (std::size_t v = 0; v < numbers.of_vertices.size(); ++v)
      set(numbers.of_vertices[v], part.mesh.vertices[v], part.serial_vertex[v], part.mesh.parts[v]);
    for (std::size_t m = 0; m < numbers.of_middles.size(); ++m)
      set(numbers.of_middles[m],
          part.mesh.middles[m].place,
          part.serial_middle[m],
          part.mesh.middles[m].part);
  }


  void
  DistributedMesh::collect_cells(const MeshPart &part, const Numbers &numbers)
  {
    const unsigned int rank = Utilities::MPI::this_mpi_process(partitioner->get_mpi_communicator());
    cells.reserve(n_cells);
    for (unsigned int c = 0; c < n_cells; ++c)
      {
        const auto vertices = part.mesh.cell_vertices(c);
        LocalCell cell;
        for (unsigned int a = 0; a < 4; ++a)
          cell.nodes[a] = numbers.of_vertices[vertices[std::min(a, dimension)]];
        cell.material_id = part.mesh.materials[c];
        cell.index       = c;
        cell.serial_cell = part.serial_cell[c];
        cell.patch       = part.mesh.patches.empty() ? 0 : part.mesh.patches[c];
        cell.owned       = part.owner[c] == rank;
        cells.push_back(cell);
        if (part.mesh.middles.empty())
          continue;
        cell_middles.emplace_back();
        for (unsigned int e = 0; e < 6; ++e)
          cell_middles.back()[e] =
            numbers.of_middles[part.mesh.middle(vertices[tetrahedron_edges[e][0]],
                                                vertices[tetrahedron_edges[e][1]])];
      }
  }


  void
  DistributedMesh::collect_faces(const MeshPart &part, const Numbers &numbers)
  {
    for (const SerialMesh::BoundaryFace &of_part : part.mesh.boundary)
      {
        LocalFace face;
        std::vector<Point<3>> x;
        for (const unsigned int vertex : part.mesh.face_vertices(of_part))
          {
            face.nodes[x.size()] = numbers.of_vertices[vertex];
            x.push_back(part.mesh.vertices[vertex]);
          }
        std::array<unsigned int, 3> corners = of_part.vertices;
        if (normal_direction(x) * (center(part.mesh, of_part.cell) - x[0]) > 0.)
          {
            std::swap(face.nodes[dimension - 2], face.nodes[dimension - 1]);
            std::swap(corners[dimension - 2], corners[dimension - 1]);
          }
        if (dimension == 2)
          face.nodes[2] = face.nodes[1];
        face.boundary_id = of_part.boundary_id;
        face.cell_index  = of_part.cell;
        face.owned       = cells[of_part.cell].owned;
        faces.push_back(face);
        if (part.mesh.middles.empty())
          continue;
        face_middles.emplace_back();
        for (unsigned int e = 0; e < 3; ++e)
          face_middles.back()[e] =
            numbers.of_middles[part.mesh.middle(corners[e], corners[(e + 1) % 3])];
      }
  }


  void
  DistributedMesh::find_patch_partitioner(const unsigned int n_patches, const MPI_Comm communicator)
  {
    const unsigned int n = n_functions_of_patch();
    IndexSet owned(n * n_patches), known(n * n_patches);
    for (const LocalCell &cell : cells)
      {
        known.add_range(n * cell.patch, n * (cell.patch + 1));
        if (cell.owned)
          owned.add_range(n * cell.patch, n * (cell.patch + 1));
      }
    patch_partitioner = std::make_shared<Utilities::MPI::Partitioner>(owned, known, communicator);
  }
} // namespace Supple
