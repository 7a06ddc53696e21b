#include <supple/forces/contact.h>

#include <supple/base/error.h>
#include <supple/base/text.h>
#include <supple/forces/barrier.h>
#include <supple/forces/safe_way.h>
#include <supple/mechanics/selection.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** Ten times Young's modulus of the stiffest material [Pa]. */
    double
    usual_stiffness(const Body &body)
    {
      double young = 0.;
      for (const auto &[id, n_cells] : body.mesh.materials)
        {
          const IsotropicMaterial &material = body.material(id);
          const double lambda = material.lambda, mu = material.mu;
          young = std::max(young, mu * (3. * lambda + 2. * mu) / (lambda + mu));
        }
      return 10. * young;
    }


    double
    usual_reach(const Body &body, const ContactSurface &surface)
    {
      return std::min(1e-3 * body.mesh.diameter(), 0.1 * surface.shortest_edge());
    }


    std::vector<double>
    coefficients(const std::vector<ToolParameters> &tools)
    {
      std::vector<double> all;
      for (const ToolParameters &tool : tools)
        all.push_back(tool.friction);
      return all;
    }


    Arrow
    place_on_surface(const ContactPair &pair, const Corners &x)
    {
      Arrow place;
      for (unsigned int v = 0; v < pair.part->n; ++v)
        place += pair.c[v] * x[v];
      return place;
    }


    /** The tool where it is at a time. */
    Passage
    at(const double time)
    {
      return {time, time, 1.};
    }


    PartMatrix
    stiffness_of(const Friction::Slip &slip)
    {
      const ContactPair &pair     = *slip.pair;
      const unsigned int n        = 3 * pair.part->n;
      const Tensor<2, 3> of_place = slip.stiffness();
      PartMatrix matrix(n, n);
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int l = 0; l < n; ++l)
          matrix(k, l) = pair.c[k / 3] * pair.c[l / 3] * of_place[k % 3][l % 3];
      return matrix;
    }


    /** y += matrix w, for the nodes of a part that this process owns. */
    void
    add_product(const SurfacePart &part,
                const PartMatrix &matrix,
                const double factor,
                const double *const w,
                double *const y)
    {
      for (unsigned int a = 0; a < part.n; ++a)
        for (unsigned int b = 0; b < part.n; ++b)
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              y[3 * part.nodes[a] + i] +=
                factor * matrix(3 * a + i, 3 * b + j) * w[3 * part.nodes[b] + j];
    }
  } // namespace


  Contact::Contact(const Body &body,
                   const ContactParameters &parameters,
                   const std::vector<ToolParameters> &list,
                   const ParameterFile &scene)
    : body(body)
    , guard(parameters.guard)
    , stiffness(parameters.stiffness > 0. ? parameters.stiffness : usual_stiffness(body))
    , surface(body)
    , friction(coefficients(list), parameters.slip_resolution)
  {
    if (body.mesh.section.axisymmetric())
      throw InputError(scene.origin("Plane/Model") +
                       ": tools do not touch axisymmetric bodies yet (" +
                       scene.place(list[0].section() + "/Shape") + ": subsection " +
                       list[0].section() + "). Take a solid body, or a plane one.");
    const double reach = parameters.reach > 0. ? parameters.reach : usual_reach(body, surface);
    for (const ToolParameters &tool : list)
      tools.emplace_back(tool, body.mesh.section, reach, scene);
  }


  std::vector<PlacedTool>
  Contact::placed_tools(const Passage &passage) const
  {
    std::vector<PlacedTool> placed;
    for (const Tool &tool : tools)
      placed.push_back(tool.placed(tool.pose(passage)));
    return placed;
  }


  std::vector<ContactPair>
  Contact::pairs(const double *const u, const Passage &passage) const
  {
    return find_pairs(surface, u, placed_tools(passage), guard);
  }


  Arrow
  Contact::force_of(const ContactPair &pair) const
  {
    return -factor(pair) * Barrier{pair.reach}.slope(pair.gap) * pair.normal;
  }


  void
  Contact::spread(const ContactPair &pair, const Arrow &force, double *const f)
  {
    for (unsigned int v = 0; v < pair.part->n; ++v)
      for (unsigned int i = 0; i < 3; ++i)
        f[3 * pair.part->nodes[v] + i] += pair.c[v] * force[i];
  }


  void
  Contact::add_force(const ContactPair &pair, double *const f) const
  {
    spread(pair, force_of(pair), f);
    if (pair.factor == 1.)
      return;
    const double energy = stiffness * pair.weight * Barrier{pair.reach}.value(pair.gap);
    for (unsigned int v = 0; v < pair.part->n; ++v)
      for (unsigned int i = 0; i < 3; ++i)
        f[3 * pair.part->nodes[v] + i] -= energy * pair.factor_gradient[v][i];
  }


  void
  Contact::add_force(const Configuration &configuration, double, double *const f) const
  {
    const GhostValues u(configuration.displacement());
    for (const ContactPair &pair : pairs(u.data(), configuration.passage))
      add_force(pair, f);
    for (const Friction::Slip &slip : slips(u.data(), configuration.passage))
      spread(*slip.pair, slip.force(), f);
  }


  void
  Contact::begin_step(const Configuration &configuration)
  {
    if (!friction.any())
      return;
    const GhostValues u(configuration.start_of_step().displacement);
    Friction::Touches touches;
    std::vector<Arrow> places;
    for (const ContactPair &pair : pairs(u.data(), at(configuration.passage.from)))
      {
        touches.emplace_back(pair, force_of(pair).norm());
        places.push_back(place_on_surface(pair, surface.corners(*pair.part, u.data())));
      }
    friction.begin_step(touches, places);
  }


  std::vector<Friction::Slip>
  Contact::slips(const double *const u, const Passage &passage) const
  {
    if (!friction.any() || passage.to == passage.from) // nothing slips in no time
      return {};
    std::vector<std::array<Pose, 2>> poses;
    for (const Tool &tool : tools)
      poses.push_back({{tool.pose(passage.from), tool.pose(passage)}});
    return friction.slips(
      [&](const ContactPair &pair) {
        const auto &[from, now] = poses[pair.tool];
        return std::make_pair(place_on_surface(pair, surface.corners(*pair.part, u)),
                              from.place_with(now, pair.place));
      },
      passage.to - passage.from);
  }


  double
  Contact::energy(const Configuration &configuration, double) const
  {
    const GhostValues u(configuration.displacement());
    double sum = 0.;
    for (const ContactPair &pair : pairs(u.data(), configuration.passage))
      if (pair.part->owned)
        sum += factor(pair) * Barrier{pair.reach}.value(pair.gap);
    return sum;
  }


  double
  Contact::potential(const Configuration &configuration) const
  {
    const GhostValues u(configuration.displacement());
    double sum = energy(configuration, configuration.passage.to);
    for (const Friction::Slip &slip : slips(u.data(), configuration.passage))
      if (slip.pair->part->owned)
        sum += slip.potential();
    return sum;
  }


  double
  Contact::rubbed(const Configuration &configuration) const
  {
    const GhostValues u(configuration.displacement());
    double sum = 0.;
    for (const Friction::Slip &slip : slips(u.data(), configuration.passage))
      if (slip.pair->part->owned)
        sum += slip.heat();
    return Utilities::MPI::sum(sum, body.mesh.communicator);
  }


  double
  Contact::creep(const Configuration &configuration) const
  {
    const GhostValues u(configuration.displacement());
    const Passage &passage = configuration.passage;
    double fastest         = 0.;
    for (const Friction::Slip &slip : slips(u.data(), passage))
      if (slip.way.norm() < slip.resolution)
        fastest = std::max(fastest, slip.way.norm() / (passage.to - passage.from));
    return Utilities::MPI::max(fastest, body.mesh.communicator);
  }


  void
  Contact::connect(const SymmetricPattern &pattern)
  {
    surface.connect(pattern);
  }


  void
  Contact::update_tangent(Tangent, const Configuration &configuration, double, double)
  {
    const GhostValues u(configuration.displacement());
    tangent.clear();
    for (const ContactPair &pair : pairs(u.data(), configuration.passage))
      tangent.push_back({pair.part, factor(pair) * barrier_tangent(pair)});
    for (const Friction::Slip &slip : slips(u.data(), configuration.passage))
      tangent.push_back({slip.pair->part, stiffness_of(slip)});
  }


  void
  Contact::add_product(const Configuration &,
                       const TangentFactors &factors,
                       const double *const w,
                       double *const y) const
  {
    for (const Stiffness &stiffness : tangent)
      Supple::add_product(*stiffness.part, stiffness.matrix, factors.displacement, w, y);
  }


  void
  Contact::add_tangent(const Configuration &,
                       const TangentFactors &factors,
                       SymmetricBlockMatrix &A) const
  {
    const auto add =
      [&factors](double *block, const PartMatrix &matrix, unsigned int a, unsigned int b) {
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            block[3 * i + j] += factors.displacement * matrix(3 * a + i, 3 * b + j);
      };
    for (const Stiffness &stiffness : tangent)
      {
        const SurfacePart &part = *stiffness.part;
        for (unsigned int w = 0, pair = 0; w < part.n; ++w)
          {
            if (part.nodes[w] < body.n_owned)
              add(&A.diagonal[9 * part.nodes[w]], stiffness.matrix, w, w);
            for (unsigned int v = 0; v < w; ++v, ++pair)
              if (part.places[pair] < A.pattern.n_entries())
                {
                  const bool descends = part.nodes[v] > part.nodes[w]; // the row is the larger one
                  add(&A.lower[9 * part.places[pair]],
                      stiffness.matrix,
                      descends ? v : w,
                      descends ? w : v);
                }
          }
      }
  }


  void
  Contact::add_advance(const Configuration &configuration, const double part, double *const f) const
  {
    const Passage &passage = configuration.passage;
    const GhostValues u(configuration.displacement());
    std::vector<Pose> now, next;
    for (const Tool &tool : tools)
      {
        now.push_back(tool.pose(passage));
        next.push_back(tool.pose(Passage{passage.from, passage.to, part}));
      }
    for (const ContactPair &pair : pairs(u.data(), passage))
      {
        const Arrow way     = now[pair.tool].place_with(next[pair.tool], pair.place) - pair.place;
        const double growth = factor(pair) * Barrier{pair.reach}.curvature(pair.gap);
        spread(pair, growth * (pair.normal * way) * pair.normal, f);
      }
    for (const Friction::Slip &slip : slips(u.data(), passage))
      {
        const ContactPair &pair = *slip.pair;
        const Pose from         = tools[pair.tool].pose(passage.from);
        const Arrow way         = from.place_with(next[pair.tool], pair.place) -
                          from.place_with(now[pair.tool], pair.place);
        spread(pair, slip.stiffness() * way, f);
      }
  }


  bool
  Contact::tools_move(const Passage &passage) const
  {
    return std::any_of(tools.begin(), tools.end(), [&passage](const Tool &tool) {
      const Pose from = tool.pose(passage.from), to = tool.pose(passage.to);
      return from.place != to.place || from.turn != to.turn;
    });
  }


  bool
  Contact::acts(const Configuration &configuration) const
  {
    const GhostValues u(configuration.displacement());
    const bool here = friction.acts() || !pairs(u.data(), configuration.passage).empty();
    return Utilities::MPI::max(here ? 1 : 0, body.mesh.communicator) > 0;
  }


  bool
  Contact::has_stiffness() const
  {
    return Utilities::MPI::max(tangent.empty() ? 0 : 1, body.mesh.communicator) > 0;
  }


  double
  Contact::safe_part(const Configuration &configuration, const Vector &way, const double part) const
  {
    const Passage &passage = configuration.passage;
    const GhostValues u(configuration.displacement()), du(way);
    double safe = 1.;
    for (const Tool &tool : tools)
      {
        const Pose from = tool.pose(passage);
        const Pose to   = tool.pose(Passage{passage.from, passage.to, part});
        const bool flat = tool.parameters.shape == ToolParameters::Shape::plane;
        for (const SurfacePart &piece : flat ? surface.vertices : surface.faces())
          {
            Corners step;
            for (unsigned int v = 0; v < piece.n; ++v)
              for (unsigned int i = 0; i < 3; ++i)
                step[v][i] = du.data()[3 * piece.nodes[v] + i];
            safe = std::min(
              safe,
              Supple::safe_part(piece, surface.corners(piece, u.data()), step, tool, from, to));
          }
      }
    return Utilities::MPI::min(safe, body.mesh.communicator);
  }


  void
  Contact::add_works(std::vector<double> &works,
                     const Vector &displacement,
                     const Passage &step,
                     const bool at_end,
                     const double weight) const
  {
    if (weight == 0.)
      return;
    std::vector<Pose> first, last;
    for (const Tool &tool : tools)
      {
        first.push_back(tool.pose(step.from));
        last.push_back(tool.pose(step.to));
      }
    const std::vector<Pose> &now = at_end ? last : first;
    const GhostValues u(displacement);
    for (const ContactPair &pair : pairs(u.data(), at(at_end ? step.to : step.from)))
      if (pair.part->owned)
        {
          const unsigned int t = pair.tool;
          const Arrow way =
            now[t].place_with(last[t], pair.place) - now[t].place_with(first[t], pair.place);
          works[t] += weight * (force_of(pair) * way);
        }
    if (!at_end)
      return;
    for (const Friction::Slip &slip : slips(u.data(), step))
      if (slip.pair->part->owned)
        {
          const unsigned int t = slip.pair->tool; // it touched at the start
          const Arrow way      = first[t].place_with(last[t], slip.pair->place) - slip.pair->place;
          works[t] += weight * (slip.force() * way);
        }
  }


  std::vector<double>
  Contact::works(const Configuration &configuration, const double weight) const
  {
    const Passage step{configuration.passage.from, configuration.passage.to, 1.};
    std::vector<double> works(tools.size(), 0.), all(tools.size());
    add_works(works, configuration.start_of_step().displacement, step, false, weight);
    add_works(works, configuration.displacement(), step, true, 1. - weight);
    Utilities::MPI::sum(works, body.mesh.communicator, all);
    return all;
  }


  std::vector<ToolReport>
  Contact::reports(const Configuration &configuration) const
  {
    constexpr unsigned int n = 7; // force, torque, area

    const Passage &passage = configuration.passage;
    const GhostValues u(configuration.displacement());
    std::vector<ToolReport> reports(tools.size());
    std::vector<double> sums(n * tools.size(), 0.), all(sums.size());
    for (unsigned int t = 0; t < tools.size(); ++t)
      reports[t].place = tools[t].pose(passage).place;
    const auto add = [&](const unsigned int tool, const Arrow &place, const Arrow &force) {
      const Arrow torque = cross_product_3d(place - Arrow(reports[tool].place), force);
      for (unsigned int i = 0; i < 3; ++i)
        {
          sums[n * tool + i] += force[i];
          sums[n * tool + 3 + i] += torque[i];
        }
    };
    for (const ContactPair &pair : pairs(u.data(), passage))
      if (pair.part->owned)
        {
          add(pair.tool, pair.place, force_of(pair));
          if (!pair.guards)
            sums[n * pair.tool + 6] += pair.weight;
        }
    for (const Friction::Slip &slip : slips(u.data(), passage))
      if (slip.pair->part->owned)
        add(slip.pair->tool,
            place_on_surface(*slip.pair, surface.corners(*slip.pair->part, u.data())),
            slip.force());
    Utilities::MPI::sum(sums, body.mesh.communicator, all);
    const std::vector<PlacedTool> placed = placed_tools(passage);
    for (unsigned int t = 0; t < tools.size(); ++t)
      {
        const double *const sum = &all[n * t];
        reports[t].force        = Arrow({sum[0], sum[1], sum[2]});
        reports[t].torque       = Arrow({sum[3], sum[4], sum[5]});
        reports[t].area         = sum[6];
        reports[t].gap          = nearest(u.data(), placed[t]).gap;
        reports[t].depth        = std::max(0., placed[t].reach - reports[t].gap);
      }
    return reports;
  }


  Vector
  Contact::pressure(const Configuration &configuration) const
  {
    Vector pressure;
    body.initialize(pressure);
    const GhostValues u(configuration.displacement());
    sum_into(pressure, [&](double *const sum) {
      for (const ContactPair &pair : pairs(u.data(), configuration.passage))
        for (unsigned int v = 0; v < pair.part->n; ++v)
          sum[3 * pair.part->nodes[v]] += pair.c[v] * force_of(pair).norm();
      for (const SurfacePart &vertex : surface.vertices)
        sum[3 * vertex.nodes[0]] /= vertex.measure;
    });
    return pressure;
  }


  void
  Contact::require_room(const Passage &passage, const Constraints &constraints) const
  {
    constexpr unsigned int none = numbers::invalid_unsigned_int;
    if (constraints.n_held == 0)
      return;
    Vector goal;
    body.initialize(goal);
    if (constraints.move())
      constraints.set_displacement(goal, passage.to);
    const std::vector<PlacedTool> placed = placed_tools(at(passage.to));
    for (unsigned int t = 0; t < tools.size(); ++t)
      {
        unsigned int vertex = none;
        for (const SurfacePart &part : surface.vertices)
          if (constraints.holds_node(part.nodes[0]) &&
              gap_of(part, surface.corners(part, goal.begin()), placed[t]) <= 0.)
            vertex = std::min(vertex, body.serial_vertex[part.nodes[0]]);
        vertex = Utilities::MPI::min(vertex, body.mesh.communicator);
        if (vertex != none)
          throw ComputationError("the tool " + tools[t].parameters.name + " would reach " +
                                 Selection(body).vertex_in_words(vertex) +
                                 ", which is held or moved as prescribed: both can't be");
      }
  }


  Contact::Nearest
  Contact::nearest(const double *const u, const PlacedTool &tool) const
  {
    const MPI_Comm communicator = body.mesh.communicator;
    Nearest here{std::numeric_limits<double>::max(), 0., numbers::invalid_unsigned_int};
    for (const SurfacePart &part : tool.is_plane ? surface.vertices : surface.faces())
      {
        const Corners x  = surface.corners(part, u);
        const double gap = gap_of(part, x, tool);
        if (gap >= here.gap)
          continue;
        here = {gap, 0., body.serial_vertex[part.nodes[0]]};
        for (unsigned int v = 0; v < part.n; ++v)
          here.edge = std::max(here.edge, (x[(v + 1) % part.n] - x[v]).norm());
      }
    Nearest all{Utilities::MPI::min(here.gap, communicator), 0., 0};
    const bool is_here = here.gap == all.gap;
    all.edge           = Utilities::MPI::max(is_here ? here.edge : 0., communicator);
    all.vertex =
      Utilities::MPI::min(is_here ? here.vertex : numbers::invalid_unsigned_int, communicator);
    return all;
  }


  void
  Contact::require_clear(const Configuration &configuration, const ParameterFile &scene) const
  {
    const GhostValues u(configuration.displacement());
    for (const Tool &tool : tools)
      {
        const PlacedTool placed = tool.placed(tool.pose(configuration.passage));
        const Nearest place     = nearest(u.data(), placed);
        if (place.gap <= 0.)
          throw InputError(scene.origin(tool.parameters.section() + "/Position") +
                           ": at the start the tool " + tool.parameters.name + " is " +
                           digits(placed.reach - place.gap, 3) + " m deep in the body, at " +
                           Selection(body).vertex_in_words(place.vertex) +
                           ". It must be outside; it may touch the surface.");
      }
  }


  std::vector<std::string>
  Contact::warnings_of_start(const Configuration &configuration) const
  {
    const GhostValues u(configuration.displacement());
    std::vector<std::string> warnings;
    for (const Tool &tool : tools)
      {
        const PlacedTool placed = tool.placed(tool.pose(configuration.passage));
        const Nearest place     = nearest(u.data(), placed);
        const double radius     = tool.parameters.radius;
        if (!placed.is_plane && radius < place.edge)
          warnings.push_back(
            "The tool " + tool.parameters.name + ", with a radius of " + digits(radius, 3) +
            " m, is thinner than the cells that it is next to, with edges of " +
            digits(place.edge, 3) + " m: its force depends on the mesh. Edges of less than " +
            digits(radius, 3) + " m would do.");
        if (place.gap < placed.reach * (1. - 1e-6))
          warnings.push_back("At the start the tool " + tool.parameters.name + " is " +
                             digits(placed.reach - place.gap, 3) +
                             " m deep in the body, and pushes it away.");
      }
    return warnings;
  }
} // namespace Supple
