#ifndef supple_plane_check_h
#define supple_plane_check_h

#include <supple/mesh/serial_mesh.h>

namespace Supple
{
  /**
   * Whether a scene asks for what its body can do. A plane body does not leave its plane: what
   * would push, move or turn it out of there is refused, and for an axisymmetric one also what is
   * not the same all around. The entries of subsection Plane are for plane bodies alone.
   * @throws InputError
   */
  void
  check_directions(const Parameters &parameters, const Section &section);

  /**
   * Puts the vertices of an axisymmetric body that are as good as on the axis onto it.
   * @throws InputError if there are any beyond it
   */
  void
  fit_to_axis(SerialMesh &mesh, const Parameters &parameters);
} // namespace Supple

#endif
