#ifndef supple_safe_way_h
#define supple_safe_way_h

#include <supple/forces/contact_surface.h>

namespace Supple
{
  /**
   * The largest part, up to 1, of a way on which a tool and a part of the surface keep at least a
   * tenth of their gap: by steps no longer than the distance allows, the additive continuous
   * collision detection of Li, Kaufman and Jiang, ACM Trans. Graphics 40 (2021) 104. Never too
   * large; 0 without a gap.
   * @param x   where the nodes of the part begin [m]
   * @param way of each of them, a straight line [m]
   */
  double
  safe_part(const SurfacePart &part,
            const Corners &x,
            const Corners &way,
            const Tool &tool,
            const Pose &from,
            const Pose &to);
} // namespace Supple

#endif
