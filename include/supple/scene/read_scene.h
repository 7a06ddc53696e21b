#ifndef supple_read_scene_h
#define supple_read_scene_h

#include <supple/mesh/mesh.h>
#include <supple/scene/parameters.h>

#include <string>
#include <vector>

namespace Supple
{
  /**
   * Reads a scene file and applies @p overrides on top. Checks each subsection, and subsections
   * against each other.
   * @throws InputError with file, line, entry, what was found and what would be right.
   */
  Parameters
  read_scene(const std::string &file, const std::vector<Override> &overrides = {});


  /** The same of a file that was read before. */
  Parameters
  read_scene(const ParameterFile &file, const std::vector<Override> &overrides);


  /**
   * Makes the mesh of a scene, and checks that the scene asks for what a body of its dimension can
   * do. Collective. @throws InputError on all processes
   */
  Mesh
  make_mesh(const Parameters &parameters, MPI_Comm communicator);


  /**
   * Checks that a scene asks for what its body can do. A plane body does not leave its plane: what
   * would push, move or turn it out of there is refused, and for an axisymmetric one also what is
   * not the same all around. In plane stress there are no patches of cells. The entries of
   * subsection Plane are for plane bodies alone.
   * @param section of the body's mesh
   * @throws InputError
   */
  void
  check_directions(const Parameters &parameters, const Section &section);
} // namespace Supple

#endif
