#ifndef supple_msh_writer_h
#define supple_msh_writer_h

#include <supple/mesh/serial_mesh.h>

#include <string>

namespace Supple
{
  /**
   * A mesh as the text of a .msh file of version 2.2, which Gmsh, meshio and read_msh() read: cells
   * with their material ids and faces of the surface with their boundary ids as physical groups,
   * names of groups, and all digits of the vertices. Gmsh takes no group with the number 0:
   * Supple's id 0 of cells without a group stays 0 in the file and is no group there.
   */
  std::string
  msh_text(const SerialMesh &mesh);
} // namespace Supple

#endif
