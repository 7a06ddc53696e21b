#ifndef supple_closest_points_h
#define supple_closest_points_h

#include <supple/forces/tool.h>

#include <array>

namespace Supple
{
  /** Of a segment a + t (b - a), 0 <= t <= 1. */
  struct PlaceOnSegment
  {
    double t;
    bool inside; ///< not at one of the ends
  };


  /** That nearest to a point. */
  PlaceOnSegment
  closest_on_segment(const Arrow &point, const Arrow &a, const Arrow &b);


  /** Those of two segments a0 a1 and b0 b1 that are nearest to each other. Where they are parallel,
   * one of many. */
  std::array<PlaceOnSegment, 2>
  closest_of_segments(const Arrow &a0, const Arrow &a1, const Arrow &b0, const Arrow &b1);


  /** A place on a triangle, sum w_i x_i, and the directions in which it may move: it is inside, on
   * an edge or at a vertex. */
  struct PlaceOnTriangle
  {
    std::array<double, 3> w;
    unsigned int n_directions;
    std::array<std::array<double, 3>, 2> directions; ///< derivatives of w
  };


  /** That nearest to a point (Ericson, Real-Time Collision Detection, 5.1.5). */
  PlaceOnTriangle
  closest_on_triangle(const Arrow &point, const std::array<Arrow, 3> &x);


  /** Between a segment, which may be a point, and a triangle [m]; 0 where it goes through. */
  double
  distance_to_segment(const std::array<Arrow, 3> &x, const Arrow &a, const Arrow &b);
} // namespace Supple

#endif
