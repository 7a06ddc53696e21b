#ifndef supple_gmsh_reader_h
#define supple_gmsh_reader_h

#include <supple/mesh/file_mesh.h>

namespace Supple
{
  /** Reads a .msh file of Gmsh, ASCII or binary: version 4 by its library, versions 1 and 2 by
   * read_msh().
   * @throws InputError if it can't be read, or not all of it */
  FileMesh
  read_gmsh(const std::string &file);
} // namespace Supple

#endif
