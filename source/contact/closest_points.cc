#include <supple/contact/closest_points.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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
  closest_on_triangle(const Arrow &point, const Corners &x)
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


  bool
  goes_through(const Corners &x, const Arrow &a, const Arrow &b)
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


  Arrow
  Simplex::center() const
  {
    Arrow center;
    for (unsigned int v = 0; v < n; ++v)
      center += x[v] / n;
    return center;
  }


  Simplex
  Simplex::moved(const Corners &way, const double part) const
  {
    Simplex there = *this;
    for (unsigned int v = 0; v < n; ++v)
      there.x[v] += part * way[v];
    return there;
  }


  namespace
  {
    NearestPlaces
    of_point_and_segment(const Arrow &point, const Simplex &y)
    {
      const PlaceOnSegment place = closest_on_segment(point, y.x[0], y.x[1]);
      NearestPlaces places;
      places.a[0]         = 1.;
      places.b            = {{1. - place.t, place.t, 0.}};
      places.n_directions = place.inside ? 1 : 0;
      places.db[0]        = {{-1., 1., 0.}};
      return places;
    }


    NearestPlaces
    of_point_and_triangle(const Arrow &point, const Simplex &y)
    {
      const PlaceOnTriangle place = closest_on_triangle(point, y.x);
      NearestPlaces places;
      places.a[0]         = 1.;
      places.b            = place.w;
      places.n_directions = place.n_directions;
      places.db           = place.directions;
      return places;
    }


    NearestPlaces
    of_segments(const Simplex &x, const Simplex &y)
    {
      const auto on = closest_of_segments(x.x[0], x.x[1], y.x[0], y.x[1]);
      NearestPlaces places;
      places.a = {{1. - on[0].t, on[0].t, 0.}};
      places.b = {{1. - on[1].t, on[1].t, 0.}};
      if (on[0].inside)
        places.da[places.n_directions++] = {{-1., 1., 0.}};
      if (on[1].inside)
        places.db[places.n_directions++] = {{-1., 1., 0.}};
      return places;
    }


    double
    distance_of_places(const Simplex &x, const Simplex &y)
    {
      const NearestPlaces places = nearest_places(x, y);
      return (x.place(places.a) - y.place(places.b)).norm();
    }


    Simplex
    edge_of(const Simplex &triangle, const unsigned int e)
    {
      return {2, {{triangle.x[e], triangle.x[(e + 1) % 3], Arrow()}}};
    }


    double
    distance_to_segment(const Simplex &triangle, const Simplex &segment)
    {
      if (goes_through(triangle.x, segment.x[0], segment.x[1]))
        return 0.;
      double least = std::numeric_limits<double>::max();
      for (unsigned int v = 0; v < 2; ++v)
        least = std::min(least, distance_of_places({1, {{segment.x[v]}}}, triangle));
      for (unsigned int e = 0; e < 3; ++e)
        least = std::min(least, distance_of_places(edge_of(triangle, e), segment));
      return least;
    }
  } // namespace


  NearestPlaces
  nearest_places(const Simplex &x, const Simplex &y)
  {
    if (x.n == 2 && y.n == 2)
      return of_segments(x, y);
    if (x.n > 1)
      {
        NearestPlaces places = nearest_places(y, x);
        std::swap(places.a, places.b);
        std::swap(places.da, places.db);
        return places;
      }
    if (y.n == 2)
      return of_point_and_segment(x.x[0], y);
    if (y.n == 3)
      return of_point_and_triangle(x.x[0], y);
    NearestPlaces places;
    places.a[0] = places.b[0] = 1.;
    return places;
  }


  double
  distance(const Simplex &x, const Simplex &y)
  {
    if (x.n + y.n <= 4)
      return distance_of_places(x, y);
    if (x.n < 3)
      return distance_to_segment(y, x);
    if (y.n < 3)
      return distance_to_segment(x, y);
    double least = std::numeric_limits<double>::max();
    for (unsigned int e = 0; e < 3; ++e)
      least = std::min(
        {least, distance_to_segment(x, edge_of(y, e)), distance_to_segment(y, edge_of(x, e))});
    return least;
  }
} // namespace Supple
