#ifndef supple_barrier_h
#define supple_barrier_h

#include <cmath>

namespace Supple
{
  /**
   * The barrier of incremental potential contact (Li et al., ACM Trans. Graphics 39 (2020) 49),
   * with the gap g, the reach d and s = g/d < 1:
   *
   *   b(g) = -d (s - 1)^2 ln s,
   *
   * zero from s = 1 on, with two continuous derivatives, and infinite at s = 0. Times a stiffness
   * [Pa] it is an energy per area, and minus its derivative a pressure.
   */
  struct Barrier
  {
    double reach; ///< [m]

    double
    value(const double gap) const
    {
      const double s = gap / reach;
      return s < 1. ? -reach * (s - 1.) * (s - 1.) * std::log(s) : 0.;
    }

    /** Negative or zero. */
    double
    slope(const double gap) const
    {
      const double s = gap / reach;
      return s < 1. ? -(2. * (s - 1.) * std::log(s) + (s - 1.) * (s - 1.) / s) : 0.;
    }

    /** Positive or zero [1/m]. */
    double
    curvature(const double gap) const
    {
      const double s = gap / reach, r = (s - 1.) / s;
      return s < 1. ? -(2. * std::log(s) + 4. * r - r * r) / reach : 0.;
    }
  };
} // namespace Supple

#endif
