#ifndef supple_finer_mesh_h
#define supple_finer_mesh_h

#include <supple/mesh/mesh_parameters.h>

#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /** Whether every edge of a mesh can be cut into this many, so that its vertices stay where they
   * are: into any number in generated shapes, into 2, 4, 8, ... in meshes from files. */
  bool
  can_be_cut(const MeshParameters &mesh, unsigned int n_parts);


  /** The entries of a scene, as in "Mesh/Box cubes" and "4, 16, 4", that make its mesh one whose
   * edges are cut into @p n_parts; can_be_cut() must hold. */
  std::vector<std::pair<std::string, std::string>>
  entries_of_finer(const MeshParameters &mesh, unsigned int n_parts);
} // namespace Supple

#endif
