#ifndef supple_coarser_mesh_h
#define supple_coarser_mesh_h

#include <supple/mesh/mesh_parameters.h>

#include <string>
#include <vector>

namespace Supple
{
  /** Why a mesh has none of cells twice as large, whose vertices are among its own; empty if it has
   * one: generated shapes with even counts have. */
  std::string
  obstacle_to_coarser(const MeshParameters &mesh);


  /** A mesh of cells twice as large, whose vertices are among those of the given one; there must be
   * no obstacle_to_coarser(). */
  MeshParameters
  coarser(const MeshParameters &mesh);


  /** For each vertex of coarser(mesh) its index in the mesh itself. */
  std::vector<unsigned int>
  vertices_of_coarser(const MeshParameters &mesh);
} // namespace Supple

#endif
