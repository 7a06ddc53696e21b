#include <supple/solvers/vertex_operator.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    constexpr std::uint32_t none = numbers::invalid_unsigned_int;


    /** Of all local nodes. */
    std::vector<bool>
    which_are_vertices(const Body &body)
    {
      std::vector<bool> is_vertex(body.n_local);
      for (const LocalCell &cell : body.mesh.parts->cells)
        for (const unsigned int node : cell.nodes)
          is_vertex[node] = true;
      return is_vertex;
    }


    IndexSet
    dofs_of(const std::vector<std::uint32_t> &numbers, const std::size_t n_all)
    {
      std::vector<types::global_dof_index> dofs;
      for (const std::uint32_t number : numbers)
        for (unsigned int i = 0; i < 3; ++i)
          dofs.push_back(3 * types::global_dof_index(number) + i);
      IndexSet set(3 * n_all);
      set.add_indices(dofs.begin(), dofs.end());
      return set;
    }


    /** One where a direction is free, zero where it is held. */
    NodeValues<3>
    free_directions(const Constraints &constraints, const unsigned int node)
    {
      NodeValues<3> free{};
      for (unsigned int i = 0; i < 3; ++i)
        free.lanes[i] = constraints.holds(3 * node + i) ? 0.f : 1.f;
      return free;
    }
  } // namespace


  VertexOperator::VertexOperator(const ImplicitOperator &A)
    : A(A)
    , vertex(number_vertices())
    , pattern(make_pattern())
    , slots(*A.body.cells, pattern, vertex)
    , on_vertices(pattern)
  {
    find_masked_entries();
  }


  std::vector<std::uint32_t>
  VertexOperator::number_vertices()
  {
    const Body &body                  = A.body;
    const MPI_Comm communicator       = body.mesh.communicator;
    const std::vector<bool> is_vertex = which_are_vertices(body);
    for (std::uint32_t node = 0; node < body.n_owned; ++node)
      if (is_vertex[node])
        of_nodes.node.push_back(node);
    const std::size_t n_own                = of_nodes.node.size();
    const std::vector<std::size_t> numbers = Utilities::MPI::all_gather(communicator, n_own);
    const unsigned int rank                = Utilities::MPI::this_mpi_process(communicator);
    std::uint32_t first = 0, n_all = 0;
    for (unsigned int process = 0; process < numbers.size(); ++process)
      {
        first += process < rank ? numbers[process] : 0;
        n_all += numbers[process];
      }

    std::vector<std::uint32_t> number(body.n_local, none), own, ghosts; // over all processes
    for (std::size_t v = 0; v < n_own; ++v)
      {
        number[of_nodes.node[v]] = first + v;
        own.push_back(first + v);
      }
    Halo(body.partitioner, 3).update(number.data());
    for (unsigned int node = body.n_owned; node < body.n_local; ++node)
      if (is_vertex[node])
        ghosts.push_back(number[node]);
    of_nodes.dofs = std::make_shared<Utilities::MPI::Partitioner>(dofs_of(own, n_all),
                                                                  dofs_of(ghosts, n_all),
                                                                  communicator);

    std::vector<std::uint32_t> local(body.n_local, none);
    of_nodes.ends.resize(body.n_local);
    for (unsigned int node = 0; node < body.n_local; ++node)
      {
        if (is_vertex[node])
          {
            local[node] = of_nodes.dofs->global_to_local(3 * number[node]) / 3;
            of_nodes.ends[node].fill(local[node]);
          }
        of_nodes.free_nodes.push_back(free_directions(A.constraints, node));
      }
    for (const LocalCell &cell : body.mesh.parts->cells)
      for (unsigned int e = 0; e < 6; ++e)
        of_nodes.ends[body.mesh.parts->cell_middles[cell.index][e]] = {
          {local[cell.nodes[tetrahedron_edges[e][0]]], local[cell.nodes[tetrahedron_edges[e][1]]]}};
    for (const std::uint32_t node : of_nodes.node)
      of_nodes.free_vertices.push_back(of_nodes.free_nodes[node]);
    return local;
  }


  SymmetricPattern
  VertexOperator::make_pattern() const
  {
    SymmetricPattern pattern;
    pattern.n_owned = of_nodes.node.size();
    pattern.n_local =
      of_nodes.dofs->locally_owned_size() / 3 + of_nodes.dofs->n_ghost_indices() / 3;
    std::vector<std::vector<std::uint32_t>> columns(pattern.n_local);
    for (const auto &nodes : A.body.cell_nodes)
      for (const unsigned int row : nodes)
        for (const unsigned int column : nodes)
          if (vertex[column] < vertex[row] && vertex[column] < pattern.n_owned &&
              !A.constraints.holds_node(row) && !A.constraints.holds_node(column))
            columns[vertex[row]].push_back(vertex[column]);
    pattern.row_start.push_back(0);
    for (auto &row : columns)
      {
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        pattern.column.insert(pattern.column.end(), row.begin(), row.end());
        pattern.row_start.push_back(pattern.column.size());
      }
    pattern.cut(A.body.n_threads);
    return pattern;
  }


  void
  VertexOperator::find_masked_entries()
  {
    std::vector<NodeValues<3>> free(pattern.n_local);
    for (unsigned int node = 0; node < A.body.n_local; ++node)
      if (vertex[node] != none)
        free[vertex[node]] = of_nodes.free_nodes[node];
    const auto held = [&](const std::size_t row, const unsigned int i) {
      return free[row].lanes[i] == 0.f;
    };
    for (std::size_t row = 0; row < pattern.n_local; ++row)
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          {
            if (row < pattern.n_owned && i != j && (held(row, i) || held(row, j)))
              masked_diagonal.push_back(9 * row + 3 * i + j);
            for (std::size_t k = pattern.row_start[row]; k < pattern.row_start[row + 1]; ++k)
              if (held(row, i) || held(pattern.column[k], j))
                masked_lower.push_back(9 * k + 3 * i + j);
          }
  }


  void
  VertexOperator::update()
  {
    A.assemble_on_vertices(slots, on_vertices);
    for (const std::size_t position : masked_diagonal)
      on_vertices.diagonal[position] = 0.;
    for (const std::size_t position : masked_lower)
      on_vertices.lower[position] = 0.;
  }
} // namespace Supple
