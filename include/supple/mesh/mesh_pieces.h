#ifndef supple_mesh_pieces_h
#define supple_mesh_pieces_h

#include <supple/mesh/serial_mesh.h>

#include <string>

namespace Supple
{
  /** Adds another mesh as a piece that shares no vertex with what is there. Ids and names stay what
   * they are: the same one stands for parts of both.
   * @throws InputError beginning with @p origin if their cells are not of one kind, or a name
   * stands for different ids */
  void
  add_piece(SerialMesh &whole, const SerialMesh &piece, const std::string &origin);
} // namespace Supple

#endif
