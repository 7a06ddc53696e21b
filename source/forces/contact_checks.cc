// What must be so at the start of a run and of each step for contact to have a solution.

#include <supple/base/error.h>
#include <supple/base/text.h>
#include <supple/forces/contact.h>
#include <supple/mechanics/selection.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <set>
#include <vector>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int none = numbers::invalid_unsigned_int;


    double
    longest_edge(const Simplex &simplex)
    {
      double longest = 0.;
      for (unsigned int v = 0; v < simplex.n; ++v)
        longest = std::max(longest, (simplex.x[(v + 1) % simplex.n] - simplex.x[v]).norm());
      return longest;
    }


    /** One point of each connected part of a tool's core; none of a plane. What crosses the surface
     * of the body is found anyway. */
    std::vector<unsigned int>
    points_of_shells(const PlacedTool &tool)
    {
      if (tool.is_plane())
        return {};
      std::vector<unsigned int> first(tool.points.size()); // a smaller point of the same shell
      std::iota(first.begin(), first.end(), 0);
      const auto root = [&first](unsigned int point) {
        while (first[point] != point)
          point = first[point] = first[first[point]];
        return point;
      };
      for (const SurfacePart &face : tool.shape->parts.faces())
        for (unsigned int v = 1; v < face.n; ++v)
          {
            const auto [less, more] = std::minmax({root(face.nodes[0]), root(face.nodes[v])});
            first[more]             = less;
          }
      std::vector<unsigned int> points;
      for (unsigned int point = 0; point < first.size(); ++point)
        if (root(point) == point)
          points.push_back(point);
      return points;
    }


    double
    six_volumes(const Arrow &a, const Arrow &b, const Arrow &c, const Arrow &d)
    {
      return cross_product_3d(b - a, c - a) * (d - a);
    }
  } // namespace


  void
  Contact::require_room(const Passage &passage, const Constraints &constraints) const
  {
    if (constraints.n_held == 0)
      return;
    Vector goal;
    body.initialize(goal);
    if (constraints.move())
      constraints.set_displacement(goal, passage.to);
    const GhostValues places(goal);
    for (const Tool &tool : tools)
      {
        const PlacedTool placed = tool.placed(tool.pose(passage.to));
        unsigned int vertex     = none;
        const auto look         = [&](const SurfacePart &part) {
          bool held = true;
          for (unsigned int v = 0; v < part.n; ++v)
            held = held && constraints.holds_node(part.nodes[v]);
          if (held && placed.gap(surface.simplex(part, places.data()), tool.reach) <= 0.)
            vertex = std::min(vertex, body.serial_vertex[part.nodes[0]]);
        };
        std::for_each(surface.vertices.begin(), surface.vertices.end(), look);
        std::for_each(surface.faces().begin(), surface.faces().end(), look);
        vertex = Utilities::MPI::min(vertex, body.mesh.communicator);
        if (vertex != none)
          throw ComputationError("the tool " + tool.parameters.name + " would reach " +
                                 Selection(body).vertex_in_words(vertex) +
                                 ", which is held or moved as prescribed: both can't be");
      }
  }


  Contact::Nearest
  Contact::nearest(const double *const u, const PlacedTool &tool) const
  {
    const MPI_Comm communicator = body.mesh.communicator;
    Nearest here{std::numeric_limits<double>::max(), 0., none};
    for (const SurfacePart &part : tool.is_plane() ? surface.vertices : surface.faces())
      {
        const Simplex simplex = surface.simplex(part, u);
        const double gap      = tool.gap(simplex, here.gap);
        if (gap < here.gap)
          here = {gap, longest_edge(simplex), body.serial_vertex[part.nodes[0]]};
      }
    Nearest all{Utilities::MPI::min(here.gap, communicator), 0., 0};
    const bool is_here = here.gap == all.gap;
    all.edge           = Utilities::MPI::max(is_here ? here.edge : 0., communicator);
    all.vertex         = Utilities::MPI::min(is_here ? here.vertex : none, communicator);
    return all;
  }


  bool
  Contact::body_contains(const double *const u, const Arrow &place) const
  {
    constexpr double round_off = 1e-9; // what lies on the surface is outside

    for (const auto &nodes : body.cell_nodes)
      {
        std::array<Arrow, 4> x;
        for (unsigned int v = 0; v < 4; ++v)
          x[v] = surface.place(nodes[v], u);
        Arrow inside = place;
        if (body.mesh.section.plane()) // a corner stands twice: triangles reach along z
          {
            x[3] = (x[0] + x[1] + x[2]) / 3. + Arrow({0., 0., 1.});
            for (unsigned int v = 0; v < 3; ++v)
              x[v][2] = 0.;
            inside[2] = 1e-9;
          }
        const double volume = six_volumes(x[0], x[1], x[2], x[3]);
        bool within         = volume != 0.;
        for (unsigned int v = 0; v < 4 && within; ++v)
          {
            std::array<Arrow, 4> part = x;
            part[v]                   = inside;
            within = six_volumes(part[0], part[1], part[2], part[3]) / volume > round_off;
          }
        if (within)
          return true;
      }
    return false;
  }


  std::vector<std::string>
  Contact::check_start(const Configuration &configuration, const ParameterFile &scene) const
  {
    const GhostValues u(configuration.displacement());
    std::vector<std::string> warnings;
    for (const Tool &tool : tools)
      {
        const PlacedTool placed = tool.placed(tool.pose(configuration.passage));
        const Nearest place     = nearest(u.data(), placed);
        require_clear(u.data(), placed, tool, place, scene);
        add_warnings(warnings, placed, tool, place);
      }
    require_no_crossing(u.data(), scene);
    if (const std::optional<double> gap = own_gap(configuration);
        gap.value_or(reach) < reach * (1. - 1e-6))
      warnings.push_back("At the start bodies are " + digits(*gap, 3) +
                         " m apart, less than the reach of the barrier of " + digits(reach, 3) +
                         " m, and push each other away.");
    return warnings;
  }


  void
  Contact::require_clear(const double *const u,
                         const PlacedTool &placed,
                         const Tool &tool,
                         const Nearest &nearest,
                         const ParameterFile &scene) const
  {
    // no point is on a face between two cells, where it would be in neither
    const Arrow off_faces   = 1e-7 * body.mesh.diameter() * Arrow({0.31, 0.53, 0.79});
    const std::string words = scene.origin(tool.parameters.section() + "/Position") +
                              ": at the start the tool " + tool.parameters.name + " is ";
    const std::string depth =
      placed.offset == 0. ? "" : digits(placed.reach - nearest.gap, 3) + " m deep ";
    if (nearest.gap <= 0.)
      throw InputError(words + depth + "in the body, at " +
                       Selection(body).vertex_in_words(nearest.vertex) +
                       ". It must be outside; it may touch the surface.");
    unsigned int within = 0;
    for (const unsigned int point : points_of_shells(placed))
      within = std::max<unsigned int>(within, body_contains(u, placed.points[point] + off_faces));
    if (Utilities::MPI::max(within, body.mesh.communicator) > 0)
      throw InputError(words + "wholly within the body, near " +
                       Selection(body).vertex_in_words(nearest.vertex) +
                       ". It must be outside; it may touch the surface.");
  }


  void
  Contact::require_no_crossing(const double *const u, const ParameterFile &scene) const
  {
    if (bodies == ContactParameters::Bodies::tools)
      return;
    std::set<unsigned int> pieces;
    for (const SurfacePart &face : surface.faces())
      if (pieces.insert(body.mesh.parts->parts[face.nodes[0]]).second &&
          body_contains(u, surface.simplex(face, u).center()))
        throw InputError(scene.origin("Contact/Bodies") +
                         ": at the start a piece of the body is within another, at " +
                         Selection(body).vertex_in_words(body.serial_vertex[face.nodes[0]]) + ".");
    const Candidates near = search.own(u);
    for (const auto &[one, other] : near.face_face)
      {
        const SurfacePart &face = surface.faces()[one], &other_face = surface.faces()[other];
        if (distance(surface.simplex(face, u), surface.simplex(other_face, u)) > 0.)
          continue;
        const Selection selection(body);
        throw InputError(scene.origin("Contact/Bodies") +
                         ": at the start the surface meets itself at " +
                         selection.vertex_in_words(body.serial_vertex[face.nodes[0]]) + " and " +
                         selection.vertex_in_words(body.serial_vertex[other_face.nodes[0]]) +
                         ". Bodies must be apart, by " + digits(reach, 3) +
                         " m (Contact/Reach) if they are not to push each other at once.");
      }
  }


  void
  Contact::add_warnings(std::vector<std::string> &warnings,
                        const PlacedTool &placed,
                        const Tool &tool,
                        const Nearest &nearest)
  {
    const double radius = tool.parameters.radius;
    const bool is_round = tool.parameters.shape == ToolParameters::Shape::sphere ||
                          tool.parameters.shape == ToolParameters::Shape::capsule;
    if (is_round && radius < nearest.edge)
      warnings.push_back(
        "The tool " + tool.parameters.name + ", with a radius of " + digits(radius, 3) +
        " m, is thinner than the cells that it is next to, with edges of " +
        digits(nearest.edge, 3) + " m: its force depends on the mesh. Edges of less than " +
        digits(radius, 3) + " m would do.");
    if (tool.shape && !tool.shape->parts.triangles.empty() && !tool.shape->is_closed())
      warnings.push_back("The surface of the tool " + tool.parameters.name +
                         " is not closed, or its triangles do not all turn the same way: "
                         "whether the body begins within it is not known.");
    if (nearest.gap < placed.reach * (1. - 1e-6))
      warnings.push_back("At the start the tool " + tool.parameters.name + " is " +
                         digits(placed.reach - nearest.gap, 3) +
                         " m deep in the body, and pushes it away.");
  }
} // namespace Supple
