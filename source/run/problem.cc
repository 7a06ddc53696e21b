#include <supple/run/problem.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>

#include <deal.II/physics/transformations.h>

#include <array>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** The rigid motions of the body that are free, in words. */
    std::string
    free_rigid_motions(const Constraints &constraints)
    {
      if (constraints.n_rigid_motions == 1)
        return "its one rigid motion, along its axis, is free";
      return std::to_string(constraints.n_free_rigid_motions) + " of its " +
             (constraints.n_rigid_motions == 6 ? "six" : "three") + " rigid motions are free";
    }
  } // namespace


  Problem::Problem(const Parameters &scene, const MPI_Comm communicator)
    : parameters(scene)
    , stationary(parameters.time.problem == TimeParameters::Problem::stationary)
    , mesh(parameters, communicator)
    , body(mesh, parameters)
    , constraints(body, parameters)
    , loads(body, parameters)
    , implicit_operator(body, constraints, parameters, effort)
    , solver(LinearSolver::create(implicit_operator, parameters, effort))
  {
    require_held_body();
    create_initial_state();
  }


  Model
  Problem::model()
  {
    return {body, constraints, loads, implicit_operator, *solver, parameters, effort};
  }


  void
  Problem::require_held_body() const
  {
    const std::string free_pieces = constraints.free_pieces_in_words();
    if (stationary && !free_pieces.empty())
      throw InputError("A static scene needs a body that is held: " + free_pieces);
    if (stationary && constraints.n_free_rigid_motions > 0)
      throw InputError(
        "A static scene needs a body that is held: " + free_rigid_motions(constraints) +
        ", so that the stiffness is singular. Hold a boundary or a region "
        "(subsection Constraints), or make the problem dynamic.");
  }


  void
  Problem::turn(Vector &displacement) const
  {
    const double degrees = parameters.start.rotation.norm();
    if (degrees == 0.)
      return;
    const auto R =
      Physics::Transformations::Rotations::rotation_matrix_3d(parameters.start.rotation / degrees,
                                                              degrees * numbers::PI / 180.);
    for (unsigned int node = 0; node < body.n_owned; ++node)
      {
        const Tensor<1, 3> arm = body.position(node) - parameters.start.rotation_center;
        const Tensor<1, 3> u   = R * arm - arm;
        for (unsigned int i = 0; i < 3; ++i)
          displacement.local_element(3 * node + i) = u[i];
      }
  }


  /** A static problem has no velocity, so its state has one block only. */
  void
  Problem::create_initial_state()
  {
    state.reinit(stationary ? 1 : 2);
    for (unsigned int b = 0; b < state.n_blocks(); ++b)
      body.initialize(state.block(b));
    state.collect_sizes();

    const std::array<std::pair<const char *, std::string>, 2> starts = {
      {{"Start/Displacement", parameters.start.displacement},
       {"Start/Velocity", parameters.start.velocity}}};
    turn(state.block(0));
    for (unsigned int b = 0; b < state.n_blocks(); ++b)
      {
        const Expression expression(starts[b].second, 3, parameters.origin(starts[b].first));
        for (unsigned int node = 0; node < body.n_owned && !expression.is_zero(); ++node)
          for (unsigned int i = 0; i < 3; ++i)
            state.block(b).local_element(3 * node + i) +=
              expression.value(body.position(node), 0., i);
        constraints.set_zero(state.block(b));
        if (!all_finite(state.block(b)))
          throw InputError(parameters.origin(starts[b].first) +
                           ": it is not a finite number at every vertex.");
      }
    if (constraints.move())
      {
        constraints.set_displacement(state.block(0), 0.);
        if (!stationary)
          constraints.set_velocity(state.block(1), 0., parameters.time.derivative_interval());
        for (unsigned int b = 0; b < state.n_blocks(); ++b)
          if (!all_finite(state.block(b)))
            throw InputError(std::string("A displacement of subsection Motion ") +
                             (b == 0 ? "is not a finite number" : "has no finite derivative") +
                             " at time 0.");
      }
  }
} // namespace Supple
