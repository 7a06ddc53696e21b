#ifndef supple_vtu_h
#define supple_vtu_h

#include <supple/mesh/distributed_mesh.h>

#include <deal.II/lac/vector.h>

#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /** What is drawn of a deformed body. The vectors have valid ghost values. */
  struct Drawing
  {
    double time;
    unsigned int step;
    const Vector &positions; ///< of the nodes [m]
    std::vector<std::pair<std::string, const Vector *>> of_nodes;
    std::vector<std::pair<std::string, dealii::Vector<float>>> of_cells; ///< by LocalCell::index
  };


  /** The files of a drawing: that of this process (VTU), and the record that names those of all
   * processes, @p names. */
  std::pair<std::string, std::string>
  draw(const DistributedMesh &mesh, const Drawing &drawing, const std::vector<std::string> &names);
} // namespace Supple

#endif
