#ifndef supple_block_exchange_h
#define supple_block_exchange_h

#include <supple/multigrid/coarse_level.h>

#include <map>

namespace Supple
{
  /**
   * Brings what a process has computed of blocks that others keep to them: the contributions of its
   * rows of P^T A P to a coarse matrix that is distributed over processes. An entry between nodes
   * of two processes is kept by both. Who sends which blocks to whom is found out once.
   */
  class BlockExchange
  {
  public:
    /** Where a block stands, by its nodes. */
    struct Entry
    {
      std::uint32_t row, column;
    };

    using Entries = std::map<unsigned int, std::vector<Entry>>; ///< for each other process

    /** Tells processes what this one contributes to; collective.
     * @param sent nodes counted over all processes; the row is the one that comes after the other
     * in the local numbers of this process */
    BlockExchange(const Entries &sent, MPI_Comm communicator);

    /** The entries that others contribute to, at least one of whose nodes is this process's own. */
    const Entries received;

    /**
     * To be called once when the pattern is known.
     * @param between_ghosts those entries of this process that others keep; their blocks stand
     * after those of the matrix's pattern
     */
    void
    find_places(const CoarseLevel &level, const SymmetricPattern &between_ghosts);

    /** Adds what other processes have computed of this one's blocks. */
    void
    sum(CoarseMatrix &matrix) const;

  private:
    struct Place
    {
      std::uint32_t index;
      bool diagonal;
      bool mirrored; ///< the sender has the transpose of what stands here
    };

    struct Neighbor
    {
      unsigned int process;
      std::vector<Place> places;
    };

    const MPI_Comm communicator;
    const Entries sent;
    std::vector<Neighbor> targets, sources;
  };
} // namespace Supple

#endif
