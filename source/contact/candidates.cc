#include <supple/contact/candidates.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  namespace
  {
    /** A part of the surface at the start and the end of its way. */
    struct MovedSimplex
    {
      Simplex start, end;
      bool moves;

      Box
      box() const
      {
        Box box;
        box.take(start);
        if (moves)
          box.take(end);
        return box;
      }

      double
      farthest() const
      {
        double square = 0.;
        for (unsigned int v = 0; v < start.n; ++v)
          square = std::max({square, start.x[v].norm_square(), end.x[v].norm_square()});
        return std::sqrt(square);
      }
    };


    MovedSimplex
    moved(const ContactSurface &surface, const SurfaceMotion &motion, const SurfacePart &part)
    {
      const Simplex start = surface.simplex(part, motion.u);
      if (!motion.way)
        return {start, start, false};
      return {start, start.moved(ContactSurface::values(part, motion.way), 1.), true};
    }


    /** No more than between the two [m]: by spheres around them, in a small part of the time. */
    double
    lower_bound(const Simplex &one, const Simplex &other)
    {
      const Arrow here = one.center(), there = other.center();
      double radius = 0., other_radius = 0.;
      for (unsigned int v = 0; v < one.n; ++v)
        radius = std::max(radius, (one.x[v] - here).norm_square());
      for (unsigned int v = 0; v < other.n; ++v)
        other_radius = std::max(other_radius, (other.x[v] - there).norm_square());
      return (here - there).norm() - std::sqrt(radius) - std::sqrt(other_radius);
    }


    /** Whether two parts may come nearer than a distance: exact where nothing moves. */
    bool
    may_meet(const MovedSimplex &one, const MovedSimplex &other, const double distance)
    {
      Box box = one.box();
      box.grow(distance);
      return box.overlaps(other.box()) && (one.moves || other.moves ||
                                           (lower_bound(one.start, other.start) < distance &&
                                            Supple::distance(one.start, other.start) < distance));
    }


    /** Finds candidates of one tool, in the frame that it has at the start. */
    class ToolFinder
    {
    public:
      ToolFinder(const ContactSurface &surface,
                 const SurfaceMotion &motion,
                 const Tool &tool,
                 const ToolMotion &way,
                 const double distance)
        : surface(surface)
        , motion(motion)
        , tool(tool)
        , way(way)
        , turn((way.to.turn - way.from.turn).norm())
        , distance(distance + tool.offset)
      {
      }

      Candidates
      find()
      {
        const std::vector<SurfacePart> &faces = surface.faces();
        for (unsigned int f = 0; f < faces.size(); ++f)
          {
            const MovedSimplex face = in_frame(faces[f]);
            if (tool.is_plane())
              add_to_plane(f, face);
            else
              add_to_core(f, face);
          }
        return candidates;
      }

    private:
      MovedSimplex
      in_frame(const SurfacePart &part) const
      {
        MovedSimplex simplex = moved(surface, motion, part);
        for (unsigned int v = 0; v < part.n; ++v)
          {
            simplex.start.x[v] = way.from.turned_back(simplex.start.x[v] - way.from.place);
            simplex.end.x[v]   = way.from.turned_back(simplex.end.x[v] - way.to.place);
          }
        simplex.moves = motion.way || way.from.place != way.to.place || turn > 0.;
        return simplex;
      }

      /** How far off its straight way the turn of the tool takes a part at most [m]. */
      double
      reach_of_turn(const MovedSimplex &simplex) const
      {
        return turn == 0. ? 0. : turn * simplex.farthest();
      }

      void
      add_to_plane(const unsigned int f, const MovedSimplex &face)
      {
        const Arrow normal = tool.parameters.normal / tool.parameters.normal.norm();
        double lowest      = normal * face.start.x[0];
        for (unsigned int v = 0; v < face.start.n; ++v)
          lowest = std::min({lowest, normal * face.start.x[v], normal * face.end.x[v]});
        if (!(lowest - reach_of_turn(face) < distance))
          return;
        for (const unsigned int vertex : surface.represented_vertices[f])
          candidates.vertex_face.push_back({vertex, 0});
        candidates.face_face.push_back({f, 0});
      }

      void
      add_to_core(const unsigned int f, const MovedSimplex &face)
      {
        Box box           = face.box();
        const double near = distance + reach_of_turn(face);
        box.grow(near);
        if (!box.overlaps(tool.shape->bounds))
          return;
        tool.shape->find_faces(box, numbers);
        const SurfaceParts &core = tool.shape->parts;
        for (const unsigned int other : numbers)
          {
            if (!may_meet(face, of_core(core.faces()[other]), near))
              continue;
            candidates.face_face.push_back({f, other});
            for (const unsigned int vertex : surface.represented_vertices[f])
              add(candidates.vertex_face,
                  {vertex, other},
                  surface.vertices[vertex],
                  core.faces()[other]);
            for (const unsigned int vertex : core.represented_vertices[other])
              add(candidates.face_vertex, {f, vertex}, surface.faces()[f], core.vertices[vertex]);
            for (const unsigned int edge : surface.represented_edges[f])
              for (const unsigned int of_core : core.represented_edges[other])
                add(candidates.edge_edge,
                    {edge, of_core},
                    surface.edges[edge],
                    core.edges[of_core]);
          }
      }

      MovedSimplex
      of_core(const SurfacePart &part) const
      {
        const Simplex simplex = part.at(tool.shape->points);
        return {simplex, simplex, false};
      }

      void
      add(std::vector<Candidate> &list,
          const Candidate &candidate,
          const SurfacePart &one,
          const SurfacePart &other) const
      {
        const MovedSimplex simplex = in_frame(one);
        if (may_meet(simplex, of_core(other), distance + reach_of_turn(simplex)))
          list.push_back(candidate);
      }

      const ContactSurface &surface;
      const SurfaceMotion &motion;
      const Tool &tool;
      const ToolMotion &way;
      const double turn;     ///< [rad]
      const double distance; ///< between the surface and the core [m]
      Candidates candidates;
      std::vector<unsigned int> numbers; ///< at hand
    };


    /** Finds candidates of the surface with itself, as seen from its mean motion. */
    class OwnFinder
    {
    public:
      OwnFinder(const ContactSurface &surface,
                const SurfaceMotion &motion,
                const bool only_other_pieces,
                const double distance)
        : surface(surface)
        , motion(motion)
        , only_other_pieces(only_other_pieces)
        , distance(distance)
      {
        for (const unsigned int node : surface.nodes)
          for (unsigned int i = 0; motion.way && i < 3; ++i)
            mean[i] += motion.way[3 * node + i] / surface.nodes.size();
      }

      Candidates
      find()
      {
        const std::vector<SurfacePart> &faces = surface.faces();
        for (const SurfacePart &face : faces)
          simplices.push_back(seen(face));
        std::vector<Box> boxes;
        for (const MovedSimplex &simplex : simplices)
          boxes.push_back(simplex.box());
        const BoxTree tree(boxes);
        std::vector<unsigned int> others;
        for (unsigned int f = 0; f < faces.size(); ++f)
          {
            Box box = boxes[f];
            box.grow(distance);
            tree.find(box, others);
            for (const unsigned int other : others)
              if (other != f && !(only_other_pieces && piece(f) == piece(other)))
                add(f, other);
          }
        return candidates;
      }

    private:
      MovedSimplex
      seen(const SurfacePart &part) const
      {
        MovedSimplex simplex = moved(surface, motion, part);
        for (unsigned int v = 0; simplex.moves && v < part.n; ++v)
          simplex.end.x[v] -= mean;
        return simplex;
      }

      unsigned int
      piece(const unsigned int face) const
      {
        return surface.body.mesh.parts->parts[surface.faces()[face].nodes[0]];
      }

      void
      add(const unsigned int f, const unsigned int other)
      {
        const SurfacePart &face = surface.faces()[f], &other_face = surface.faces()[other];
        if (!face.shares_node_with(other_face) &&
            may_meet(simplices[f], simplices[other], distance))
          candidates.face_face.push_back({f, other});
        for (const unsigned int vertex : surface.represented_vertices[f])
          if (!other_face.has_node(surface.vertices[vertex].nodes[0]) &&
              may_meet(seen(surface.vertices[vertex]), simplices[other], distance))
            candidates.vertex_face.push_back({vertex, other});
        if (f > other || surface.triangles.empty())
          return;
        for (const unsigned int one : surface.represented_edges[f])
          for (const unsigned int two : surface.represented_edges[other])
            if (!surface.edges[one].shares_node_with(surface.edges[two]) &&
                may_meet(seen(surface.edges[one]), seen(surface.edges[two]), distance))
              candidates.edge_edge.push_back({one, two});
      }

      const ContactSurface &surface;
      const SurfaceMotion &motion;
      const bool only_other_pieces;
      const double distance; ///< [m]
      Arrow mean;            ///< way [m]
      std::vector<MovedSimplex> simplices;
      Candidates candidates;
    };
  } // namespace


  Candidates
  candidates_of(const ContactSurface &surface,
                const SurfaceMotion &motion,
                const Tool &tool,
                const ToolMotion &way,
                const double distance)
  {
    return ToolFinder(surface, motion, tool, way, distance).find();
  }


  Candidates
  near_ones(const Candidates &candidates,
            const ContactSurface &surface,
            const double *const u,
            const double distance)
  {
    const auto filter = [&](const std::vector<Candidate> &list,
                            const std::vector<SurfacePart> &ones,
                            const std::vector<SurfacePart> &others) {
      std::vector<Candidate> near;
      for (const Candidate &candidate : list)
        {
          const Simplex one   = surface.simplex(ones[candidate.one], u);
          const Simplex other = surface.simplex(others[candidate.other], u);
          if (may_meet({one, one, false}, {other, other, false}, distance))
            near.push_back(candidate);
        }
      return near;
    };
    const std::vector<SurfacePart> &faces = surface.faces();
    return {filter(candidates.vertex_face, surface.vertices, faces),
            {},
            filter(candidates.edge_edge, surface.edges, surface.edges),
            filter(candidates.face_face, faces, faces)};
  }


  Candidates
  own_candidates(const ContactSurface &surface,
                 const SurfaceMotion &motion,
                 const bool only_other_pieces,
                 const double distance)
  {
    return OwnFinder(surface, motion, only_other_pieces, distance).find();
  }
} // namespace Supple
