#ifndef supple_closest_points_h
#define supple_closest_points_h

#include <deal.II/base/tensor.h>

#include <array>

namespace Supple
{
  /** A direction, a place or a distance between places [m]. */
  using Arrow = dealii::Tensor<1, 3>;

  /** Places of the nodes of a vertex, an edge or a triangle [m]. */
  using Corners = std::array<Arrow, 3>;


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
  closest_on_triangle(const Arrow &point, const Corners &x);


  /** A point, a segment or a triangle, by the places of its 1, 2 or 3 corners. */
  struct Simplex
  {
    unsigned int n;
    Corners x;

    /** sum c_i x_i */
    Arrow
    place(const std::array<double, 3> &c) const
    {
      return n == 1   ? c[0] * x[0]
             : n == 2 ? c[0] * x[0] + c[1] * x[1]
                      : c[0] * x[0] + c[1] * x[1] + c[2] * x[2];
    }

    /** The mean of the corners. */
    Arrow
    center() const;

    /** At a part of a straight way of each corner [m]. */
    Simplex
    moved(const Corners &way, double part) const;
  };


  /** Places on two simplices, sum a_i x_i and sum b_i y_i, that are nearest to each other, and the
   * directions in which they may move: where the distance is least its derivatives along these are
   * zero. */
  struct NearestPlaces
  {
    std::array<double, 3> a{}, b{};
    unsigned int n_directions = 0;
    std::array<std::array<double, 3>, 2> da{}, db{}; ///< derivatives of a and b
  };


  /** Of a point and anything, or of two segments. */
  NearestPlaces
  nearest_places(const Simplex &x, const Simplex &y);


  /** Between any two simplices [m]; 0 where they cross. */
  double
  distance(const Simplex &x, const Simplex &y);


  /** Whether a segment goes through a triangle. */
  bool
  goes_through(const Corners &triangle, const Arrow &a, const Arrow &b);
} // namespace Supple

#endif
