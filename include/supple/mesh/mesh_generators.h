#ifndef supple_mesh_generators_h
#define supple_mesh_generators_h

#include <supple/mesh/mesh_parameters.h>
#include <supple/mesh/serial_mesh.h>

namespace Supple
{
  /**
   * A box of cubes, each cut into six tetrahedra which share its diagonal from corner 000 to corner
   * 111 (Kuhn 1960). Vertices and cubes are numbered with x fastest, then y, then z. Boundary ids:
   * 0, 1 (x), 2, 3 (y), 4, 5 (z). Layers along y have materials of their own.
   */
  SerialMesh
  box_mesh(const MeshParameters &parameters);


  /**
   * A rectangle of squares in the plane z = 0, each cut into two triangles.
   *
   *    o---o---o
   *    |\  |  /|       falling, rising: square (i, j) is cut from vertex (i, j + 1) to (i + 1, j),
   *    | \ | / |       or from (i, j) to (i + 1, j + 1)
   *    |  \|/  |
   *    o---o---o
   *
   * Vertices and squares are numbered with x fastest. Boundary ids: 0 left, 1 right, 2 bottom, 3
   * top. Layers along y have materials of their own.
   */
  SerialMesh
  rectangle_mesh(const MeshParameters &parameters);


  /**
   * A hollow cylinder about the z axis, centred at the origin (Valera 2002): n sectors, n_rings
   * sections along the axis, one or more layers through the wall.
   *
   *      o---o---o      outer circle, half a sector ahead
   *     / \ / \ /
   *    o---o---o        inner circle
   *
   * Between two sections each of these triangles makes a wedge, cut into three tetrahedra. Vertices
   * are numbered section by section from the bottom, in each circle by circle from the inside.
   * Boundary ids: 0 inner, 1 outer, 2 bottom, 3 top.
   */
  SerialMesh
  hollow_cylinder_mesh(const MeshParameters &parameters);
} // namespace Supple

#endif
