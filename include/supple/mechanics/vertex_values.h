#ifndef supple_vertex_values_h
#define supple_vertex_values_h

#include <supple/mechanics/body.h>

#include <vector>

namespace Supple
{
  /** Three numbers of each vertex by its index in the mesh before partitioning, on the first
   * process; zeros elsewhere. Collective. @param own three numbers of each own node */
  std::vector<double>
  gathered_by_vertex(const Body &body, const double *own);

  /** Sets three numbers of each own node. @throws std::out_of_range if @p values are of another
   * mesh */
  void
  scatter_by_vertex(const Body &body, const std::vector<double> &values, double *own);
} // namespace Supple

#endif
