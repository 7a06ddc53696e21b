#ifndef supple_partition_h
#define supple_partition_h

#include <supple/mesh/serial_mesh.h>

#include <mpi.h>

#include <vector>

namespace Supple
{
  /** What one process gets of a mesh: its own cells and those that share a vertex with them. */
  struct MeshPart
  {
    SerialMesh mesh; ///< of these cells, numbered anew in the order of the whole one
    std::vector<unsigned int> serial_vertex; ///< indices of its vertices in the whole mesh
    std::vector<unsigned int> serial_cell;   ///< indices of its cells in the whole mesh
    std::vector<unsigned int> serial_middle; ///< numbers of its middle nodes in the whole mesh,
                                             ///< which come after those of all vertices
    std::vector<unsigned int> owner;         ///< the process of each of its cells
    unsigned int n_patches = 0;              ///< on all processes

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &mesh &serial_vertex &serial_cell &serial_middle &owner &n_patches;
    }
  };


  /**
   * The process each cell shall belong to: about equally many for each and few faces between them,
   * by METIS; a patch is not cut. Each process has a cell.
   * @throws InputError if there are more processes than cells, or patches
   */
  std::vector<unsigned int>
  partition(const SerialMesh &mesh, unsigned int n_processes);


  /**
   * Gives each process its part of a mesh. The whole one and the owners of its cells count on the
   * first process alone, which makes the parts and sends them off one after the other; collective.
   * Patches are numbered process by process.
   */
  MeshPart
  distribute(SerialMesh mesh, std::vector<unsigned int> owner, MPI_Comm communicator);
} // namespace Supple

#endif
