#ifndef supple_patches_h
#define supple_patches_h

#include <supple/mesh/serial_mesh.h>

namespace Supple
{
  /**
   * Groups the cells of a mesh into compact patches of about eight linear tetrahedra, twelve
   * quadratic ones, or four triangles, of the same material: each grows through shared faces, and
   * takes next the cell that brings the fewest new vertices, and of those the one that shares the
   * most faces with it. What is left over in patches of less than half that size goes to neighbours
   * one cell at a time, where there are any.
   *
   * It looks at the mesh alone, so that the patches do not depend on the number of processes.
   *
   * @return the number of each cell's patch, from 0 on
   */
  std::vector<unsigned int>
  make_patches(const SerialMesh &mesh);
} // namespace Supple

#endif
