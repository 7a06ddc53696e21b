#ifndef supple_halo_h
#define supple_halo_h

#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace Supple
{
  /**
   * Brings what other processes know of this process's ghost nodes: for anything kept per node, in
   * arrays of n_local entries with the owned nodes first. Who sends what to whom is deal.II's
   * partitioner's knowledge. Nothing happens on a single process.
   */
  class Halo
  {
  public:
    /** @param dofs three degrees of freedom for each node */
    explicit Halo(std::shared_ptr<const dealii::Utilities::MPI::Partitioner> dofs);

    template <class Value>
    void
    update(Value *nodal) const
    {
      update(reinterpret_cast<char *>(nodal), sizeof(Value));
    }

    /** The same for @p size bytes a node. */
    void
    update(char *nodal, std::size_t size) const;

    bool
    single() const
    {
      return dofs->n_mpi_processes() == 1;
    }

    MPI_Comm
    communicator() const
    {
      return dofs->get_mpi_communicator();
    }

    const unsigned int n_owned; ///< nodes
    const unsigned int n_local; ///< nodes, ghosts included

  private:
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> dofs;
    std::vector<unsigned int> sent; ///< owned nodes, process by process
    mutable std::vector<char> buffer;
    mutable std::vector<MPI_Request> requests;
  };
} // namespace Supple

#endif
