#ifndef supple_aggregation_h
#define supple_aggregation_h

#include <supple/multigrid/block_smoother.h>

#include <cstdint>
#include <vector>

namespace Supple
{
  /** For each owned node its neighbours, ghosts included, and the entry of the pattern that couples
   * them: the neighbour's row if it comes after the node, else the node's row. */
  struct Adjacency
  {
    explicit Adjacency(const SymmetricPattern &pattern);

    std::vector<std::uint32_t> start; ///< n_owned + 1 positions into the other two
    std::vector<std::uint32_t> neighbor;
    std::vector<std::uint32_t> entry;
  };


  constexpr std::uint32_t no_aggregate = static_cast<std::uint32_t>(-1);


  /**
   * Parts the owned nodes of a matrix into aggregates of nodes that are coupled strongly,
   *
   *   |A_ij| > threshold (|D_i| |D_j|)^(1/2)   in Frobenius' norm.
   *
   * With @p size zero these are whole neighbourhoods of nodes (Vanek, Mandel, Brezina 1996), else
   * patches of at most so many nodes that grow from node to node. A node without strong couplings
   * is in no aggregate: smoothing is enough for it.
   *
   * @param n_aggregates is set
   * @return for each owned node its aggregate, or no_aggregate
   */
  template <unsigned int B>
  std::vector<std::uint32_t>
  aggregate(const BlockSmoother<B> &matrix,
            const Adjacency &adjacency,
            unsigned int size,
            std::uint32_t &n_aggregates);
} // namespace Supple

#endif
