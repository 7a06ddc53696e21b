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


  /** A scene with the vertices that its points choose on a mesh: on a finer one, whose old vertices
   * keep their indices, others may be nearer. Collective. @throws InputError */
  Parameters
  with_chosen_vertices(const Parameters &scene, const Body &body);
} // namespace Supple

#endif
