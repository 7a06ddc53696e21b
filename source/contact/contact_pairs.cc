#include <supple/contact/contact_pairs.h>

#include <supple/contact/barrier.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using dealii::cross_product_3d;

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


    /** Two places, one of the surface and one of a tool or the surface, as a pair. */
    class PairMaker
    {
    public:
      /** @param u displacement of all local nodes [m]
       * @param tool null for the surface itself */
      PairMaker(const ContactSurface &surface,
                const double *const u,
                const PlacedTool *const tool,
                const unsigned int number,
                const double reach,
                std::vector<ContactPair> &pairs)
        : tool(tool)
        , reach(tool ? tool->reach : reach)
        , offset(tool ? tool->offset : 0.)
        , surface(surface)
        , u(u)
        , number(number)
        , pairs(pairs)
      {
      }

      Simplex
      simplex(const SurfacePart &part) const
      {
        return surface.simplex(part, u);
      }

      Simplex
      other_simplex(const SurfacePart &part) const
      {
        return tool ? part.at(tool->points) : simplex(part);
      }

      /** A point of the part and the nearest one of the other, which may be the whole plane. */
      void
      add_point(const SurfacePart &part,
                const RulePoint &c,
                const SurfacePart *const other,
                const double weight,
                const bool guards)
      {
        const Arrow point = simplex(part).place(c);
        ContactPair pair  = make_pair(part, tool ? nullptr : other, weight);
        pair.guards       = guards;
        std::copy_n(c.begin(), part.n, pair.c.begin());
        if (!other)
          {
            set_height(pair, point);
            return;
          }
        const Simplex there        = other_simplex(*other);
        const NearestPlaces places = nearest_places({1, {{point}}}, there);
        set_other_side(pair, part.n, there, places);
        set_distance(pair, point, there.place(places.b));
      }

      /** The nearest places of two parts. */
      void
      add_parts(const SurfacePart &part, const SurfacePart &other, const double weight)
      {
        const Simplex here = simplex(part), there = other_simplex(other);
        const NearestPlaces places = nearest_places(here, there);
        ContactPair pair           = make_pair(part, tool ? nullptr : &other, weight);
        std::copy_n(places.a.begin(), part.n, pair.c.begin());
        set_other_side(pair, part.n, there, places);
        for (unsigned int k = 0; k < pair.n_free; ++k)
          {
            std::copy_n(places.da[k].begin(), part.n, pair.dc[k].begin());
            pair.J[k] += here.place(places.da[k]);
          }
        if (part.n == 2 && other.n == 2)
          soften_where_parallel(pair, here.x[1] - here.x[0], there.x[1] - there.x[0]);
        set_distance(pair, here.place(places.a), there.place(places.b));
      }

      const PlacedTool *const tool;
      const double reach, offset; ///< [m]

    private:
      ContactPair
      make_pair(const SurfacePart &part, const SurfacePart *const other, const double weight) const
      {
        ContactPair pair;
        pair.part    = &part;
        pair.other   = other;
        pair.tool    = tool ? number : ContactPair::no_tool;
        pair.guards  = true;
        pair.weight  = weight;
        pair.reach   = reach;
        pair.n       = part.n + (other ? other->n : 0);
        pair.is_flat = tool && tool->is_plane();
        std::copy_n(part.nodes.begin(), part.n, pair.nodes.begin());
        if (other)
          std::copy_n(other->nodes.begin(), other->n, pair.nodes.begin() + part.n);
        return pair;
      }

      /** Weights and directions on the other side. */
      static void
      set_other_side(ContactPair &pair,
                     const unsigned int first,
                     const Simplex &there,
                     const NearestPlaces &places)
      {
        pair.n_free = places.n_directions;
        for (unsigned int k = 0; k < pair.n_free; ++k)
          pair.J[k] = -1. * there.place(places.db[k]);
        for (unsigned int v = first; v < pair.n; ++v)
          {
            pair.c[v] = -places.b[v - first];
            for (unsigned int k = 0; k < pair.n_free; ++k)
              pair.dc[k][v] = -places.db[k][v - first];
          }
      }

      /** f(2 - f) with f = sin^2 of the angle over a small number, up to 1. */
      static void
      soften_where_parallel(ContactPair &pair, const Arrow &edge, const Arrow &other)
      {
        constexpr double small = 1e-3;

        const Arrow normal   = cross_product_3d(edge, other);
        const double squares = edge.norm_square() * other.norm_square();
        const double sine    = normal.norm_square() / squares; // its square
        if (!(sine < small))
          return;
        const double f     = sine / small;
        const double scale = 4. * (1. - f) / small;
        pair.factor        = f * (2. - f);
        pair.other_edge    = other;
        const Arrow slope =
          scale * (cross_product_3d(other, normal) / squares - sine / edge.norm_square() * edge);
        const Arrow other_slope =
          scale * (cross_product_3d(normal, edge) / squares - sine / other.norm_square() * other);
        pair.factor_gradient[0] = -1. * slope;
        pair.factor_gradient[1] = slope;
        pair.factor_gradient[2] = -1. * other_slope;
        pair.factor_gradient[3] = other_slope;
      }

      void
      set_height(ContactPair &pair, const Arrow &from)
      {
        pair.normal   = tool->normal;
        pair.distance = tool->normal * (from - tool->points[0]);
        pair.place    = from - pair.distance * tool->normal;
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
        pair.gap = pair.distance - offset;
        if (pair.gap < pair.reach)
          pairs.push_back(pair);
      }

      const ContactSurface &surface;
      const double *const u;
      const unsigned int number;
      std::vector<ContactPair> &pairs;
    };


    /** Adds for each point of the rule on the first part of each candidate the pair with the
     * nearest of the others. @param share of the area */
    void
    add_rule_points(PairMaker &maker,
                    const std::vector<SurfacePart> &faces,
                    const std::vector<SurfacePart> &others,
                    const std::vector<Candidate> &candidates,
                    const double share)
    {
      for (std::size_t first = 0, end = 0; first < candidates.size(); first = end)
        {
          const SurfacePart &face = faces[candidates[first].one];
          while (end < candidates.size() && candidates[end].one == candidates[first].one)
            ++end;
          const Simplex here                   = maker.simplex(face);
          const std::vector<RulePoint> &points = rule(face.n);
          for (const RulePoint &c : points)
            {
              const Simplex point{1, {{here.place(c)}}};
              const SurfacePart *nearest = nullptr;
              double least               = std::numeric_limits<double>::max();
              for (std::size_t k = first; k < end; ++k)
                {
                  const SurfacePart &other = others[candidates[k].other];
                  const double there       = distance(point, maker.other_simplex(other));
                  if (there < least)
                    nearest = &other;
                  least = std::min(least, there);
                }
              if (nearest)
                maker.add_point(face, c, nearest, share * face.measure / points.size(), false);
            }
        }
    }
  } // namespace


  bool
  ContactPair::has_fixed_weights() const
  {
    if (other)
      return false;
    for (unsigned int k = 0; k < n_free; ++k)
      for (unsigned int v = 0; v < n; ++v)
        if (dc[k][v] != 0.)
          return false;
    return true;
  }


  Arrow
  ContactPair::place_of_nodes(const Body &body, const double *const u) const
  {
    Arrow place;
    for (unsigned int v = 0; v < n; ++v)
      for (unsigned int i = 0; i < 3; ++i)
        place[i] += c[v] * (body.positions[nodes[v]][i] + u[3 * nodes[v] + i]);
    return place;
  }


  namespace
  {
    /** d' d'^T */
    PairMatrix
    square_of_gradient(const ContactPair &pair)
    {
      const unsigned int n = 3 * pair.n;
      Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 18, 1> gradient(n);
      for (unsigned int k = 0; k < n; ++k)
        gradient[k] = pair.c[k / 3] * pair.normal[k % 3];
      return gradient * gradient.transpose();
    }
  } // namespace


  PairMatrix
  second_derivative(const ContactPair &pair)
  {
    const unsigned int n = 3 * pair.n, m = pair.n_free;
    if (pair.is_flat)
      return PairMatrix::Zero(n, n);
    PairMatrix result = -square_of_gradient(pair);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int l = k % 3; l < n; l += 3)
        result(k, l) += pair.c[k / 3] * pair.c[l / 3];
    if (m > 0)
      {
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 18, 2> B(n, m);
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
  PairMatrix
  barrier_tangent(const ContactPair &pair)
  {
    const Barrier barrier{pair.reach};
    PairMatrix result = barrier.curvature(pair.gap) * square_of_gradient(pair);
    if (pair.is_flat || pair.has_fixed_weights() || !pair.guards)
      return result;
    result += barrier.slope(pair.gap) * second_derivative(pair);
    const Eigen::SelfAdjointEigenSolver<PairMatrix> eigen(result);
    return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.).asDiagonal() *
           eigen.eigenvectors().transpose();
  }


  PairFinder::PairFinder(const ContactSurface &surface, const double guard, const double reach)
    : surface(surface)
    , guard(guard)
    , reach(reach)
  {
  }


  void
  PairFinder::add(std::vector<ContactPair> &pairs,
                  const double *const u,
                  const PlacedTool &tool,
                  const unsigned int number,
                  const Candidates &candidates) const
  {
    constexpr RulePoint whole = {{1., 0., 0.}};

    PairMaker maker(surface, u, &tool, number, reach, pairs);
    const std::vector<SurfacePart> &faces = surface.faces();
    if (tool.is_plane())
      {
        for (const Candidate &pair : candidates.vertex_face)
          {
            const SurfacePart &vertex = surface.vertices[pair.one];
            maker.add_point(vertex, whole, nullptr, guard * vertex.measure, true);
          }
        for (const Candidate &pair : candidates.face_face)
          {
            const SurfacePart &face              = faces[pair.one];
            const std::vector<RulePoint> &points = rule(face.n);
            for (const RulePoint &c : points)
              maker.add_point(face, c, nullptr, face.measure / points.size(), false);
          }
        return;
      }
    const SurfaceParts &core = tool.shape->parts;
    for (const Candidate &pair : candidates.vertex_face)
      {
        const SurfacePart &vertex = surface.vertices[pair.one];
        maker.add_point(vertex, whole, &core.faces()[pair.other], guard * vertex.measure, true);
      }
    add_rule_points(maker, faces, core.faces(), candidates.face_face, 1.);
    const auto add_parts = [&](const SurfacePart &part, const SurfacePart &other) {
      maker.add_parts(part, other, guard * std::min(part.measure, other.measure));
    };
    for (const Candidate &pair : candidates.edge_edge)
      add_parts(surface.edges[pair.one], core.edges[pair.other]);
    // The edges of a plane body are its faces, and have met the core of a sphere already.
    const bool edges_have_met = surface.triangles.empty() && core.edges[0].n == 1;
    for (const Candidate &pair : candidates.face_vertex)
      if (!edges_have_met)
        add_parts(faces[pair.one], core.vertices[pair.other]);
  }


  void
  PairFinder::add_own(std::vector<ContactPair> &pairs,
                      const double *const u,
                      const Candidates &candidates) const
  {
    PairMaker maker(surface, u, nullptr, 0, reach, pairs);
    const std::vector<SurfacePart> &faces = surface.faces();
    for (const Candidate &pair : candidates.vertex_face)
      {
        const SurfacePart &vertex = surface.vertices[pair.one];
        maker.add_parts(vertex, faces[pair.other], guard * vertex.measure);
      }
    add_rule_points(maker, faces, faces, candidates.face_face, 0.5);
    for (const Candidate &pair : candidates.edge_edge)
      {
        const SurfacePart &one = surface.edges[pair.one], &other = surface.edges[pair.other];
        maker.add_parts(one, other, guard * 0.5 * (one.measure + other.measure));
      }
  }
} // namespace Supple
