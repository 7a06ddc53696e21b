#include <supple/mesh/partition.h>

#include <supple/base/error.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int none = numbers::invalid_unsigned_int;
    constexpr int message       = 0; ///< number of the messages with parts in them


    /** Cells that share a face. */
    SparsityPattern
    neighbours(const SerialMesh &mesh)
    {
      SparsityPattern graph(mesh.cells.size(), mesh.cells.size(), mesh.dimension + 2);
      const std::vector<SerialMesh::CellFace> faces = mesh.sorted_faces();
      for (std::size_t k = 1; k < faces.size(); ++k)
        if (faces[k - 1].vertices == faces[k].vertices)
          {
            graph.add(faces[k - 1].cell, faces[k].cell);
            graph.add(faces[k].cell, faces[k - 1].cell);
          }
      graph.compress();
      return graph;
    }


    /** Each patch goes to the process that has the most of its cells. */
    void
    unite_patches(const SerialMesh &mesh, std::vector<unsigned int> &owner)
    {
      std::vector<std::map<unsigned int, unsigned int>> cells_on(
        *std::max_element(mesh.patches.begin(), mesh.patches.end()) + 1);
      for (std::size_t c = 0; c < owner.size(); ++c)
        ++cells_on[mesh.patches[c]][owner[c]];
      for (std::size_t c = 0; c < owner.size(); ++c)
        {
          const auto &on = cells_on[mesh.patches[c]];
          owner[c]       = std::max_element(on.begin(), on.end(), [](const auto &a, const auto &b) {
                       return a.second < b.second;
                     })->first;
        }
    }


    /**
     * A process without any cell gets one, or one patch, from the process that has most of them:
     * METIS leaves parts empty where there are few cells for each, and deal.II's mesh fails there.
     */
    void
    fill_empty_parts(const SerialMesh &mesh,
                     const unsigned int n_processes,
                     std::vector<unsigned int> &owner)
    {
      std::vector<bool> has_cell(n_processes);
      for (const unsigned int process : owner)
        has_cell[process] = true;
      if (std::count(has_cell.begin(), has_cell.end(), false) == 0)
        return;

      std::map<unsigned int, std::vector<unsigned int>> groups; // cells, or the cells of a patch
      for (unsigned int c = 0; c < owner.size(); ++c)
        groups[mesh.patches.empty() ? c : mesh.patches[c]].push_back(c);
      if (groups.size() < n_processes)
        throw InputError(std::to_string(n_processes) + " processes are too many for " +
                         std::to_string(groups.size()) +
                         (mesh.patches.empty() ? " cells" : " patches of cells") +
                         ": each of them needs one.");

      std::vector<std::vector<unsigned int>> groups_of(n_processes);
      for (const auto &[group, cells] : groups)
        groups_of[owner[cells.front()]].push_back(group);
      for (unsigned int process = 0; process < n_processes; ++process)
        if (groups_of[process].empty())
          {
            auto &most =
              *std::max_element(groups_of.begin(),
                                groups_of.end(),
                                [](const auto &a, const auto &b) { return a.size() < b.size(); });
            for (const unsigned int cell : groups[most.back()])
              owner[cell] = process;
            groups_of[process].push_back(most.back());
            most.pop_back();
          }
    }


    /** Numbers the patches process by process. */
    unsigned int
    number_patches(std::vector<unsigned int> &patches, const std::vector<unsigned int> &owner)
    {
      std::map<std::pair<unsigned int, unsigned int>, unsigned int> number;
      for (std::size_t c = 0; c < patches.size(); ++c)
        number[{owner[c], patches[c]}];
      unsigned int n = 0;
      for (auto &entry : number)
        entry.second = n++;
      for (std::size_t c = 0; c < patches.size(); ++c)
        patches[c] = number[{owner[c], patches[c]}];
      return n;
    }


    /** Lists of numbers, one behind the other. */
    class Lists
    {
    public:
      /** @param visit called twice, calls its argument with each list and number that it gets. */
      template <class Visit>
      Lists(const std::size_t n_lists, const Visit &visit)
        : start(n_lists + 1)
      {
        visit([&](const std::size_t list, const unsigned int) { ++start[list + 1]; });
        for (std::size_t list = 0; list < n_lists; ++list)
          start[list + 1] += start[list];
        numbers.resize(start.back());
        std::vector<std::size_t> end(start.begin(), start.end() - 1);
        visit([&](const std::size_t list, const unsigned int number) {
          numbers[end[list]++] = number;
        });
      }

      ArrayView<const unsigned int>
      operator[](const std::size_t list) const
      {
        return {numbers.data() + start[list], start[list + 1] - start[list]};
      }

    private:
      std::vector<std::size_t> start;
      std::vector<unsigned int> numbers;
    };


    /** Cuts a mesh into parts, each in a time that goes with its own size. */
    class Scissors
    {
    public:
      Scissors(const SerialMesh &mesh,
               const std::vector<unsigned int> &owner,
               const unsigned int n_processes,
               const unsigned int n_patches)
        : mesh(mesh)
        , owner(owner)
        , n_patches(n_patches)
        , cells_of(n_processes,
                   [&](const auto &add) {
                     for (std::size_t c = 0; c < owner.size(); ++c)
                       add(owner[c], c);
                   })
        , cells_around(mesh.vertices.size(),
                       [&](const auto &add) {
                         for (std::size_t c = 0; c < mesh.cells.size(); ++c)
                           for (const unsigned int vertex : mesh.cell_vertices(c))
                             add(vertex, c);
                       })
        , faces_of(mesh.cells.size(),
                   [&](const auto &add) {
                     for (std::size_t f = 0; f < mesh.boundary.size(); ++f)
                       add(mesh.boundary[f].cell, f);
                   })
        , taken_for(mesh.cells.size(), none)
        , number(mesh.vertices.size(), none)
      {
      }

      MeshPart
      cut(const unsigned int process)
      {
        MeshPart part;
        part.n_patches      = n_patches;
        part.mesh.dimension = mesh.dimension;
        part.serial_cell    = find_cells(process);
        part.serial_vertex  = number_vertices(part.serial_cell);
        for (const unsigned int vertex : part.serial_vertex)
          {
            part.mesh.vertices.push_back(mesh.vertices[vertex]);
            part.mesh.parts.push_back(mesh.parts[vertex]);
          }
        for (const unsigned int cell : part.serial_cell)
          copy_cell(cell, part);
        if (!mesh.middles.empty())
          copy_middles(part);
        for (const unsigned int vertex : part.serial_vertex)
          number[vertex] = none;
        return part;
      }

    private:
      /** Those that share a vertex with a cell of a process, these included. */
      std::vector<unsigned int>
      find_cells(const unsigned int process)
      {
        std::vector<unsigned int> cells;
        for (const unsigned int own : cells_of[process])
          for (const unsigned int vertex : mesh.cell_vertices(own))
            for (const unsigned int cell : cells_around[vertex])
              if (taken_for[cell] != process)
                {
                  taken_for[cell] = process;
                  cells.push_back(cell);
                }
        std::sort(cells.begin(), cells.end());
        return cells;
      }

      std::vector<unsigned int>
      number_vertices(const std::vector<unsigned int> &cells)
      {
        std::vector<unsigned int> vertices;
        for (const unsigned int cell : cells)
          for (const unsigned int vertex : mesh.cell_vertices(cell))
            if (number[vertex] == none)
              {
                number[vertex] = 0;
                vertices.push_back(vertex);
              }
        std::sort(vertices.begin(), vertices.end());
        for (unsigned int v = 0; v < vertices.size(); ++v)
          number[vertices[v]] = v;
        return vertices;
      }

      void
      copy_cell(const unsigned int cell, MeshPart &part) const
      {
        const auto renumber = [&](auto vertices, const unsigned int n) {
          for (unsigned int a = 0; a < n; ++a)
            vertices[a] = number[vertices[a]];
          return vertices;
        };
        for (const unsigned int f : faces_of[cell])
          part.mesh.boundary.push_back({renumber(mesh.boundary[f].vertices, mesh.dimension),
                                        mesh.boundary[f].boundary_id,
                                        static_cast<unsigned int>(part.mesh.cells.size())});
        part.mesh.cells.push_back(renumber(mesh.cells[cell], mesh.dimension + 1));
        part.mesh.materials.push_back(mesh.materials[cell]);
        if (!mesh.patches.empty())
          part.mesh.patches.push_back(mesh.patches[cell]);
        part.owner.push_back(owner[cell]);
      }

      /** Those of the edges of its cells, in the order of the whole mesh. */
      void
      copy_middles(MeshPart &part) const
      {
        std::vector<unsigned int> taken;
        for (const unsigned int cell : part.serial_cell)
          for (const auto &[a, b] : tetrahedron_edges)
            taken.push_back(mesh.middle(mesh.cells[cell][a], mesh.cells[cell][b]));
        std::sort(taken.begin(), taken.end());
        taken.erase(std::unique(taken.begin(), taken.end()), taken.end());
        for (const unsigned int m : taken)
          {
            SerialMesh::Middle middle = mesh.middles[m];
            for (unsigned int &end : middle.ends)
              end = number[end];
            part.mesh.middles.push_back(middle);
            part.serial_middle.push_back(mesh.vertices.size() + m);
          }
      }

      const SerialMesh &mesh;
      const std::vector<unsigned int> &owner;
      const unsigned int n_patches;
      const Lists cells_of, cells_around, faces_of; ///< of a process, a vertex, a cell
      std::vector<unsigned int> taken_for;          ///< the last process a cell was taken for
      std::vector<unsigned int> number;             ///< of the vertices of the part at hand
    };


    void
    send(const MeshPart &part, const unsigned int process, const MPI_Comm communicator)
    {
      const std::vector<char> packed = Utilities::pack(part, false);
      AssertThrow(packed.size() <= std::size_t(std::numeric_limits<int>::max()),
                  ExcMessage("The part of a process has more than 2 GB; take more processes."));
      const int error =
        MPI_Send(packed.data(), packed.size(), MPI_CHAR, process, message, communicator);
      AssertThrowMPI(error);
    }


    MeshPart
    receive(const MPI_Comm communicator)
    {
      MPI_Status status;
      int n = 0, error = MPI_Probe(0, message, communicator, &status);
      AssertThrowMPI(error);
      MPI_Get_count(&status, MPI_CHAR, &n);
      std::vector<char> packed(n);
      error = MPI_Recv(packed.data(), n, MPI_CHAR, 0, message, communicator, MPI_STATUS_IGNORE);
      AssertThrowMPI(error);
      return Utilities::unpack<MeshPart>(packed, false);
    }
  } // namespace


  std::vector<unsigned int>
  partition(const SerialMesh &mesh, const unsigned int n_processes)
  {
    std::vector<unsigned int> owner(mesh.cells.size());
    if (n_processes == 1)
      return owner;
    SparsityTools::partition(neighbours(mesh), n_processes, owner);
    if (!mesh.patches.empty())
      unite_patches(mesh, owner);
    fill_empty_parts(mesh, n_processes, owner);
    return owner;
  }


  MeshPart
  distribute(SerialMesh mesh, std::vector<unsigned int> owner, const MPI_Comm communicator)
  {
    if (Utilities::MPI::this_mpi_process(communicator) > 0)
      return receive(communicator);
    const unsigned int n_processes = Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int n_patches   = number_patches(mesh.patches, owner);
    Scissors scissors(mesh, owner, n_processes, n_patches);
    for (unsigned int process = 1; process < n_processes; ++process)
      send(scissors.cut(process), process, communicator);
    return scissors.cut(0);
  }
} // namespace Supple
