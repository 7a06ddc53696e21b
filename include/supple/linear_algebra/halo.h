#ifndef supple_halo_h
#define supple_halo_h

#include <supple/linear_algebra/lanes.h>

#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace Supple
{
  /**
   * Brings what other processes know of this process's ghost nodes, and to them what this one has
   * computed for theirs: for anything kept per node, in arrays of n_local entries with the owned
   * nodes first. Who sends what to whom is deal.II's partitioner's knowledge. Nothing happens on a
   * single process.
   */
  class Halo
  {
  public:
    /** @param indices n_per_node in turn for each node */
    Halo(std::shared_ptr<const dealii::Utilities::MPI::Partitioner> indices,
         unsigned int n_per_node);

    template <class Value>
    void
    update(Value *nodal) const
    {
      update(reinterpret_cast<char *>(nodal), sizeof(Value));
    }

    /** The same for @p size bytes a node. */
    void
    update(char *nodal, std::size_t size) const;

    /** Adds the values at ghosts to those that their owners have. */
    template <unsigned int B>
    void
    add_ghosts(NodeValues<B> *nodal) const
    {
      if (single())
        return;
      fetch_ghosts(reinterpret_cast<const char *>(nodal), sizeof(NodeValues<B>));
      const auto *part = reinterpret_cast<const float *>(buffer.data());
      for (const unsigned int node : shared)
        {
          nodal[node].lanes += load<Lanes<float, B>>(part);
          part += sizeof(NodeValues<B>) / sizeof(float);
        }
    }

    bool
    single() const
    {
      return indices->n_mpi_processes() == 1;
    }

    MPI_Comm
    communicator() const
    {
      return indices->get_mpi_communicator();
    }

    const unsigned int n_owned; ///< nodes
    const unsigned int n_local; ///< nodes, ghosts included

  private:
    /** Fills the buffer with what others have at the shared nodes. */
    void
    fetch_ghosts(const char *nodal, std::size_t size) const;

    /** Processes, and how many indices each. */
    using Targets = std::vector<std::pair<unsigned int, unsigned int>>;

    /** Receives what senders have of @p size bytes a node one after the other, and sends likewise.
     */
    void
    exchange(const Targets &senders,
             char *incoming,
             const Targets &receivers,
             const char *outgoing,
             std::size_t size) const;

    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> indices;
    const unsigned int n_per_node;
    std::vector<unsigned int> shared; ///< owned nodes that are ghosts elsewhere, process by process
    mutable std::vector<char> buffer;
    mutable std::vector<MPI_Request> requests;
  };
} // namespace Supple

#endif
