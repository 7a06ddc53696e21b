#include <supple/time/equation_of_motion.h>

#include <supple/base/error.h>
#include <supple/mechanics/vertex_values.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    void
    copy_out(double *to, const Vector &from)
    {
      std::copy_n(from.begin(), from.locally_owned_size(), to);
    }


    void
    copy_in(Vector &to, const double *from)
    {
      std::copy_n(from, to.locally_owned_size(), to.begin());
    }
  } // namespace


  EquationOfMotion::EquationOfMotion(const Model &model,
                                     const Rotations rotations,
                                     const HeldVelocity held_velocity)
    : model(model)
    , n(3 * model.body.n_owned)
    , tangent(Tangent::frozen)
    , held_velocity(held_velocity)
    , inertia_couples(!model.material.lumped && model.material.vertex_mass == 0.)
    , mass_solver(model.implicit_operator)
  {
    for (Vector *vector : {&force, &scratch, &solution})
      model.body.initialize(*vector);
    if (model.constraints.move())
      for (Vector *vector : {&prescribed_displacement, &prescribed_velocity, &shift})
        model.body.initialize(*vector);

    set_rotations(rotations);
  }


  void
  EquationOfMotion::set_rotations(const Rotations rotations)
  {
    const Tangent wanted              = model.time.tangent;
    model.configuration.rotations_are = rotations;
    tangent                           = Tangent::frozen;
    if (is_split)
      return;
    if (rotations == Rotations::following && model.forces.change_operator() &&
        model.forces.have_energy() && wanted != Tangent::frozen)
      tangent = wanted == Tangent::definite ? Tangent::definite : Tangent::consistent;
    gives_way = wanted == Tangent::automatic && tangent == Tangent::consistent;
  }


  void
  EquationOfMotion::begin_step(const double time)
  {
    step_start = time;
    replaced   = false;
    if (model.constraints.move())
      prescribed_time = -1.; // the same time may have another velocity in another step
  }


  void
  EquationOfMotion::get_unknowns(double *y)
  {
    contraction = 1.; // nothing is known of what was
    stage_time  = -1.;
    scratch     = model.configuration.displacement();
    model.constraints.set_zero(scratch);
    copy_out(y, scratch);
    scratch = model.configuration.velocity();
    model.constraints.set_zero(scratch);
    if (model.constraints.move())
      {
        set_shift(model.configuration.velocity());
        scratch += shift;
        prescribed_time = -1.;
      }
    copy_out(y + n, scratch);
  }


  void
  EquationOfMotion::set_configuration(const double time, const double *y)
  {
    State &state       = model.configuration.state;
    Passage &passage   = model.configuration.passage;
    configuration_time = time;
    passage.to         = time;
    copy_in(state.displacement, y);
    copy_in(state.velocity, y + n);
    if (model.constraints.move())
      {
        if (time != prescribed_time)
          prescribe(time);
        state.velocity -= shift;
        model.constraints.copy_held(state.displacement, prescribed_displacement);
        model.constraints.copy_held(state.velocity, prescribed_velocity);
        if (passage.part < 1.)
          model.constraints.set_held_on_way(state.displacement,
                                            model.configuration.start_of_step().displacement,
                                            prescribed_displacement,
                                            passage.part);
      }
  }


  void
  EquationOfMotion::prescribe(const double time)
  {
    model.constraints.set_displacement(prescribed_displacement, time);
    set_held_velocity(prescribed_velocity, time);
    set_shift(prescribed_velocity);
    prescribed_time = time;
  }


  void
  EquationOfMotion::set_held_velocity(Vector &held, const double time)
  {
    if (held_velocity == HeldVelocity::derivative)
      {
        // Of what lies within the step: a motion may have kinks where steps meet.
        const double interval = model.time.derivative_interval();
        const bool at_start   = time - step_start < 4. * interval;
        model.constraints.set_velocity(held, time, at_start ? interval : -interval);
      }
    else if (time <= step_start)
      held = model.configuration.start_of_step().velocity;
    else
      {
        held = prescribed_displacement;
        held -= model.configuration.start_of_step().displacement;
        held *= 1. / (time - step_start);
      }
  }


  void
  EquationOfMotion::set_shift(const Vector &held)
  {
    shift = 0.;
    if (!inertia_couples)
      return;
    model.constraints.copy_held(shift, held);
    model.body.set_mass_product(force, shift);
    model.constraints.set_zero(force);
    shift = 0.;
    mass_solver.solve(shift, force);
  }


  void
  EquationOfMotion::set_net_force(Vector &net, const double time, Effort &effort)
  {
    const DampingParameters &damping = model.damping;
    const Vector &velocity           = model.configuration.velocity();
    model.forces.set_force(net, model.configuration, time, effort);
    if (damping.mass_factor > 0.)
      {
        model.body.set_mass_product(scratch, velocity);
        net.add(-damping.mass_factor, scratch);
      }
    if (damping.viscous > 0.)
      net.add(-damping.viscous, velocity);
  }


  void
  EquationOfMotion::evaluate(double *f, const double time, const double *y)
  {
    if (time != stage_time)
      stage_solutions = 0;
    stage_time = time;
    set_configuration(time, y);
    if (!rotations_are_frozen())
      model.configuration.update_rotations(model.effort);

    scratch = model.configuration.velocity();
    model.constraints.set_zero(scratch);
    copy_out(f, scratch);

    set_net_force(force, time, model.effort);
    model.constraints.set_zero(force);
    if (!all_finite(force))
      throw ComputationError("the forces are not finite numbers");
    copy_out(f + n, force);
  }


  void
  EquationOfMotion::split()
  {
    is_split  = true;
    tangent   = Tangent::frozen;
    gives_way = false;
    model.body.initialize(kept_force);
  }


  void
  EquationOfMotion::renew_splitting(const double new_gamma, const double angle, const bool wanted)
  {
    at_start              = true;
    has_start             = false;
    const bool other_step = std::abs(new_gamma - gamma) > 1e-12 * new_gamma;
    if (!splitting || other_step || wanted || angle == 0. ||
        model.implicit_operator.cells_have_turned(angle * numbers::PI / 180.))
      renew_rotations();
  }


  void
  EquationOfMotion::renew_rotations()
  {
    model.forces.update_tangent(tangent, model.configuration, configuration_time, model.effort);
    model.implicit_operator.keep_rotations();
    splitting = true;
    gamma     = 0.;
    if (keeps_origin)
      origin = {model.configuration.displacement(), configuration_time, 0., false};
  }


  void
  EquationOfMotion::evaluate_implicit(double *f, const double time, const double *y)
  {
    // all processes or none: what follows is collective
    const bool same = has_start && std::equal(start.begin(), start.end(), y);
    if (has_start && Utilities::MPI::min(same ? 1 : 0, model.body.mesh.communicator) == 1)
      std::copy(rates.begin(), rates.end(), f);
    else
      evaluate_unloaded(f, time, y);
    if (!has_start && !model.constraints.move())
      {
        has_start = true;
        start.assign(y, y + 2 * n);
        rates.assign(f, f + 2 * n);
      }
    add_dead_loads(f, time);
  }


  void
  EquationOfMotion::evaluate_unloaded(double *f, const double time, const double *y)
  {
    const DampingParameters &damping = model.damping;
    set_configuration(time, y);
    model.implicit_operator.elastic_vmult(force,
                                          model.configuration.displacement(),
                                          model.configuration.velocity());
    if (damping.mass_factor > 0.)
      {
        model.body.set_mass_product(scratch, model.configuration.velocity());
        force.add(damping.mass_factor, scratch);
      }
    if (damping.viscous > 0.)
      force.add(damping.viscous, model.configuration.velocity());
    force *= -1.;
    scratch = model.configuration.velocity();
    for (Vector *vector : {&scratch, &force})
      model.constraints.set_zero(*vector);
    copy_out(f, scratch);
    copy_out(f + n, force);
  }


  void
  EquationOfMotion::add_dead_loads(double *f, const double time)
  {
    if (!model.forces.have_dead_loads())
      return;
    model.forces.set_dead_loads(force, model.configuration, time);
    model.constraints.set_zero(force);
    if (!all_finite(force))
      throw ComputationError("the forces are not finite numbers");
    for (unsigned int i = 0; i < n; ++i)
      f[n + i] += force.local_element(i);
  }


  void
  EquationOfMotion::evaluate_explicit(double *f, const double time, const double *y)
  {
    set_configuration(time, y);
    if (!at_start)
      model.configuration.update_rotations(model.effort);
    at_start = false;
    model.forces.set_other_forces(force, model.configuration, time, model.effort);
    model.implicit_operator.elastic_vmult(kept_force,
                                          model.configuration.displacement(),
                                          model.configuration.velocity());
    force += kept_force;
    model.constraints.set_zero(force);
    if (!all_finite(force))
      throw ComputationError("the forces are not finite numbers");
    std::fill_n(f, n, 0.);
    copy_out(f + n, force);
  }


  void
  EquationOfMotion::prepare_split(const double new_gamma)
  {
    if (std::abs(new_gamma - gamma) <= 1e-12 * new_gamma)
      return;
    gamma = 0.; // until all has succeeded
    if (model.implicit_operator.assemble(new_gamma))
      model.solver.prepare(model.configuration.displacement());
    gamma = new_gamma;
    if (keeps_origin)
      origin.gamma = gamma;
  }


  void
  EquationOfMotion::mass_product(double *y, const double *x)
  {
    std::copy_n(x, n, y);
    copy_in(scratch, x + n);
    model.implicit_operator.mass_vmult(force, scratch);
    copy_out(y + n, force);
  }


  void
  EquationOfMotion::foresee_increment(const double *const velocities)
  {
    copy_in(solution, velocities);
  }


  void
  EquationOfMotion::solve_mass(double *x, const double *b)
  {
    const PhaseTimer timer(model.effort, Phase::solve);
    const std::vector<double> &mass = model.implicit_operator.mass_matrix().diagonal;
    std::copy_n(b, n, x);
    copy_in(scratch, b + n);
    if (inertia_couples)
      {
        // The last linear system of an implicit step of one stage has found this increment already.
        mass_solver.solve(solution, scratch);
        copy_out(x + n, solution);
      }
    else
      for (unsigned int i = 0; i < n; ++i)
        x[n + i] = b[n + i] / mass[i / 3];
  }


  void
  EquationOfMotion::linearize(const double time, const double *y, const double new_gamma)
  {
    gamma = new_gamma;
    set_configuration(time, y);
    if (!rotations_are_frozen())
      model.configuration.update_rotations(model.effort);
    relinearize();
  }


  void
  EquationOfMotion::relinearize()
  {
    try
      {
        assemble();
      }
    catch (const ComputationError &)
      {
        if (!gives_way || replaced)
          throw;
        replaced = true;
        assemble();
      }
  }


  void
  EquationOfMotion::make_definite()
  {
    if (tangent != Tangent::consistent || replaced)
      return;
    replaced = true;
    assemble();
  }


  void
  EquationOfMotion::set_gamma(const double new_gamma)
  {
    if (std::abs(new_gamma - gamma) <= 1e-12 * new_gamma)
      return;
    gamma = new_gamma;
    assemble();
  }


  void
  EquationOfMotion::assemble()
  {
    model.forces.update_tangent(replaced ? Tangent::definite : tangent,
                                model.configuration,
                                configuration_time,
                                model.effort);
    if (model.implicit_operator.assemble(gamma))
      model.solver.prepare(model.configuration.displacement());
    if (keeps_origin)
      origin = {model.configuration.displacement(), configuration_time, gamma, replaced};
  }


  nlohmann::json
  EquationOfMotion::save(const bool with_operator) const
  {
    nlohmann::json saved = {{"stage_time", stage_time},
                            {"stage_solutions", stage_solutions},
                            {"correction", correction},
                            {"contraction", contraction},
                            {"solution", gathered_by_vertex(model.body, solution.begin())}};
    if (with_operator && origin.gamma > 0.)
      saved["operator"] = {{"displacement",
                            gathered_by_vertex(model.body, origin.displacement.begin())},
                           {"time", origin.time},
                           {"gamma", origin.gamma},
                           {"replaced", origin.replaced}};
    return saved;
  }


  void
  EquationOfMotion::load(const nlohmann::json &saved)
  {
    stage_time      = saved.at("stage_time");
    stage_solutions = saved.at("stage_solutions");
    correction      = saved.at("correction");
    contraction     = saved.at("contraction");
    scatter_by_vertex(model.body, saved.at("solution"), solution.begin());
    if (saved.contains("operator"))
      assemble_as_at(saved.at("operator"));
  }


  void
  EquationOfMotion::assemble_as_at(const nlohmann::json &saved)
  {
    Vector &displacement = model.configuration.state.displacement;
    const Vector now     = displacement;
    scatter_by_vertex(model.body, saved.at("displacement"), displacement.begin());
    model.configuration.update_rotations(model.effort);
    configuration_time = saved.at("time");
    replaced           = saved.at("replaced");
    if (is_split)
      {
        renew_rotations();
        prepare_split(saved.at("gamma"));
      }
    else
      {
        gamma = saved.at("gamma");
        assemble();
      }
    displacement = now;
    model.configuration.update_rotations(model.effort);
  }


  void
  EquationOfMotion::solve(double *x, const double *b)
  {
    copy_in(scratch, b);
    model.implicit_operator.stiffness_vmult(force, scratch);
    copy_in(scratch, b + n);
    force.sadd(-gamma, 1., scratch);
    model.constraints.set_zero(force);
    try
      {
        linear_iterations += model.solver.solve(solution, force);
      }
    catch (const ComputationError &)
      {
        if (!gives_way || replaced)
          throw;
        replaced = true;
        assemble();
        linear_iterations += model.solver.solve(solution, force);
      }
    for (unsigned int i = 0; i < n; ++i)
      {
        const double increment = solution.local_element(i);

        x[n + i] = increment;
        x[i]     = b[i] + gamma * increment;
      }
  }


  /**
   * An operator that is one iteration old contracts the error about as much as the second
   * correction is smaller than the first. Up to a tenth that is cheaper than to assemble and
   * factorize anew.
   */
  void
  EquationOfMotion::solve_newton(double *x, const double *b)
  {
    if (stage_solutions > 0 && contraction > 0.1)
      assemble();
    solve(x, b);
    const double norm = solution.l2_norm();
    if (stage_solutions == 1)
      contraction = norm / correction;
    else if (stage_solutions > 1 && norm > 0.3 * correction)
      contraction = 1.;
    correction = norm;
    ++stage_solutions;
  }

} // namespace Supple
