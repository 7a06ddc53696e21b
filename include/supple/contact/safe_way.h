#ifndef supple_safe_way_h
#define supple_safe_way_h

#include <supple/contact/candidates.h>

namespace Supple
{
  /**
   * The largest part, up to 1, of a way on which a part of the surface and one of a tool keep at
   * least a tenth of their gap: by steps no longer than the distance allows, the additive
   * continuous collision detection of Li, Kaufman and Jiang, ACM Trans. Graphics 40 (2021) 104.
   * Never too large; 0 without a gap.
   * @param x       where the part of the surface begins [m]
   * @param way     of each of its corners, a straight line [m]
   * @param of_core part of the tool's core; null for a plane
   */
  double
  safe_part(const Simplex &x,
            const Corners &way,
            const Tool &tool,
            const SurfacePart *of_core,
            const ToolMotion &motion);


  /** The same of two parts of the surface. */
  double
  safe_part(const Simplex &x, const Corners &way, const Simplex &other, const Corners &other_way);
} // namespace Supple

#endif
