#ifndef supple_mesh_counts_h
#define supple_mesh_counts_h

#include <supple/mesh/mesh_parameters.h>

#include <string>
#include <vector>

namespace Supple
{
  /** Counts of intervals that an entry of a generated shape says. */
  struct MeshCounts
  {
    std::string entry;
    std::vector<unsigned int> intervals;
    unsigned int added = 0; ///< by how much the entry's numbers are larger than the intervals
  };


  /** All that must be multiplied, or halved, for a mesh of cells of another size; none of a mesh
   * from a file. */
  std::vector<MeshCounts>
  counts_of(const MeshParameters &mesh);
} // namespace Supple

#endif
