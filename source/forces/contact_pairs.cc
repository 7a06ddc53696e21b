#include <supple/forces/contact_pairs.h>

#include <supple/forces/barrier.h>
#include <supple/forces/closest_points.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace Supple
{
  namespace
  {
    /** A point of a rule of integration: its barycentric coordinates, each as heavy as the others.
     */
    using RulePoint = std::array<double, 3>;


    /** Exact for quadratic functions on triangles, for cubic ones on edges. */
    const std::vector<RulePoint> &
    rule(const unsigned int n_nodes)
    {
      constexpr double inner = 2. / 3., outer = 1. / 6.;
      constexpr double near = 0.788675134594813, far = 0.211324865405187; // (1 +- 1/sqrt(3))/2
      static const std::vector<RulePoint> of_triangle = {{{inner, outer, outer}},
                                                         {{outer, inner, outer}},
                                                         {{outer, outer, inner}}};
      static const std::vector<RulePoint> of_edge     = {{{near, far, 0.}}, {{far, near, 0.}}};
      return n_nodes == 3 ? of_triangle : of_edge;
    }


    Arrow
    sum_of(const SurfacePart &part, const std::array<double, 3> &c, const Corners &x)
    {
      Arrow place;
      for (unsigned int v = 0; v < part.n; ++v)
        place += c[v] * x[v];
      return place;
    }


    /** Finds the pairs of one tool. */
    class Finder
    {
    public:
      Finder(const PlacedTool &tool, const unsigned int number, std::vector<ContactPair> &pairs)
        : tool(tool)
        , length(tool.end - tool.begin)
        , is_point(length.norm_square() == 0.)
        , number(number)
        , pairs(pairs)
      {
      }

      /** Whether all of the part is farther away than the barrier reaches. */
      bool
      is_far(const SurfacePart &part, const Corners &x) const
      {
        Arrow center;
        for (unsigned int v = 0; v < part.n; ++v)
          center += x[v] / part.n;
        double radius = 0.;
        for (unsigned int v = 0; v < part.n; ++v)
          radius = std::max(radius, (x[v] - center).norm_square());
        return gap_of_point(center) - std::sqrt(radius) >= tool.reach;
      }

      void
      add_point(const SurfacePart &part, const Corners &x, const RulePoint &c, const double weight)
      {
        ContactPair pair = make_pair(part, weight);
        pair.guards      = part.n == 1;
        pair.c           = c;
        const Arrow from = sum_of(part, c, x);
        if (tool.is_plane)
          {
            set_height(pair, from);
            return;
          }
        const PlaceOnSegment place = closest_on_segment(from, tool.begin, tool.end);
        add_freedom_of_tool(pair, place);
        set_distance(pair, from, tool.begin + place.t * length);
      }

      void
      add_edge(const SurfacePart &part, const Corners &x, const double weight)
      {
        ContactPair pair  = make_pair(part, weight);
        const auto places = closest_of_segments(x[0], x[1], tool.begin, tool.end);
        pair.c            = {{1. - places[0].t, places[0].t, 0.}};
        if (places[0].inside)
          {
            pair.dc[0] = {{-1., 1., 0.}};
            pair.J[0]  = x[1] - x[0];
            ++pair.n_free;
          }
        add_freedom_of_tool(pair, places[1]);
        if (!is_point)
          soften_where_parallel(pair, x[1] - x[0]);
        set_distance(pair, sum_of(part, pair.c, x), tool.begin + places[1].t * length);
      }

      /** The ends of the tool against an edge of a plane body. */
      void
      add_ends_to_edge(const SurfacePart &part, const Corners &x, const double weight)
      {
        for (const Arrow &end : {tool.begin, tool.end})
          {
            ContactPair pair           = make_pair(part, weight);
            const PlaceOnSegment place = closest_on_segment(end, x[0], x[1]);
            pair.c                     = {{1. - place.t, place.t, 0.}};
            pair.n_free                = place.inside ? 1 : 0;
            pair.dc[0]                 = {{-1., 1., 0.}};
            pair.J[0]                  = x[1] - x[0];
            set_distance(pair, sum_of(part, pair.c, x), end);
          }
      }

      /** The ends of the tool against a triangle. */
      void
      add_ends_to_triangle(const SurfacePart &part, const Corners &x, const double weight)
      {
        for (const Arrow &end : {tool.begin, tool.end})
          {
            ContactPair pair            = make_pair(part, weight);
            const PlaceOnTriangle place = closest_on_triangle(end, x);
            pair.c                      = place.w;
            pair.n_free                 = place.n_directions;
            pair.dc                     = place.directions;
            for (unsigned int k = 0; k < pair.n_free; ++k)
              pair.J[k] = sum_of(part, pair.dc[k], x);
            set_distance(pair, sum_of(part, pair.c, x), end);
            if (is_point)
              return;
          }
      }

      const PlacedTool &tool;
      const Arrow length;
      const bool is_point;

    private:
      double
      gap_of_point(const Arrow &point) const
      {
        if (tool.is_plane)
          return tool.normal * (point - tool.begin) - tool.offset;
        const PlaceOnSegment place = closest_on_segment(point, tool.begin, tool.end);
        return (point - tool.begin - place.t * length).norm() - tool.offset;
      }

      ContactPair
      make_pair(const SurfacePart &part, const double weight) const
      {
        ContactPair pair;
        pair.part    = &part;
        pair.tool    = number;
        pair.guards  = true;
        pair.weight  = weight;
        pair.reach   = tool.reach;
        pair.is_flat = tool.is_plane;
        return pair;
      }

      void
      add_freedom_of_tool(ContactPair &pair, const PlaceOnSegment &place) const
      {
        if (place.inside && !is_point)
          pair.J[pair.n_free++] = -1. * length;
      }

      /** f(2 - f) with f = sin^2 of the angle over a small number, up to 1. */
      void
      soften_where_parallel(ContactPair &pair, const Arrow &edge) const
      {
        constexpr double small = 1e-3;

        const Arrow normal   = dealii::cross_product_3d(edge, length);
        const double squares = edge.norm_square() * length.norm_square();
        const double sine    = normal.norm_square() / squares; // its square
        if (!(sine < small))
          return;
        const double f = sine / small;
        pair.factor    = f * (2. - f);
        const Arrow slope =
          4. * (1. - f) / small *
          (dealii::cross_product_3d(length, normal) / squares - sine / edge.norm_square() * edge);
        pair.factor_gradient = {{-1. * slope, slope, Arrow()}};
      }

      void
      set_height(ContactPair &pair, const Arrow &from)
      {
        pair.normal   = tool.normal;
        pair.distance = tool.normal * (from - tool.begin);
        pair.place    = from - pair.distance * tool.normal;
        keep(pair);
      }

      void
      set_distance(ContactPair &pair, const Arrow &from, const Arrow &to)
      {
        pair.place    = to;
        pair.distance = (from - to).norm();
        pair.normal   = (from - to) / pair.distance;
        keep(pair);
      }

      void
      keep(ContactPair &pair)
      {
        pair.gap = pair.distance - tool.offset;
        if (pair.gap < pair.reach)
          pairs.push_back(pair);
      }

      const unsigned int number;
      std::vector<ContactPair> &pairs;
    };
  } // namespace


  bool
  ContactPair::has_fixed_weights() const
  {
    for (unsigned int k = 0; k < n_free; ++k)
      for (unsigned int v = 0; v < part->n; ++v)
        if (dc[k][v] != 0.)
          return false;
    return true;
  }


  namespace
  {
    /** d' d'^T */
    PartMatrix
    square_of_gradient(const ContactPair &pair)
    {
      const unsigned int n = 3 * pair.part->n;
      Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1> gradient(n);
      for (unsigned int k = 0; k < n; ++k)
        gradient[k] = pair.c[k / 3] * pair.normal[k % 3];
      return gradient * gradient.transpose();
    }
  } // namespace


  PartMatrix
  second_derivative(const ContactPair &pair)
  {
    const unsigned int n = 3 * pair.part->n, m = pair.n_free;
    if (pair.is_flat)
      return PartMatrix::Zero(n, n);
    PartMatrix result = -square_of_gradient(pair);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int l = k % 3; l < n; l += 3)
        result(k, l) += pair.c[k / 3] * pair.c[l / 3];
    if (m > 0)
      {
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 2> B(n, m);
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 2, 2> JJ(m, m);
        for (unsigned int k = 0; k < m; ++k)
          {
            for (unsigned int l = 0; l < n; ++l)
              B(l, k) = pair.c[l / 3] * pair.J[k][l % 3] +
                        pair.dc[k][l / 3] * pair.distance * pair.normal[l % 3];
            for (unsigned int l = 0; l < m; ++l)
              JJ(k, l) = pair.J[k] * pair.J[l];
          }
        result -= B * JJ.inverse() * B.transpose();
      }
    return result / pair.distance;
  }


  /** With fixed weights and a convex tool the distance is convex along any way across the normal,
   * so that all but the first term is negative. */
  PartMatrix
  barrier_tangent(const ContactPair &pair)
  {
    const Barrier barrier{pair.reach};
    PartMatrix result = barrier.curvature(pair.gap) * square_of_gradient(pair);
    if (pair.is_flat || pair.has_fixed_weights())
      return result;
    result += barrier.slope(pair.gap) * second_derivative(pair);
    const Eigen::SelfAdjointEigenSolver<PartMatrix> eigen(result);
    return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.).asDiagonal() *
           eigen.eigenvectors().transpose();
  }


  std::vector<ContactPair>
  find_pairs(const ContactSurface &surface,
             const double *const u,
             const std::vector<PlacedTool> &tools,
             const double guard)
  {
    std::vector<ContactPair> pairs;
    for (unsigned int number = 0; number < tools.size(); ++number)
      {
        Finder finder(tools[number], number, pairs);
        const auto for_near = [&](const std::vector<SurfacePart> &parts, const auto &add) {
          for (const SurfacePart &part : parts)
            if (const Corners x = surface.corners(part, u); !finder.is_far(part, x))
              add(part, x);
        };
        for_near(surface.vertices, [&](const SurfacePart &part, const Corners &x) {
          finder.add_point(part, x, {{1., 0., 0.}}, guard * part.measure);
        });
        for_near(surface.faces(), [&](const SurfacePart &part, const Corners &x) {
          const std::vector<RulePoint> &points = rule(part.n);
          for (const RulePoint &c : points)
            finder.add_point(part, x, c, part.measure / points.size());
        });
        if (finder.tool.is_plane)
          continue;
        for_near(surface.edges, [&](const SurfacePart &part, const Corners &x) {
          finder.add_edge(part, x, guard * part.measure);
        });
        for_near(surface.triangles, [&](const SurfacePart &part, const Corners &x) {
          finder.add_ends_to_triangle(part, x, guard * part.measure);
        });
        if (surface.triangles.empty() && !finder.is_point)
          for_near(surface.edges, [&](const SurfacePart &part, const Corners &x) {
            finder.add_ends_to_edge(part, x, guard * part.measure);
          });
      }
    return pairs;
  }


  double
  gap_of(const SurfacePart &part, const Corners &x, const PlacedTool &tool)
  {
    if (tool.is_plane)
      {
        double least = tool.normal * (x[0] - tool.begin);
        for (unsigned int v = 1; v < part.n; ++v)
          least = std::min(least, tool.normal * (x[v] - tool.begin));
        return least - tool.offset;
      }
    if (part.n == 3)
      return distance_to_segment(x, tool.begin, tool.end) - tool.offset;
    const Arrow length = tool.end - tool.begin;
    if (part.n == 1)
      return (x[0] - tool.begin - closest_on_segment(x[0], tool.begin, tool.end).t * length)
               .norm() -
             tool.offset;
    const auto places = closest_of_segments(x[0], x[1], tool.begin, tool.end);
    return (x[0] + places[0].t * (x[1] - x[0]) - tool.begin - places[1].t * length).norm() -
           tool.offset;
  }
} // namespace Supple
