#include <supple/multigrid/aggregation.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Supple
{
  Adjacency::Adjacency(const SymmetricPattern &pattern)
    : start(pattern.n_owned + 1, 0)
  {
    const auto for_entries = [&](const auto &action) {
      for (std::uint32_t i = 0; i < pattern.n_local; ++i)
        for (std::size_t k = pattern.row_start[i]; k < pattern.row_start[i + 1]; ++k)
          {
            if (i < pattern.n_owned)
              action(i, pattern.column[k], k);
            action(pattern.column[k], i, k);
          }
    };
    for_entries([&](const std::uint32_t node, std::uint32_t, std::size_t) { ++start[node + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    neighbor.resize(start.back());
    entry.resize(start.back());
    std::vector<std::uint32_t> end(start.begin(), start.end() - 1);
    for_entries([&](const std::uint32_t node, const std::uint32_t other, const std::size_t k) {
      neighbor[end[node]] = other;
      entry[end[node]++]  = k;
    });
  }


  namespace
  {
    // Couplings across a jump of the stiffness by more than a thousand are weaker than this.
    constexpr float strong = 0.02f;


    /** For each owned node the owned nodes it is coupled with strongly. */
    struct Graph
    {
      std::vector<std::uint32_t> start{0};
      std::vector<std::uint32_t> neighbor;

      std::uint32_t
      n_nodes() const
      {
        return start.size() - 1;
      }

      const std::uint32_t *
      begin(const std::uint32_t node) const
      {
        return neighbor.data() + start[node];
      }

      const std::uint32_t *
      end(const std::uint32_t node) const
      {
        return neighbor.data() + start[node + 1];
      }

      bool
      alone(const std::uint32_t node) const
      {
        return start[node] == start[node + 1];
      }
    };


    template <unsigned int B>
    Graph
    strong_couplings(const BlockSmoother<B> &matrix, const Adjacency &adjacency)
    {
      const std::uint32_t n_owned = matrix.pattern.n_owned;
      std::vector<float> limit(n_owned);
      for (std::uint32_t node = 0; node < n_owned; ++node)
        limit[node] = strong * matrix.diagonal_norm(node);

      Graph graph;
      graph.neighbor.reserve(adjacency.neighbor.size() + 1);
      for (std::uint32_t node = 0; node < n_owned; ++node)
        {
          for (std::uint32_t k = adjacency.start[node]; k < adjacency.start[node + 1]; ++k)
            {
              const std::uint32_t other = adjacency.neighbor[k];
              if (other >= n_owned)
                continue;
              const float *block = &matrix.lower[B * B * std::size_t(adjacency.entry[k])];
              if (std::inner_product(block, block + B * B, block, 0.f) > limit[node] * limit[other])
                graph.neighbor.push_back(other);
            }
          graph.start.push_back(graph.neighbor.size());
        }
      graph.neighbor.push_back(0); // so that the end of the last row can be pointed at
      return graph;
    }


    /** The aggregate that most neighbours of a node are in, no_aggregate if none is in any. */
    class MostCommon
    {
    public:
      MostCommon(const Graph &graph, const std::uint32_t n_aggregates)
        : graph(graph)
        , count(n_aggregates, 0)
      {
      }

      /** @param except does not count */
      std::uint32_t
      around(const std::vector<std::uint32_t> &nodes,
             const std::vector<std::uint32_t> &aggregate_of,
             const std::uint32_t except = no_aggregate)
      {
        std::uint32_t best = no_aggregate, largest = 0;
        for (const std::uint32_t node : nodes)
          for (auto other = graph.begin(node); other != graph.end(node); ++other)
            {
              const std::uint32_t a = aggregate_of[*other];
              if (a != no_aggregate && a != except && ++count[a] > largest)
                {
                  largest = count[a];
                  best    = a;
                }
            }
        for (const std::uint32_t node : nodes)
          for (auto other = graph.begin(node); other != graph.end(node); ++other)
            if (aggregate_of[*other] != no_aggregate)
              count[aggregate_of[*other]] = 0;
        return best;
      }

    private:
      const Graph &graph;
      std::vector<std::uint32_t> count;
    };


    std::vector<std::uint32_t>
    neighborhoods(const Graph &graph, std::uint32_t &n_aggregates)
    {
      const std::uint32_t n = graph.n_nodes();
      std::vector<std::uint32_t> aggregate_of(n, no_aggregate);
      const auto free = [&](const std::uint32_t node) {
        return aggregate_of[node] == no_aggregate;
      };
      n_aggregates = 0;

      // Whole neighbourhoods first.
      for (std::uint32_t node = 0; node < n; ++node)
        if (!graph.alone(node) && free(node) &&
            std::all_of(graph.begin(node), graph.end(node), free))
          {
            aggregate_of[node] = n_aggregates;
            std::for_each(graph.begin(node), graph.end(node), [&](const std::uint32_t other) {
              aggregate_of[other] = n_aggregates;
            });
            ++n_aggregates;
          }

      // What lies between them goes to a neighbour, and what is left keeps together.
      const std::vector<std::uint32_t> first = aggregate_of;
      MostCommon most_common(graph, n_aggregates);
      for (std::uint32_t node = 0; node < n; ++node)
        if (!graph.alone(node) && free(node))
          aggregate_of[node] = most_common.around({node}, first);
      for (std::uint32_t node = 0; node < n; ++node)
        if (!graph.alone(node) && free(node))
          {
            aggregate_of[node] = n_aggregates;
            for (auto other = graph.begin(node); other != graph.end(node); ++other)
              if (free(*other))
                aggregate_of[*other] = n_aggregates;
            ++n_aggregates;
          }
      return aggregate_of;
    }


    std::vector<std::uint32_t>
    patches(const Graph &graph, const unsigned int size, std::uint32_t &n_aggregates)
    {
      const std::uint32_t n = graph.n_nodes();
      std::vector<std::uint32_t> aggregate_of(n, no_aggregate), patch;
      MostCommon most_common(graph, n);
      n_aggregates = 0;
      for (std::uint32_t root = 0; root < n; ++root)
        {
          if (graph.alone(root) || aggregate_of[root] != no_aggregate)
            continue;
          patch.assign(1, root);
          aggregate_of[root] = n_aggregates;
          for (std::size_t k = 0; k < patch.size() && patch.size() < size; ++k)
            for (auto other = graph.begin(patch[k]);
                 other != graph.end(patch[k]) && patch.size() < size;
                 ++other)
              if (aggregate_of[*other] == no_aggregate)
                {
                  aggregate_of[*other] = n_aggregates;
                  patch.push_back(*other);
                }

          // Too small a patch joins the neighbour it has most couplings with.
          const std::uint32_t neighbor = patch.size() < size / 3
                                           ? most_common.around(patch, aggregate_of, n_aggregates)
                                           : no_aggregate;
          if (neighbor == no_aggregate)
            ++n_aggregates;
          else
            for (const std::uint32_t node : patch)
              aggregate_of[node] = neighbor;
        }
      return aggregate_of;
    }
  } // namespace


  template <unsigned int B>
  std::vector<std::uint32_t>
  aggregate(const BlockSmoother<B> &matrix,
            const Adjacency &adjacency,
            const unsigned int size,
            std::uint32_t &n_aggregates)
  {
    const Graph graph = strong_couplings(matrix, adjacency);
    return size == 0 ? neighborhoods(graph, n_aggregates) : patches(graph, size, n_aggregates);
  }


  template std::vector<std::uint32_t>
  aggregate(const BlockSmoother<3> &, const Adjacency &, unsigned int, std::uint32_t &);
  template std::vector<std::uint32_t>
  aggregate(const BlockSmoother<6> &, const Adjacency &, unsigned int, std::uint32_t &);
} // namespace Supple
