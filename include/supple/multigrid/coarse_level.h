#ifndef supple_coarse_level_h
#define supple_coarse_level_h

#include <supple/linear_algebra/halo.h>
#include <supple/multigrid/block_smoother.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace Supple
{
  /**
   * The matrix of a coarse level: six unknowns a node, blocks with rows of eight.
   *
   * After the blocks of the pattern and of owned nodes' diagonal stand those that other processes
   * keep and this one contributes to: between two ghosts, and on the diagonal of ghosts.
   */
  struct CoarseMatrix
  {
    struct Block
    {
      Lanes<double, 6> row[6];
    };

    SymmetricPattern pattern;
    std::vector<Block> lower, diagonal;

    MatrixView<6>
    view() const
    {
      return {pattern,
              reinterpret_cast<const double *>(lower.data()),
              reinterpret_cast<const double *>(diagonal.data())};
    }
  };


  /**
   * The two numbers that a node of a coarse level has: counted over all processes, one after the
   * other, and as this process counts those it knows, its own first, then ghosts. They are the same
   * where a process has the whole level.
   */
  struct NodeNumbers
  {
    bool
    owns(const std::uint32_t global) const
    {
      return global >= first_own && global - first_own < n_owned;
    }

    /** Of a node that is known. */
    std::uint32_t
    local(std::uint32_t global) const;

    std::uint32_t
    global(const std::uint32_t local) const
    {
      return local < n_owned ? first_own + local : ghosts[local - n_owned];
    }

    /** Sorts the ghosts, and leaves those out that are not. */
    void
    complete();

    std::uint32_t
    n_local() const
    {
      return n_owned + ghosts.size();
    }

    std::uint32_t first_own = 0;
    std::uint32_t n_owned   = 0;
    std::vector<std::uint32_t> ghosts; ///< counted over all processes, ascending
  };


  /** A coarse level, distributed over processes or whole on each of them. */
  struct CoarseLevel
  {
    std::uint32_t n_nodes = 0; ///< on all processes
    NodeNumbers numbers;
    std::unique_ptr<Halo> halo; ///< null where each process has the whole level
    CoarseMatrix matrix;
    std::vector<double> modes; ///< rigid motions at owned nodes, 36 numbers for each
  };
} // namespace Supple

#endif
