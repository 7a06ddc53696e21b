#ifndef supple_chosen_vertices_h
#define supple_chosen_vertices_h

#include <supple/mechanics/body.h>
#include <supple/scene/parameters.h>

#include <functional>
#include <string>

namespace Supple
{
  /** Calls @p change with each entry that selects vertices, and where it was set. */
  void
  change_selections(Parameters &scene,
                    const std::function<void(std::string &, const std::string &)> &change);


  /** A scene with the nodes that its points choose on a mesh: on a finer one others may be nearer.
   * Old vertices keep their indices there; middles of edges, which may have become vertices, are
   * found by their places. Collective. @throws InputError */
  Parameters
  with_chosen_vertices(const Parameters &scene, const Body &body);
} // namespace Supple

#endif
