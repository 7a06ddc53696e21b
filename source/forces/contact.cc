#include <supple/forces/contact.h>

#include <supple/base/error.h>
#include <supple/base/text.h>
#include <supple/contact/barrier.h>
#include <supple/contact/safe_way.h>

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


    std::vector<Tool>
    make_tools(const Body &body,
               const std::vector<ToolParameters> &list,
               const double reach,
               const ParameterFile &scene)
    {
      std::vector<Tool> tools;
      for (const ToolParameters &tool : list)
        tools.emplace_back(tool, body.mesh.section, reach, scene);
      return tools;
    }


    std::vector<double>
    coefficients(const std::vector<ToolParameters> &tools, const double between_bodies)
    {
      std::vector<double> all;
      for (const ToolParameters &tool : tools)
        all.push_back(tool.friction);
      all.push_back(between_bodies);
      return all;
    }


    constexpr double far_away = std::numeric_limits<double>::max();


    /** The tool where it is at a time. */
    Passage
    at(const double time)
    {
      return {time, time, 1.};
    }


    PairMatrix
    stiffness_of(const Friction::Slip &slip)
    {
      const ContactPair &pair     = *slip.pair;
      const unsigned int n        = 3 * pair.n;
      const Tensor<2, 3> of_place = slip.stiffness();
      PairMatrix matrix(n, n);
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int l = 0; l < n; ++l)
          matrix(k, l) = pair.c[k / 3] * pair.c[l / 3] * of_place[k % 3][l % 3];
      return matrix;
    }
  } // namespace


  Contact::Contact(const Body &body,
                   const ContactParameters &parameters,
                   const std::vector<ToolParameters> &list,
                   const ParameterFile &scene)
    : body(body)
    , stiffness(parameters.stiffness > 0. ? parameters.stiffness : usual_stiffness(body))
    , bodies(parameters.bodies)
    , surface(body)
    , reach(parameters.reach > 0. ? parameters.reach : usual_reach(body, surface))
    , tools(make_tools(body, list, reach, scene))
    , finder(surface, parameters.guard, reach)
    , search(surface, tools, reach, bodies)
    , friction(coefficients(list, parameters.between_bodies() ? parameters.friction : 0.),
               parameters.slip_resolution)
    , largest_turns(tools.size(), 0.)
  {
    if (reach > 0.1 * body.mesh.diameter())
      throw InputError(scene.origin("Contact/Reach") + ": " + digits(reach, 3) +
                       " m is more than a tenth of the body's diameter of " +
                       digits(body.mesh.diameter(), 3) + " m, so deep would it be entered.");
    if (body.mesh.section.axisymmetric())
      throw InputError(scene.origin("Plane/Model") +
                       ": axisymmetric bodies do not touch anything "
                       "yet (" +
                       (list.empty() ? scene.origin("Contact/Bodies")
                                     : scene.place(list[0].section() + "/Shape") + ": subsection " +
                                         list[0].section()) +
                       "). Take a solid body, or a plane one.");
    if (parameters.between_bodies() && Utilities::MPI::n_mpi_processes(body.mesh.communicator) > 1)
      throw InputError(scene.origin("Contact/Bodies") +
                       ": bodies touch each other on one process alone. Take one process, on "
                       "several threads, or Bodies = tools.");
  }


  std::vector<Pose>
  Contact::poses(const Passage &passage) const
  {
    std::vector<Pose> poses;
    for (const Tool &tool : tools)
      poses.push_back(tool.pose(passage));
    return poses;
  }


  std::vector<ContactPair>
  Contact::pairs(const double *const u, const Passage &passage) const
  {
    const std::vector<Pose> now = poses(passage);
    const AllCandidates &near   = search.find(u, now);
    std::vector<ContactPair> pairs;
    for (unsigned int t = 0; t < tools.size(); ++t)
      if (!near.of_tools[t].empty())
        finder.add(pairs, u, tools[t].placed(now[t]), t, near.of_tools[t]);
    finder.add_own(pairs, u, *near.own);
    return pairs;
  }


  Arrow
  Contact::force_of(const ContactPair &pair) const
  {
    return -factor(pair) * Barrier{pair.reach}.slope(pair.gap) * pair.normal;
  }


  void
  Contact::spread(const ContactPair &pair, const Arrow &force, double *const f)
  {
    for (unsigned int v = 0; v < pair.n; ++v)
      for (unsigned int i = 0; i < 3; ++i)
        f[3 * pair.nodes[v] + i] += pair.c[v] * force[i];
  }


  double
  Contact::energy_of(const ContactPair &pair) const
  {
    return stiffness * pair.weight * Barrier{pair.reach}.value(pair.gap);
  }


  void
  Contact::add_force(const ContactPair &pair, double *const f) const
  {
    spread(pair, force_of(pair), f);
    if (pair.factor == 1.)
      return;
    const double energy = energy_of(pair);
    for (unsigned int v = 0; v < pair.n; ++v)
      for (unsigned int i = 0; i < 3; ++i)
        f[3 * pair.nodes[v] + i] -= energy * pair.factor_gradient[v][i];
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
    note_turns(configuration.passage);
    if (!friction.any())
      return;
    const GhostValues u(configuration.start_of_step().displacement);
    Friction::Touches touches;
    std::vector<Arrow> places;
    for (const ContactPair &pair : pairs(u.data(), at(configuration.passage.from)))
      {
        touches.emplace_back(pair, force_of(pair).norm());
        places.push_back(pair.place_of_nodes(body, u.data()));
      }
    friction.begin_step(touches, places);
  }


  void
  Contact::note_turns(const Passage &passage)
  {
    for (unsigned int t = 0; t < tools.size(); ++t)
      largest_turns[t] =
        std::max(largest_turns[t],
                 (tools[t].pose(passage.to).turn - tools[t].pose(passage.from).turn).norm());
  }


  std::vector<Friction::Slip>
  Contact::slips(const double *const u, const Passage &passage) const
  {
    if (!friction.any() || passage.to == passage.from) // nothing slips in no time
      return {};
    const std::vector<Pose> from = poses(at(passage.from)), now = poses(passage);
    return friction.slips(
      [&](const ContactPair &pair, const Arrow &touched) {
        const Arrow place = pair.place_of_nodes(body, u);
        if (pair.other)
          return std::make_pair(place, touched);
        return std::make_pair(place, from[pair.tool].place_with(now[pair.tool], touched));
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
        sum += pair.factor * energy_of(pair);
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
  Contact::add_couplings(Couplings &couplings) const
  {
    couplings.insert(couplings.end(), coupled.begin(), coupled.end());
  }


  void
  Contact::connect(const SymmetricPattern &)
  {
    pattern_is_old = false;
  }


  namespace
  {
    /** Adds each pair of a node of one part and one of another. */
    void
    couple(Couplings &couplings, const SurfacePart &one, const SurfacePart &other)
    {
      for (unsigned int v = 0; v < one.n; ++v)
        for (unsigned int w = 0; w < other.n; ++w)
          couplings.push_back(
            {{std::max(one.nodes[v], other.nodes[w]), std::min(one.nodes[v], other.nodes[w])}});
    }


    void
    sort_once(Couplings &couplings)
    {
      std::sort(couplings.begin(), couplings.end());
      couplings.erase(std::unique(couplings.begin(), couplings.end()), couplings.end());
    }
  } // namespace


  void
  Contact::renew_couplings(const std::vector<ContactPair> &pairs,
                           const std::vector<Friction::Slip> &slips,
                           const Candidates &near)
  {
    Couplings needed;
    for (const ContactPair &pair : pairs)
      if (pair.other)
        couple(needed, *pair.part, *pair.other);
    for (const Friction::Slip &slip : slips)
      if (slip.pair->other)
        couple(needed, *slip.pair->part, *slip.pair->other);
    sort_once(needed);
    if (std::includes(coupled.begin(), coupled.end(), needed.begin(), needed.end()))
      return;
    coupled = needed; // of friction, what touched at the start
    for (const Candidate &pair : near.vertex_face)
      couple(coupled, surface.vertices[pair.one], surface.faces()[pair.other]);
    for (const Candidate &pair : near.edge_edge)
      couple(coupled, surface.edges[pair.one], surface.edges[pair.other]);
    for (const Candidate &pair : near.face_face)
      couple(coupled, surface.faces()[pair.one], surface.faces()[pair.other]);
    sort_once(coupled);
    pattern_is_old = true;
  }


  void
  Contact::update_tangent(Tangent, const Configuration &configuration, double, double)
  {
    const Passage &passage = configuration.passage;
    const GhostValues u(configuration.displacement());
    const std::vector<ContactPair> near     = pairs(u.data(), passage);
    const std::vector<Friction::Slip> slide = slips(u.data(), passage);
    if (couplings_come_and_go())
      renew_couplings(near, slide, *search.find(u.data(), poses(passage)).own);
    tangent.clear();
    for (const ContactPair &pair : near)
      tangent.push_back({pair.n, pair.nodes, factor(pair) * barrier_tangent(pair)});
    for (const Friction::Slip &slip : slide)
      tangent.push_back({slip.pair->n, slip.pair->nodes, stiffness_of(slip)});
  }


  void
  Contact::add_product(const Configuration &,
                       const TangentFactors &factors,
                       const double *const w,
                       double *const y) const
  {
    for (const auto &[n, nodes, matrix] : tangent)
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              y[3 * nodes[a] + i] +=
                factors.displacement * matrix(3 * a + i, 3 * b + j) * w[3 * nodes[b] + j];
  }


  void
  Contact::add_tangent(const Configuration &,
                       const TangentFactors &factors,
                       SymmetricBlockMatrix &A) const
  {
    const auto add =
      [&factors](double *block, const PairMatrix &matrix, unsigned int a, unsigned int b) {
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            block[3 * i + j] += factors.displacement * matrix(3 * a + i, 3 * b + j);
      };
    for (const auto &[n, nodes, matrix] : tangent)
      for (unsigned int w = 0; w < n; ++w)
        {
          if (nodes[w] < body.n_owned)
            add(&A.diagonal[9 * nodes[w]], matrix, w, w);
          for (unsigned int v = 0; v < w; ++v)
            {
              const bool descends    = nodes[v] > nodes[w]; // the row is the larger one
              const unsigned int row = descends ? v : w, column = descends ? w : v;
              const std::size_t place = A.pattern.position(nodes[row], nodes[column]);
              if (place < A.pattern.n_entries())
                add(&A.lower[9 * place], matrix, row, column);
            }
        }
  }


  void
  Contact::add_advance(const Configuration &configuration, const double part, double *const f) const
  {
    const Passage &passage = configuration.passage;
    const GhostValues u(configuration.displacement());
    const std::vector<Pose> from = poses(at(passage.from)), now = poses(passage);
    const std::vector<Pose> next = poses({passage.from, passage.to, part});
    for (const ContactPair &pair : pairs(u.data(), passage))
      {
        if (pair.other)
          continue;
        const Arrow way     = now[pair.tool].place_with(next[pair.tool], pair.place) - pair.place;
        const double growth = factor(pair) * Barrier{pair.reach}.curvature(pair.gap);
        spread(pair, growth * (pair.normal * way) * pair.normal, f);
      }
    for (const Friction::Slip &slip : slips(u.data(), passage))
      {
        const ContactPair &pair = *slip.pair;
        if (pair.other)
          continue;
        const Pose &start = from[pair.tool];
        const Arrow way   = start.place_with(next[pair.tool], slip.start) -
                          start.place_with(now[pair.tool], slip.start);
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
    std::vector<ToolMotion> motions;
    for (const Tool &tool : tools)
      motions.push_back({tool.pose(passage), tool.pose(Passage{passage.from, passage.to, part})});
    const SurfaceMotion motion{u.data(), du.data()};
    const AllCandidates &candidates = search.find(motion, motions);

    double safe = safe_part_of_bodies(motion, *candidates.own);
    for (unsigned int t = 0; t < tools.size(); ++t)
      safe = std::min(safe, safe_part_at(tools[t], motion, motions[t], candidates.of_tools[t]));
    return Utilities::MPI::min(safe, body.mesh.communicator);
  }


  double
  Contact::safe_part_at(const Tool &tool,
                        const SurfaceMotion &motion,
                        const ToolMotion &of_tool,
                        const Candidates &candidates) const
  {
    double safe   = 1.;
    const auto go = [&](const SurfacePart &part, const SurfacePart *const of_core) {
      safe = std::min(safe,
                      Supple::safe_part(surface.simplex(part, motion.u),
                                        ContactSurface::values(part, motion.way),
                                        tool,
                                        of_core,
                                        of_tool));
    };
    const SurfaceParts *const core = tool.shape ? &tool.shape->parts : nullptr;
    for (const auto &[one, other] : candidates.vertex_face)
      go(surface.vertices[one], core ? &core->faces()[other] : nullptr);
    for (const auto &[one, other] : candidates.face_vertex)
      go(surface.faces()[one], &core->vertices[other]);
    for (const auto &[one, other] : candidates.edge_edge)
      go(surface.edges[one], &core->edges[other]);
    return safe;
  }


  double
  Contact::safe_part_of_bodies(const SurfaceMotion &motion, const Candidates &candidates) const
  {
    double safe   = 1.;
    const auto go = [&](const SurfacePart &one, const SurfacePart &other) {
      safe = std::min(safe,
                      Supple::safe_part(surface.simplex(one, motion.u),
                                        ContactSurface::values(one, motion.way),
                                        surface.simplex(other, motion.u),
                                        ContactSurface::values(other, motion.way)));
    };
    for (const auto &[one, other] : candidates.vertex_face)
      go(surface.vertices[one], surface.faces()[other]);
    for (const auto &[one, other] : candidates.edge_edge)
      go(surface.edges[one], surface.edges[other]);
    return safe;
  }


  double
  Contact::turning_work(const ContactPair &pair,
                        const Pose &now,
                        const Pose &first,
                        const Pose &last) const
  {
    if (pair.factor == 1.)
      return 0.;
    const Arrow edge = now.turned_back(pair.other_edge);
    return energy_of(pair) * (pair.factor_gradient[3] * (last.turned(edge) - first.turned(edge)));
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
    const std::vector<Pose> first = poses(at(step.from)), last = poses(at(step.to));
    const std::vector<Pose> &now = at_end ? last : first;
    const GhostValues u(displacement);
    for (const ContactPair &pair : pairs(u.data(), at(at_end ? step.to : step.from)))
      if (pair.part->owned && !pair.other)
        {
          const unsigned int t = pair.tool;
          const Arrow way =
            now[t].place_with(last[t], pair.place) - now[t].place_with(first[t], pair.place);
          works[t] +=
            weight * (force_of(pair) * way + turning_work(pair, now[t], first[t], last[t]));
        }
    if (!at_end)
      return;
    for (const Friction::Slip &slip : slips(u.data(), step))
      if (slip.pair->part->owned && !slip.pair->other)
        {
          const unsigned int t = slip.pair->tool; // it touched at the start
          const Arrow way      = first[t].place_with(last[t], slip.start) - slip.start;
          works[t] += slip.force() * way; // it acts on the whole way
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
    std::vector<double> gaps(tools.size(), far_away);
    const std::vector<Pose> now = poses(passage);
    for (unsigned int t = 0; t < tools.size(); ++t)
      reports[t].place = now[t].place;
    const auto add = [&](const unsigned int tool, const Arrow &place, const Arrow &force) {
      const Arrow torque = cross_product_3d(place - Arrow(reports[tool].place), force);
      for (unsigned int i = 0; i < 3; ++i)
        {
          sums[n * tool + i] += force[i];
          sums[n * tool + 3 + i] += torque[i];
        }
    };
    const auto add_couple = [&](const ContactPair &pair) {
      const Simplex x = surface.simplex(*pair.part, u.data());
      for (unsigned int v = 0; pair.factor < 1. && v < pair.n; ++v)
        {
          const Arrow couple = cross_product_3d(x.x[v], -energy_of(pair) * pair.factor_gradient[v]);
          for (unsigned int i = 0; i < 3; ++i)
            sums[n * pair.tool + 3 + i] += couple[i];
        }
    };
    for (const ContactPair &pair : pairs(u.data(), passage))
      if (pair.part->owned && !pair.other)
        {
          add(pair.tool, pair.place, force_of(pair));
          add_couple(pair);
          gaps[pair.tool] = std::min(gaps[pair.tool], pair.gap);
          if (!pair.guards)
            sums[n * pair.tool + 6] += pair.weight;
        }
    for (const Friction::Slip &slip : slips(u.data(), passage))
      if (slip.pair->part->owned && !slip.pair->other)
        add(slip.pair->tool, slip.pair->place_of_nodes(body, u.data()), slip.force());
    Utilities::MPI::sum(sums, body.mesh.communicator, all);
    for (unsigned int t = 0; t < tools.size(); ++t)
      {
        const double *const sum = &all[n * t];
        reports[t].force        = Arrow({sum[0], sum[1], sum[2]});
        reports[t].torque       = Arrow({sum[3], sum[4], sum[5]});
        reports[t].area         = sum[6];
        reports[t].gap          = Utilities::MPI::min(gaps[t], body.mesh.communicator);
        if (reports[t].gap == far_away)
          reports[t].gap = nearest(u.data(), tools[t].placed(now[t])).gap;
        reports[t].depth = std::max(0., tools[t].reach - reports[t].gap);
      }
    return reports;
  }


  std::optional<ContactPair>
  Contact::nearest_own_pair(const Configuration &configuration) const
  {
    if (bodies == ContactParameters::Bodies::tools)
      return {};
    const GhostValues u(configuration.displacement());
    std::optional<ContactPair> nearest;
    for (const ContactPair &pair : pairs(u.data(), configuration.passage))
      if (pair.other && (!nearest || pair.gap < nearest->gap))
        nearest = pair;
    return nearest;
  }


  std::optional<double>
  Contact::own_gap(const Configuration &configuration) const
  {
    const std::optional<ContactPair> nearest = nearest_own_pair(configuration);
    return nearest ? std::optional<double>(nearest->gap) : std::nullopt;
  }
} // namespace Supple
