#ifndef supple_mesh_format_h
#define supple_mesh_format_h

#include <string>

namespace Supple
{
  /**
   * Refuses a file that is not of a format which Gmsh's library reads well, before Gmsh sees it: a
   * text that it does not know is a script to Gmsh, and is run.
   * @throws InputError saying what the file is and, where there is one, the command that converts
   * it
   */
  void
  require_readable_format(const std::string &file);
} // namespace Supple

#endif
