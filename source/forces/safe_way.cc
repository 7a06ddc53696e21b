#include <supple/forces/safe_way.h>

#include <supple/forces/contact_pairs.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  namespace
  {
    /** What is left of a gap at the end of a safe way. */
    constexpr double kept = 0.1;


    /** No shorter than the change of the gap over the whole way: what is common to the motion of
     * the surface and of the tool counts for nothing. */
    double
    largest_change(const SurfacePart &part,
                   const Corners &x,
                   const Corners &way,
                   const Tool &tool,
                   const Pose &from,
                   const Pose &to)
    {
      const bool is_plane = tool.parameters.shape == ToolParameters::Shape::plane;
      if (is_plane && (to.turn - from.turn).norm() == 0.) // along the plane nothing changes
        {
          const Arrow normal = tool.placed(from).normal;
          double change      = 0.;
          for (unsigned int v = 0; v < part.n; ++v)
            change = std::max(change, std::abs(normal * (way[v] - (to.place - from.place))));
          return change;
        }
      Arrow mean;
      for (unsigned int v = 0; v < part.n; ++v)
        mean += way[v] / part.n;
      double of_surface = 0., lever = tool.lever();
      for (unsigned int v = 0; v < part.n; ++v)
        {
          of_surface = std::max(of_surface, (way[v] - mean).norm());
          if (is_plane) // the farther a vertex is from where the plane turns, the faster it is met
            lever = std::max(lever, (x[v] - from.place).norm() + way[v].norm());
        }
      return of_surface + (to.place - from.place - mean).norm() +
             (to.turn - from.turn).norm() * lever;
    }
  } // namespace


  double
  safe_part(const SurfacePart &part,
            const Corners &x,
            const Corners &way,
            const Tool &tool,
            const Pose &from,
            const Pose &to)
  {
    constexpr double caution        = 0.9; // what the distance allows would be a touch
    constexpr unsigned int patience = 10000;

    const double first = gap_of(part, x, tool.placed(from));
    if (!(first > 0.))
      return 0.;
    const double change = largest_change(part, x, way, tool, from, to);
    if (first - change >= kept * first)
      return 1.;

    double safe = 0., gap = first;
    for (unsigned int n = 0; n < patience; ++n)
      {
        const double next = safe + caution * gap / change;
        if (next >= 1.)
          return 1.;
        Corners place = x;
        for (unsigned int v = 0; v < part.n; ++v)
          place[v] += next * way[v];
        gap = gap_of(part, place, tool.placed(between(from, to, next)));
        if (gap < kept * first)
          return n == 0 ? next : safe;
        safe = next;
      }
    return safe;
  }
} // namespace Supple
