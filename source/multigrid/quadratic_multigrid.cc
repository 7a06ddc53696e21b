#include <supple/multigrid/quadratic_multigrid.h>

#include <algorithm>
#include <utility>

namespace Supple
{
  QuadraticMultigrid::QuadraticMultigrid(
    const SymmetricBlockMatrix &A,
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> dofs,
    const SymmetricBlockMatrix &A_vertices,
    VertexLevel of_vertices)
    : Cycle(A, std::move(dofs))
    , level(std::move(of_vertices))
    , vertices(A_vertices, level.dofs)
    , start(vertices.halo.n_owned + 1)
    , b(vertices.halo.n_local)
    , x(vertices.halo.n_local)
    , b_less(vertices.halo.n_local)
  {
    const auto for_middles = [&](const auto &action) {
      for (std::uint32_t node = 0; node < level.ends.size(); ++node)
        if (level.ends[node][0] != level.ends[node][1])
          for (const std::uint32_t vertex : level.ends[node])
            if (vertex < vertices.halo.n_owned)
              action(vertex, node);
    };
    for_middles([&](const std::uint32_t vertex, const std::uint32_t) { ++start[vertex + 1]; });
    for (std::size_t vertex = 1; vertex < start.size(); ++vertex)
      start[vertex] += start[vertex - 1];
    edges.resize(start.back());
    std::vector<std::size_t> end(start.begin(), start.end() - 1);
    for_middles(
      [&](const std::uint32_t vertex, const std::uint32_t node) { edges[end[vertex]++] = node; });
  }


  std::vector<double>
  QuadraticMultigrid::modes_of_vertices(const std::vector<double> &modes) const
  {
    std::vector<double> of_vertices;
    of_vertices.reserve(18 * level.node.size());
    for (const std::size_t node : level.node)
      of_vertices.insert(of_vertices.end(), &modes[18 * node], &modes[18 * node] + 18);
    return of_vertices;
  }


  void
  QuadraticMultigrid::build(const std::vector<double> &modes)
  {
    finest.set_scale();
    finest.refresh();
    vertices.build(modes_of_vertices(modes));
  }


  void
  QuadraticMultigrid::refresh(const std::vector<double> &modes)
  {
    finest.set_scale();
    finest.refresh();
    vertices.refresh(modes_of_vertices(modes));
  }


  void
  QuadraticMultigrid::refresh_finest()
  {
    finest.refresh();
    vertices.refresh_finest();
  }


  void
  QuadraticMultigrid::restrict_residual()
  {
    const std::vector<NodeValues<3>> &residual = finest.residual();
    halo.update(finest.residual().data());
    const float unit = vertices.scale() / finest.scale();
    for (std::size_t vertex = 0; vertex < level.node.size(); ++vertex)
      {
        Lanes<float, 3> half{};
        for (std::size_t k = start[vertex]; k < start[vertex + 1]; ++k)
          half += residual[edges[k]].lanes;
        b[vertex].lanes = level.free_vertices[vertex].lanes * unit *
                          (residual[level.node[vertex]].lanes + 0.5f * half);
      }
  }


  void
  QuadraticMultigrid::add_correction(NodeValues<3> *z) const
  {
    for (std::size_t node = 0; node < level.ends.size(); ++node)
      {
        const auto &[v, w] = level.ends[node];
        z[node].lanes += level.free_nodes[node].lanes * 0.5f * (x[v].lanes + x[w].lanes);
      }
  }


  void
  QuadraticMultigrid::apply(NodeValues<3> *z, NodeValues<3> *product, const NodeValues<3> *r)
  {
    finest.descend(z, r);
    restrict_residual();
    vertices.apply(x.data(), b_less.data(), b.data());
    vertices.halo.update(x.data());
    add_correction(z);
    finest.ascend(z, product, r);
  }
} // namespace Supple
