#ifndef supple_edge_middles_h
#define supple_edge_middles_h

#include <supple/mesh/bisection.h>

namespace Supple
{
  /** Gives all edges of the cells, tetrahedra, nodes in their middles. */
  void
  add_middles(SerialMesh &mesh, const Bisection::Middle &middle);


  /** Gives each middle node the part of the body that its edge is in, once the vertices have
   * theirs; of several parts as SerialMesh::parts. */
  void
  find_parts_of_middles(SerialMesh &mesh);


  /**
   * The determinant of the place in a quadratic cell by its barycentric coordinates, over six, at
   * the four points of integration, then at the four vertices and the middles of the six edges
   * [m^3]: that at all places is the volume of a cell with straight edges and nodes in their
   * middles.
   */
  std::array<double, 14>
  volumes_at_places(const SerialMesh &mesh, std::size_t cell);


  /** Of a quadratic cell, by its four points [m^3]. */
  double
  quadratic_volume(const SerialMesh &mesh, std::size_t cell);


  /** @throws InputError beginning with @p origin for a cell that its curved edges fold */
  void
  check_middles(const SerialMesh &mesh, const std::string &origin);
} // namespace Supple

#endif
