#ifndef supple_mesh_reader_h
#define supple_mesh_reader_h

#include <supple/mesh/serial_mesh.h>

#include <string>

namespace Supple
{
  /**
   * Reads a mesh: .msh by Gmsh (1, 2.2, 4.1, ASCII or binary), legacy .vtk, .unv, .mesh, .bdf,
   * .nas. Physical volumes become material ids and physical surfaces boundary ids, or what a format
   * has in their place; without them the material is 0 and the whole surface boundary 0. Triangles
   * in the plane z = 0 without tetrahedra are a plane body, with the same from physical surfaces
   * and curves.
   * @throws InputError in words that help if there is neither, or the file can't be read
   */
  SerialMesh
  read_mesh(const std::string &file, const std::string &origin);
} // namespace Supple

#endif
