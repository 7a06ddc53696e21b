#include <supple/mechanics/constraints.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>
#include <supple/mechanics/free_motions.h>
#include <supple/mechanics/selection.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** By differences at five times from @p time to @p time + 4 @p interval, of fourth order. */
    double
    rate(const std::function<double(const Point<3> &, double)> &displacement,
         const Point<3> &place,
         const double time,
         const double interval)
    {
      const std::array<double, 5> weights = {{-25. / 12., 4., -3., 4. / 3., -1. / 4.}};
      double sum                          = 0.;
      for (unsigned int k = 0; k < weights.size(); ++k)
        sum += weights[k] * displacement(place, time + k * interval);
      return sum / interval;
    }
  } // namespace


  Constraints::Constraints(const Body &body,
                           const ConstraintParameters &parameters,
                           const Motions &prescribed,
                           const ParameterFile &scene)
    : body(body)
    , held(3 * body.n_local)
  {
    const auto hold = [&](const std::vector<bool> &nodes, const std::array<bool, 3> &directions) {
      for (unsigned int node = 0; node < body.n_local; ++node)
        for (unsigned int i = 0; i < 3; ++i)
          if (nodes[node] && directions[i])
            held[3 * node + i] = true;
    };
    const std::array<bool, 3> all = {{true, true, true}};

    for (const std::string &id : parameters.clamped_boundaries)
      hold(Selection(body).boundary_nodes(id, scene.origin("Constraints/Clamped boundaries")), all);
    if (!parameters.clamped_region.empty())
      hold(Selection(body).region_nodes(parameters.clamped_region,
                                        scene.origin("Constraints/Clamped region")),
           all);
    for (unsigned int i = 0; i < 3; ++i)
      for (const std::string &id : parameters.sliding_boundaries[i])
        hold(Selection(body).boundary_nodes(
               id, scene.origin(std::string("Constraints/Boundaries held along ") + "xyz"[i])),
             {{i == 0, i == 1, i == 2}});

    for (unsigned int m = 0; m < prescribed.size(); ++m)
      if (!prescribed[m].of.empty())
        add_motion(prescribed[m], motion_section(m), scene);

    for (const ConstraintParameters::ByHand &hand : parameters.by_hand)
      add_hand(hand);

    complete();
  }


  void
  Constraints::complete()
  {
    // A piece that nothing but its own nature holds is as free as a body can be.
    std::vector<unsigned int> held_in(body.mesh.report.pieces.size()), total(held_in.size());
    const auto &parts      = body.mesh.report.parts;
    unsigned int n_counted = 0;
    for (unsigned int dof = 0; dof < 3 * body.n_local; ++dof)
      {
        const bool by_nature = body.is_held_by_nature(dof);
        held[dof]            = held[dof] || by_nature;
        if (!held[dof] || dof >= 3 * body.n_owned)
          continue;
        held_owned.push_back(dof);
        if (!by_nature)
          held_in[parts.at(body.mesh.parts->parts[dof / 3]).piece] = 1;
        n_counted += !(body.mesh.section.plane() && dof % 3 == 2);
      }
    n_held = Utilities::MPI::sum(n_counted, body.mesh.communicator);
    Utilities::MPI::sum(held_in, body.mesh.communicator, total);
    for (unsigned int piece = 0; piece < total.size(); ++piece)
      if (total[piece] == 0)
        free_pieces.push_back(piece);
    products = held_products();
  }


  std::string
  Constraints::free_pieces_in_words() const
  {
    constexpr std::size_t n_shown = 3;

    const auto &pieces = body.mesh.report.pieces;
    if (free_pieces.empty() || free_pieces.size() == pieces.size())
      return "";
    std::ostringstream text;
    text << free_pieces.size() << " of the " << pieces.size() << " pieces "
         << (free_pieces.size() == 1 ? "is" : "are") << " not held anywhere: ";
    for (std::size_t i = 0; i < std::min(n_shown, free_pieces.size()); ++i)
      {
        const MeshReport::Piece &piece = pieces[free_pieces[i]];
        text << (i == 0 ? "" : "; ") << "that of " << piece.n_cells
             << (piece.n_cells == 1 ? " cell" : " cells") << " in "
             << extent_in_words(piece.box, body.mesh.section.plane() ? 2 : 3) << " m";
      }
    if (free_pieces.size() > n_shown)
      text << "; and " << free_pieces.size() - n_shown << " more";
    text << ".";
    return text.str();
  }


  std::vector<double>
  Constraints::held_products() const
  {
    std::vector<double> own(36 * body.mesh.report.parts.size()), total(own.size());
    for (const unsigned int dof : held_owned)
      {
        const unsigned int part = body.mesh.parts->parts[dof / 3];
        if (part >= body.mesh.report.parts.size())
          continue;
        const Eigen::Matrix<double, 6, 1> motion =
          RigidMotions(body.mesh.report.parts[part].box).at(body.position(dof / 3)).row(dof % 3);
        Eigen::Map<Eigen::Matrix<double, 6, 6>>(&own[36 * static_cast<std::size_t>(part)]) +=
          motion * motion.transpose();
      }
    Utilities::MPI::sum(own, body.mesh.communicator, total);
    return total;
  }


  std::string
  Constraints::free_motions_in_words() const
  {
    return Supple::free_motions_in_words(body.mesh, products);
  }


  void
  Constraints::add_motion(const MotionParameters &motion,
                          const std::string &section,
                          const ParameterFile &scene)
  {
    const auto nodes =
      Selection(body).selected_nodes(Utilities::trim(motion.of), scene.origin(section + "/Of"));
    const std::string origin = scene.origin(section + "/Displacement");
    const auto components    = Utilities::split_string_list(motion.displacement, ';');
    if (components.size() != 3)
      throw InputError(origin + ": found " + std::to_string(components.size()) +
                       " expression(s); there must be 3, set apart by semicolons.");
    for (unsigned int i = 0; i < 3; ++i)
      {
        if (components[i] == "free")
          continue;
        const auto displacement = std::make_shared<const Expression>(components[i], 1, origin);
        const auto at           = [displacement](const Point<3> &place, const double time) {
          return displacement->value(place, time);
        };
        motions.push_back({i, at, {}, sample_of(nodes)});
        unsigned int n_twice = 0, n_by_nature = 0;
        for (unsigned int node = 0; node < body.n_local; ++node)
          if (nodes[node] && body.is_held_by_nature(3 * node + i))
            ++n_by_nature;
          else if (nodes[node])
            {
              n_twice += held[3 * node + i];
              held[3 * node + i] = true;
              if (node < body.n_owned)
                motions.back().nodes.push_back(node);
            }
        if (!displacement->is_zero() &&
            Utilities::MPI::max(n_by_nature, body.mesh.communicator) > 0)
          throw InputError(origin +
                           ": some of these vertices are on the axis and stay there; along "
                           "x their displacement must be 0 or free.");
        if (Utilities::MPI::max(n_twice, body.mesh.communicator) > 0)
          throw InputError(scene.origin(section + "/Of") +
                           ": some of these vertices are held or moved already along " +
                           std::string(1, "xyz"[i]) + ".");
      }
  }


  void
  Constraints::add_hand(const ConstraintParameters::ByHand &hand)
  {
    const Point<3> place = Selection(body).place_of_vertex(hand.vertex);
    for (unsigned int i = 0; i < 3; ++i)
      {
        const auto at = [i, path = hand.path](const Point<3> &rest, const double time) {
          return path->at(time)[i] - rest[i];
        };
        motions.push_back({i, at, {}, place});
        unsigned int held_twice = 0;
        for (unsigned int node = 0; node < body.n_local; ++node)
          if (body.serial_vertex[node] == hand.vertex && !body.is_held_by_nature(3 * node + i))
            {
              held_twice         = held[3 * node + i] ? 1 : 0;
              held[3 * node + i] = true;
              if (node < body.n_owned)
                motions.back().nodes.push_back(node);
            }
        if (Utilities::MPI::max(held_twice, body.mesh.communicator) > 0)
          throw InputError(Selection(body).vertex_in_words(hand.vertex) +
                           " is held or moved already along " + std::string(1, "xyz"[i]) + ".");
      }
  }


  Point<3>
  Constraints::sample_of(const std::vector<bool> &nodes) const
  {
    unsigned int first = numbers::invalid_unsigned_int;
    for (unsigned int node = 0; node < body.n_owned; ++node)
      if (nodes[node])
        first = std::min(first, body.serial_vertex[node]);
    return Selection(body).place_of_vertex(Utilities::MPI::min(first, body.mesh.communicator));
  }


  void
  Constraints::set_displacement(Vector &displacement, const double time) const
  {
    set_zero(displacement);
    for (const Motion &motion : motions)
      for (const unsigned int node : motion.nodes)
        displacement.local_element(3 * node + motion.direction) =
          motion.displacement(body.position(node), time);
  }


  void
  Constraints::set_velocity(Vector &velocity, const double time, const double interval) const
  {
    set_zero(velocity);
    for (const Motion &motion : motions)
      for (const unsigned int node : motion.nodes)
        velocity.local_element(3 * node + motion.direction) =
          rate(motion.displacement, body.position(node), time, interval);
  }


  bool
  Constraints::jump(const double start, const double end) const
  {
    const double interval = 1e-4 * (end - start), round_off = 1e-6 * body.mesh.diameter();
    return std::any_of(motions.begin(), motions.end(), [&](const Motion &motion) {
      const auto &u       = motion.displacement;
      const double way    = std::abs(u(motion.sample, end) - u(motion.sample, start));
      const double speeds = std::abs(rate(u, motion.sample, start, interval)) +
                            std::abs(rate(u, motion.sample, end, -interval));
      return way > 2. * (end - start) * speeds + round_off;
    });
  }


  void
  Constraints::copy_held(Vector &to, const Vector &from) const
  {
    for (const unsigned int dof : held_owned)
      to.local_element(dof) = from.local_element(dof);
  }


  void
  Constraints::set_held_on_way(Vector &to,
                               const Vector &start,
                               const Vector &goal,
                               const double part) const
  {
    for (const unsigned int dof : held_owned)
      to.local_element(dof) =
        (1. - part) * start.local_element(dof) + part * goal.local_element(dof);
  }


  void
  Constraints::set_zero(Vector &vector) const
  {
    for (const unsigned int dof : held_owned)
      vector.local_element(dof) = 0.;
  }
} // namespace Supple
