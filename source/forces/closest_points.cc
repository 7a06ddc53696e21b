#include <supple/forces/closest_points.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Supple
{
  using dealii::cross_product_3d;

  namespace
  {
    PlaceOnSegment
    clamped(const double t)
    {
      return {std::clamp(t, 0., 1.), t > 0. && t < 1.};
    }


    PlaceOnTriangle
    at_vertex(const unsigned int v)
    {
      PlaceOnTriangle place{{{0., 0., 0.}}, 0, {}};
      place.w[v] = 1.;
      return place;
    }


    PlaceOnTriangle
    on_edge(const unsigned int v, const unsigned int w, const double t)
    {
      PlaceOnTriangle place{{{0., 0., 0.}}, 1, {}};
      place.w[v]             = 1. - t;
      place.w[w]             = t;
      place.directions[0][v] = -1.;
      place.directions[0][w] = 1.;
      return place;
    }


    bool
    goes_through(const std::array<Arrow, 3> &x, const Arrow &a, const Arrow &b)
    {
      const Arrow normal  = cross_product_3d(x[1] - x[0], x[2] - x[0]);
      const double height = normal * (a - x[0]), other = normal * (b - x[0]);
      if (!(height * other < 0.))
        return false;
      const Arrow place = a + height / (height - other) * (b - a);
      for (unsigned int v = 0; v < 3; ++v)
        if (cross_product_3d(x[(v + 1) % 3] - x[v], place - x[v]) * normal < 0.)
          return false;
      return true;
    }
  } // namespace


  PlaceOnSegment
  closest_on_segment(const Arrow &point, const Arrow &a, const Arrow &b)
  {
    const Arrow way     = b - a;
    const double square = way.norm_square();
    return clamped(square > 0. ? way * (point - a) / square : 0.);
  }


  std::array<PlaceOnSegment, 2>
  closest_of_segments(const Arrow &a0, const Arrow &a1, const Arrow &b0, const Arrow &b1)
  {
    const Arrow u = a1 - a0, v = b1 - b0, w = a0 - b0;
    const double uu = u * u, uv = u * v, vv = v * v, uw = u * w, vw = v * w;
    const double determinant = uu * vv - uv * uv;
    if (determinant > 1e-14 * uu * vv)
      {
        const double s = (uv * vw - vv * uw) / determinant, t = (uu * vw - uv * uw) / determinant;
        if (s > 0. && s < 1. && t > 0. && t < 1.)
          return {{{s, true}, {t, true}}};
      }

    std::array<PlaceOnSegment, 2> best{};
    double least    = std::numeric_limits<double>::max();
    const auto take = [&](const PlaceOnSegment &s, const PlaceOnSegment &t) {
      const double square = (w + s.t * u - t.t * v).norm_square();
      if (square < least)
        best = {{s, t}};
      least = std::min(least, square);
    };
    for (const double end : {0., 1.})
      {
        take(closest_on_segment(b0 + end * v, a0, a1), {end, false});
        take({end, false}, closest_on_segment(a0 + end * u, b0, b1));
      }
    return best;
  }


  PlaceOnTriangle
  closest_on_triangle(const Arrow &point, const std::array<Arrow, 3> &x)
  {
    const Arrow u = x[1] - x[0], v = x[2] - x[0];
    std::array<double, 3> along_u, along_v; // of the way from each vertex to the point
    for (unsigned int k = 0; k < 3; ++k)
      {
        along_u[k] = u * (point - x[k]);
        along_v[k] = v * (point - x[k]);
      }
    if (along_u[0] <= 0. && along_v[0] <= 0.)
      return at_vertex(0);
    if (along_u[1] >= 0. && along_v[1] <= along_u[1])
      return at_vertex(1);
    if (along_v[2] >= 0. && along_u[2] <= along_v[2])
      return at_vertex(2);

    const double w2 = along_u[0] * along_v[1] - along_u[1] * along_v[0];
    if (w2 <= 0. && along_u[0] >= 0. && along_u[1] <= 0.)
      return on_edge(0, 1, along_u[0] / (along_u[0] - along_u[1]));
    const double w1 = along_u[2] * along_v[0] - along_u[0] * along_v[2];
    if (w1 <= 0. && along_v[0] >= 0. && along_v[2] <= 0.)
      return on_edge(0, 2, along_v[0] / (along_v[0] - along_v[2]));
    const double w0  = along_u[1] * along_v[2] - along_u[2] * along_v[1];
    const double at1 = along_v[1] - along_u[1], at2 = along_u[2] - along_v[2];
    if (w0 <= 0. && at1 >= 0. && at2 >= 0.)
      return on_edge(1, 2, at1 / (at1 + at2));

    const double sum = w0 + w1 + w2;
    return {{{w0 / sum, w1 / sum, w2 / sum}}, 2, {{{{-1., 1., 0.}}, {{-1., 0., 1.}}}}};
  }


  double
  distance_to_segment(const std::array<Arrow, 3> &x, const Arrow &a, const Arrow &b)
  {
    if (goes_through(x, a, b))
      return 0.;
    double least    = std::numeric_limits<double>::max();
    const auto take = [&](const Arrow &way) { least = std::min(least, way.norm_square()); };
    for (const Arrow &end : {a, b})
      {
        const PlaceOnTriangle place = closest_on_triangle(end, x);
        take(place.w[0] * x[0] + place.w[1] * x[1] + place.w[2] * x[2] - end);
      }
    for (unsigned int v = 0; v < 3; ++v)
      {
        const Arrow &from = x[v], &to = x[(v + 1) % 3];
        const auto places = closest_of_segments(from, to, a, b);
        take(from + places[0].t * (to - from) - a - places[1].t * (b - a));
      }
    return std::sqrt(least);
  }
} // namespace Supple
