#ifndef supple_msh_reader_h
#define supple_msh_reader_h

#include <supple/mesh/file_mesh.h>

namespace Supple
{
  /** What a .msh file says of itself in its first lines. */
  struct MshFormat
  {
    double version = 1.; ///< of files that don't say it
    bool binary    = false;
    bool swapped   = false; ///< whether binary numbers have the order of bytes of another machine
  };

  MshFormat
  msh_format_of(const std::string &file);


  /** How many nodes an element has, by Gmsh's number of its kind; 0 if the kind is not known. */
  unsigned int
  n_nodes_of_kind(long kind);


  /**
   * Reads a .msh file of version 1 or 2, ASCII or binary, where each element has a group of its
   * own: Gmsh's library keeps groups by elementary number alone, and takes all elements of one
   * elementary number to be in the groups of each of them. Numbers of elements don't matter.
   * @throws InputError where the file has not what it announces
   */
  FileMesh
  read_msh(const std::string &file);
} // namespace Supple

#endif
