#ifndef supple_whole_mesh_h
#define supple_whole_mesh_h

#include <supple/mesh/mesh_check.h>
#include <supple/mesh/mesh_parameters.h>

namespace Supple
{
  /** A body's mesh as one, with what was found in it. */
  struct WholeMesh
  {
    SerialMesh mesh;
    MeshReport report;
  };


  /**
   * The mesh of a scene: generated or read, refined, put where Mesh/Map says, checked, with the
   * boundary ids of its regions. The same each time.
   * @param scene knows where the entries were set, and its folder has the mesh file
   * @throws InputError
   */
  WholeMesh
  whole_mesh(const MeshParameters &parameters,
             const PlaneParameters &plane,
             const ParameterFile &scene);


  /** Around those vertices that cells have. @param places of the vertices */
  dealii::BoundingBox<3>
  box_around(const SerialMesh &mesh, const std::vector<dealii::Point<3>> &places);
} // namespace Supple

#endif
