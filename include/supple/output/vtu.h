#ifndef supple_vtu_h
#define supple_vtu_h

#include <supple/mesh/distributed_mesh.h>
#include <supple/output/cell_fields.h>

#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /** A deformed body as files show it. The vectors have valid ghost values. */
  struct Drawing
  {
    double time;
    unsigned int step;
    const Vector &positions; ///< of the nodes [m]
    const Vector &displacement;
    const Vector *velocity; ///< null in a static problem
    const CellFields &cells;
  };


  /** The files of a drawing: that of this process (VTU), and the record that names those of all
   * processes, @p names. */
  std::pair<std::string, std::string>
  draw(const DistributedMesh &mesh, const Drawing &drawing, const std::vector<std::string> &names);
} // namespace Supple

#endif
