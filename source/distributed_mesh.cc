#include <supple/distributed_mesh.h>

#include <supple/compatibility.h>
#include <supple/error.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/utilities.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_fe_field.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>
#include <deal.II/numerics/data_out.h>

#include <algorithm>
#include <map>
#include <sstream>

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
          cells.back().material_id = mesh.materials[c];
        }
      return cells;
    }


    template <int face_dim>
    void
    add_boundary(const SerialMesh &mesh, std::vector<CellData<face_dim>> &faces)
    {
      faces.reserve(mesh.boundary.size());
      for (const auto &face : mesh.boundary)
        {
          const auto vertices = mesh.face_vertices(face);
          faces.emplace_back(vertices.size());
          std::copy(vertices.begin(), vertices.end(), faces.back().vertices.begin());
          faces.back().boundary_id = face.boundary_id;
        }
    }


    /** Each patch goes to the process that has the most of its cells. */
    template <int dim>
    void
    unite_patches(const SerialMesh &mesh, Triangulation<dim, 3> &serial)
    {
      std::vector<std::map<unsigned int, unsigned int>> cells_on(
        *std::max_element(mesh.patches.begin(), mesh.patches.end()) + 1);
      for (const auto &cell : serial.active_cell_iterators())
        ++cells_on[mesh.patches[cell->id().get_coarse_cell_id()]][cell->subdomain_id()];
      for (const auto &cell : serial.active_cell_iterators())
        {
          const auto &on = cells_on[mesh.patches[cell->id().get_coarse_cell_id()]];
          cell->set_subdomain_id(
            std::max_element(on.begin(), on.end(), [](const auto &a, const auto &b) {
              return a.second < b.second;
            })->first);
        }
    }


    /**
     * A process without any cell gets one, or one patch, from the process that has most of them:
     * METIS leaves parts empty where there are few cells for each, and deal.II's mesh fails there.
     */
    template <int dim>
    void
    fill_empty_parts(const SerialMesh &mesh,
                     const unsigned int n_processes,
                     Triangulation<dim, 3> &serial)
    {
      if (n_processes == 1)
        return;
      using CellIterator = typename Triangulation<dim, 3>::active_cell_iterator;
      std::map<unsigned int, std::vector<CellIterator>> pieces; // cells, or the cells of a patch
      for (const auto &cell : serial.active_cell_iterators())
        {
          const unsigned int number = cell->id().get_coarse_cell_id();
          pieces[mesh.patches.empty() ? number : mesh.patches[number]].push_back(cell);
        }
      if (pieces.size() < n_processes)
        throw InputError(std::to_string(n_processes) + " processes are too many for " +
                         std::to_string(pieces.size()) +
                         (mesh.patches.empty() ? " cells" : " patches of cells") +
                         ": each of them needs one.");

      std::vector<std::vector<unsigned int>> pieces_of(n_processes);
      for (const auto &[piece, cells] : pieces)
        pieces_of[cells.front()->subdomain_id()].push_back(piece);
      for (unsigned int process = 0; process < n_processes; ++process)
        if (pieces_of[process].empty())
          {
            auto &most =
              *std::max_element(pieces_of.begin(),
                                pieces_of.end(),
                                [](const auto &a, const auto &b) { return a.size() < b.size(); });
            for (const CellIterator &cell : pieces[most.back()])
              cell->set_subdomain_id(process);
            pieces_of[process].push_back(most.back());
            most.pop_back();
          }
    }


    /** deal.II's mesh on one process, each cell with the number of the process that shall own it.
     */
    template <int dim>
    void
    create_serial(const SerialMesh &mesh,
                  const unsigned int n_processes,
                  Triangulation<dim, 3> &serial)
    {
      SubCellData boundary;
      if constexpr (dim == 3)
        add_boundary(mesh, boundary.boundary_quads);
      else
        add_boundary(mesh, boundary.boundary_lines);
      serial.create_triangulation(mesh.vertices, cell_data<dim>(mesh), boundary);

      GridTools::partition_triangulation(n_processes, serial, SparsityTools::Partitioner::metis);
      if (!mesh.patches.empty())
        unite_patches(mesh, serial);
      fill_empty_parts(mesh, n_processes, serial);
    }


    /** The patch of each cell, numbered process by process; nothing if there are none. */
    template <int dim>
    std::vector<unsigned int>
    number_patches(const SerialMesh &mesh, const Triangulation<dim, 3> &serial)
    {
      std::map<std::pair<types::subdomain_id, unsigned int>, unsigned int> number;
      const auto key = [&](const auto &cell) {
        return std::make_pair(cell->subdomain_id(), mesh.patches[cell->id().get_coarse_cell_id()]);
      };
      std::vector<unsigned int> numbers(mesh.patches.size());
      if (mesh.patches.empty())
        return numbers;
      for (const auto &cell : serial.active_cell_iterators())
        number[key(cell)];
      unsigned int n = 0;
      for (auto &entry : number)
        entry.second = n++;
      for (const auto &cell : serial.active_cell_iterators())
        numbers[cell->id().get_coarse_cell_id()] = number[key(cell)];
      return numbers;
    }


    /** What points along the normal of a face, out of the body if the nodes are in that order. */
    Tensor<1, 3>
    normal_direction(const std::vector<Point<3>> &x)
    {
      if (x.size() == 3)
        return cross_product_3d(x[1] - x[0], x[2] - x[0]);
      return cross_product_3d(x[1] - x[0], Point<3>(0., 0., 1.));
    }


    template <int dim>
    class SimplexMesh : public DistributedMesh
    {
    public:
      SimplexMesh(const SerialMesh &mesh, const MPI_Comm communicator)
        : triangulation(communicator)
        , fe(FE_SimplexP<dim, 3>(1), 3)
        , dof_handler(triangulation)
      {
        Triangulation<dim, 3> serial;
        create_serial(mesh, Utilities::MPI::n_mpi_processes(communicator), serial);
        const std::vector<unsigned int> patch_of = number_patches(mesh, serial);
        triangulation.create_triangulation(
          TriangulationDescription::Utilities::create_description_from_triangulation(serial,
                                                                                     communicator));
        if (patch_of.empty())
          serial.clear(); // hundreds of bytes a cell
        dof_handler.distribute_dofs(fe);

        partitioner =
          std::make_shared<Utilities::MPI::Partitioner>(dof_handler.locally_owned_dofs(),
                                                        Compatibility::locally_relevant_dofs(
                                                          dof_handler),
                                                        communicator);
        n_owned = partitioner->locally_owned_size() / 3;
        n_local = n_owned + partitioner->n_ghost_indices() / 3;
        n_cells = triangulation.n_active_cells();
        collect(mesh, patch_of);
        if (!patch_of.empty())
          find_patch_partitioner(patch_of, serial);
      }

      std::pair<std::string, std::string>
      draw(const Drawing &drawing, const std::vector<std::string> &names) const override;

    private:
      using CellIterator = typename DoFHandler<dim, 3>::active_cell_iterator;

      void
      collect(const SerialMesh &mesh, const std::vector<unsigned int> &patch_of)
      {
        positions.resize(n_local);
        serial_vertex.resize(n_local);
        std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
        for (const auto &cell : dof_handler.active_cell_iterators())
          {
            if (cell->is_artificial())
              continue;
            cell->get_dof_indices(dofs);
            const auto &serial_vertices = mesh.cells[cell->id().get_coarse_cell_id()];

            LocalCell local;
            for (const unsigned int a : cell->vertex_indices())
              {
                const unsigned int node = node_of(dofs, a);
                local.nodes[a]          = node;
                serial_vertex[node]     = serial_vertices[a];
                for (unsigned int d = 0; d < 3; ++d)
                  positions[node][d] = cell->vertex(a)[d];
              }
            if (dim == 2)
              local.nodes[3] = local.nodes[2];
            local.material_id = cell->material_id();
            local.index       = cell->active_cell_index();
            local.owned       = cell->is_locally_owned();
            local.patch       = patch_of.empty() ? 0 : patch_of[cell->id().get_coarse_cell_id()];
            cells.push_back(local);
            collect_faces(cell);
          }
      }

      void
      find_patch_partitioner(const std::vector<unsigned int> &patch_of,
                             const Triangulation<dim, 3> &serial)
      {
        const unsigned int n_patches = *std::max_element(patch_of.begin(), patch_of.end()) + 1;
        const auto rank = Utilities::MPI::this_mpi_process(triangulation.get_communicator());
        IndexSet owned(n_patches), known(n_patches);
        for (const auto &cell : serial.active_cell_iterators())
          if (cell->subdomain_id() == rank)
            owned.add_index(patch_of[cell->id().get_coarse_cell_id()]);
        for (const LocalCell &cell : cells)
          known.add_index(cell.patch);
        patch_partitioner =
          std::make_shared<Utilities::MPI::Partitioner>(owned,
                                                        known,
                                                        triangulation.get_communicator());
      }

      /** The rest of the program counts on three numbers in a row for each vertex. */
      unsigned int
      node_of(const std::vector<types::global_dof_index> &dofs, const unsigned int vertex) const
      {
        const unsigned int first = partitioner->global_to_local(dofs[3 * vertex]);
        AssertThrow(first % 3 == 0 &&
                      partitioner->global_to_local(dofs[3 * vertex + 1]) == first + 1 &&
                      partitioner->global_to_local(dofs[3 * vertex + 2]) == first + 2,
                    ExcInternalError());
        return first / 3;
      }

      void
      collect_faces(const CellIterator &cell)
      {
        std::vector<types::global_dof_index> dofs(fe.n_dofs_per_face());
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary())
            {
              cell->face(f)->get_dof_indices(dofs);
              LocalFace face;
              std::vector<Point<3>> x;
              for (const unsigned int v : cell->face(f)->vertex_indices())
                {
                  face.nodes[v] = node_of(dofs, v);
                  x.push_back(cell->face(f)->vertex(v));
                }
              if (normal_direction(x) * (cell->center() - x[0]) > 0.)
                std::swap(face.nodes[dim - 2], face.nodes[dim - 1]);
              if (dim == 2)
                face.nodes[2] = face.nodes[1];
              face.boundary_id = cell->face(f)->boundary_id();
              face.cell_index  = cell->active_cell_index();
              face.owned       = cell->is_locally_owned();
              faces.push_back(face);
            }
      }

      parallel::fullydistributed::Triangulation<dim, 3> triangulation;
      const FESystem<dim, 3> fe;
      DoFHandler<dim, 3> dof_handler;
    };


    template <int dim>
    std::pair<std::string, std::string>
    SimplexMesh<dim>::draw(const Drawing &drawing, const std::vector<std::string> &names) const
    {
      const std::vector<DataComponentInterpretation::DataComponentInterpretation> vector_valued(
        3, DataComponentInterpretation::component_is_part_of_vector);
      DataOut<dim, 3> data;
      data.attach_dof_handler(dof_handler);
      for (const auto &[name, values] : drawing.of_nodes)
        data.add_data_vector(*values,
                             std::vector<std::string>(3, name),
                             DataOut<dim, 3>::type_dof_data,
                             vector_valued);
      for (const auto &[name, values] : drawing.of_cells)
        data.add_data_vector(values, name, DataOut<dim, 3>::type_cell_data);

      DataOutBase::VtkFlags flags(drawing.time, drawing.step);
      flags.compression_level = DataOutBase::VtkFlags::best_speed;
      data.set_flags(flags);
      data.build_patches(MappingFEField<dim, 3, Vector>(dof_handler, drawing.positions));

      std::ostringstream part, record;
      data.write_vtu(part);
      data.write_pvtu_record(record, names);
      return {part.str(), record.str()};
    }
  } // namespace


  std::unique_ptr<DistributedMesh>
  DistributedMesh::create(const SerialMesh &mesh, const MPI_Comm communicator)
  {
    if (mesh.dimension == 2)
      return std::make_unique<SimplexMesh<2>>(mesh, communicator);
    return std::make_unique<SimplexMesh<3>>(mesh, communicator);
  }
} // namespace Supple
