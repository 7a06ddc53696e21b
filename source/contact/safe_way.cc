#include <supple/contact/safe_way.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  namespace
  {
    /** What is left of a gap at the end of a safe way. */
    constexpr double kept = 0.1;


    Arrow
    mean_of(const unsigned int n, const Corners &ways)
    {
      Arrow mean;
      for (unsigned int v = 0; v < n; ++v)
        mean += ways[v] / n;
      return mean;
    }


    /** The longest way, as seen from one that moves too [m]. */
    double
    longest(const unsigned int n, const Corners &ways, const Arrow &common)
    {
      double square = 0.;
      for (unsigned int v = 0; v < n; ++v)
        square = std::max(square, (ways[v] - common).norm_square());
      return std::sqrt(square);
    }


    /** No shorter than the change of the gap over the whole way. The motion that the surface and
     * the tool have in common changes nothing. */
    double
    largest_change(const Simplex &x,
                   const Corners &way,
                   const Tool &tool,
                   const SurfacePart *const of_core,
                   const ToolMotion &motion)
    {
      const auto &[from, to] = motion;
      const double turn      = (to.turn - from.turn).norm();
      if (tool.is_plane() && turn == 0.) // along the plane nothing changes
        {
          const Arrow normal = tool.placed(from).normal;
          double change      = 0.;
          for (unsigned int v = 0; v < x.n; ++v)
            change = std::max(change, std::abs(normal * (way[v] - (to.place - from.place))));
          return change;
        }
      const Arrow mean = mean_of(x.n, way);
      double lever     = 0.;
      if (of_core)
        for (unsigned int v = 0; v < of_core->n; ++v)
          lever = std::max(lever, tool.shape->points[of_core->nodes[v]].norm());
      else // the farther a vertex is from where the plane turns, the faster it is met
        for (unsigned int v = 0; v < x.n; ++v)
          lever =
            std::max(lever,
                     (x.x[v] - from.place).norm() + way[v].norm() + (to.place - from.place).norm());
      return longest(x.n, way, mean) + (to.place - from.place - mean).norm() + turn * lever;
    }


    double
    gap_of(const Simplex &x, const Tool &tool, const SurfacePart *const of_core, const Pose &pose)
    {
      if (!of_core)
        return tool.placed(pose).gap(x);
      Simplex there = of_core->at(tool.shape->points);
      for (unsigned int v = 0; v < there.n; ++v)
        there.x[v] = pose.carried(there.x[v]);
      return distance(x, there) - tool.offset;
    }


    /** @param gap_at what a part of the way leaves [m] @param change bound of its change [m] */
    template <class Gap>
    double
    safe_part_of(const Gap &gap_at, const double change)
    {
      constexpr double caution        = 0.9; // what the distance allows would be a touch
      constexpr unsigned int patience = 500; // it need not be all that is safe

      const double first = gap_at(0.);
      if (!(first > 0.))
        return 0.;
      if (first - change >= kept * first)
        return 1.;
      double safe = 0., gap = first;
      for (unsigned int n = 0; n < patience; ++n)
        {
          const double next = safe + caution * gap / change;
          if (next >= 1.)
            return 1.;
          gap = gap_at(next);
          if (gap < kept * first)
            return n == 0 && gap > 0. ? next : safe;
          safe = next;
        }
      return safe;
    }
  } // namespace


  double
  safe_part(const Simplex &x,
            const Corners &way,
            const Tool &tool,
            const SurfacePart *const of_core,
            const ToolMotion &motion)
  {
    return safe_part_of(
      [&](const double part) {
        const Pose pose = part == 0. ? motion.from : between(motion.from, motion.to, part);
        return gap_of(x.moved(way, part), tool, of_core, pose);
      },
      largest_change(x, way, tool, of_core, motion));
  }


  double
  safe_part(const Simplex &x, const Corners &way, const Simplex &other, const Corners &other_way)
  {
    const Arrow common = 0.5 * (mean_of(x.n, way) + mean_of(other.n, other_way));
    return safe_part_of(
      [&](const double part) { return distance(x.moved(way, part), other.moved(other_way, part)); },
      longest(x.n, way, common) + longest(other.n, other_way, common));
  }
} // namespace Supple
