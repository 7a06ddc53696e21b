#include <supple/base/error.h>
#include <supple/time/dynamic_integrator.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  DynamicIntegrator::DynamicIntegrator(const Model &model,
                                       const EquationOfMotion::Rotations rotations,
                                       const EquationOfMotion::HeldVelocity held_velocity)
    : TimeIntegrator(model, model.time.end())
    , settings(model.time)
    , equation(model, rotations, held_velocity)
    , backward_euler(held_velocity == EquationOfMotion::HeldVelocity::difference)
    , adaptive(settings.has_variable_steps())
    , context(model.body.mesh.communicator)
    , system(context)
    , unknowns(equation.n_unknowns(), model.body.mesh.communicator, context)
    , absolute_tolerances(equation.n_unknowns(), model.body.mesh.communicator, context)
    , guard(model)
    , guarded(settings.energy_guard == TimeParameters::EnergyGuard::reject)
  {
    for (Vector *vector : {&imbalance, &applied, &work_space})
      model.body.initialize(*vector);
    system.solve = [this](double *x, const double *b) {
      return failure.guard([&] { equation.solve(x, b); });
    };
  }


  double
  DynamicIntegrator::wave_rate() const
  {
    const Body &body = model.body;
    double square    = 0.; // of the speed
    for (const auto &[id, n_cells] : body.mesh.materials)
      {
        const IsotropicMaterial &material = body.material(id);
        const double vertex_mass          = model.material.vertex_mass;
        const double density              = vertex_mass > 0.
                                              ? body.mesh.n_vertices * vertex_mass / body.mesh.volume
                                              : material.density;
        square = std::max(square, (material.lambda + 2. * material.mu) / density);
      }
    return std::sqrt(square) / body.mesh.diameter();
  }


  double
  DynamicIntegrator::set_tolerances()
  {
    const double relative = adaptive ? settings.relative_tolerance : settings.newton_tolerance;
    double displacement   = 0.01 * model.body.mesh.diameter() * relative;
    if (adaptive && settings.displacement_tolerance > 0.)
      displacement = settings.displacement_tolerance;
    double velocity = displacement * wave_rate();
    if (adaptive && settings.velocity_tolerance > 0.)
      velocity = settings.velocity_tolerance;

    const unsigned int n = equation.n_unknowns() / 2;
    std::fill_n(absolute_tolerances.data(), n, displacement);
    std::fill_n(absolute_tolerances.data() + n, n, velocity);
    return relative;
  }


  double
  DynamicIntegrator::shortest_step() const
  {
    return 1e-12 * end;
  }


  void
  DynamicIntegrator::throw_what_failed()
  {
    failure.rethrow();
    throw ComputationError("SUNDIALS says " + context.message);
  }


  double
  DynamicIntegrator::largest_displacement(const double *const values) const
  {
    double square = 0.;
    for (unsigned int i = 0; i < equation.n_unknowns() / 2; i += 3)
      square = std::max(square,
                        values[i] * values[i] + values[i + 1] * values[i + 1] +
                          values[i + 2] * values[i + 2]);
    return std::sqrt(dealii::Utilities::MPI::max(square, model.body.mesh.communicator));
  }


  StepReport
  DynamicIntegrator::advance(State &state, const bool observed)
  {
    if (!started && (observed || guarded))
      set_forces(state, time);
    if (!started && guarded)
      guard.start(state);
    started = true;

    const double start                   = time;
    const unsigned int iterations_so_far = equation.linear_iterations;
    previous                             = state;
    StepReport report                    = step_once(state, observed || guarded);
    while (guarded && guard.rises(state, report.load_work) && make_safer())
      {
        try
          {
            report = step_again(state, start);
          }
        catch (const ComputationError &)
          {
            if (!make_simpler())
              throw;
            report = step_again(state, start);
          }
      }
    if (guarded)
      {
        guard.accept();
        accept_step();
      }
    model.effort.jumps += model.constraints.move() && model.constraints.jump(start, report.time);
    report.linear_iterations = equation.linear_iterations - iterations_so_far;
    return report;
  }


  StepReport
  DynamicIntegrator::step_again(State &state, const double start)
  {
    ++model.effort.rejected_steps;
    time  = start;
    state = previous;
    model.body.update_rotations(state.block(0), model.effort);
    set_forces(state, time);
    return step_once(state, true);
  }


  StepReport
  DynamicIntegrator::step_once(State &state, const bool observed)
  {
    equation.begin_step(time, state);
    StepReport report;
    try
      {
        report = take_step(state);
        if (!all_finite(state.block(0)) || !all_finite(state.block(1)))
          throw ComputationError("the motion is not finite any more");
      }
    catch (...)
      {
        state = previous;
        model.body.update_rotations(state.block(0), model.effort);
        throw;
      }
    report.dt = report.time - time;
    if (backward_euler) // dt^2/2 |u''|
      report.local_error =
        0.5 * report.dt * largest_vertex_distance(state.block(1), previous.block(1));

    time = report.time;
    if (!equation.rotations_are_frozen())
      model.body.update_rotations(state.block(0), model.effort);
    if (observed)
      observe(state, report);
    if (equation.rotations_are_frozen())
      model.body.update_rotations(state.block(0), model.effort);
    return report;
  }


  void
  DynamicIntegrator::set_forces(const State &state, const double at_time)
  {
    Effort uncounted; // these forces are for the eye alone
    model.body.internal_force(imbalance, state.block(0), uncounted);
    if (model.damping.any())
      {
        equation.full_damping_product(work_space, state.block(1));
        imbalance += work_space;
      }
    const Vector &surface = equation.pushed_surface(state.block(0));
    imbalance -= model.loads.force(at_time, surface);
    if (model.loads.any_applied())
      applied = model.loads.applied_force(at_time, surface);
  }


  /**
   * With the change d of a quantity over the step, backward Euler with the rotations of the step
   * gives d(kinetic) + 1/2 dv.M dv + (f_int(u1) + D v1).du = f1.du, and all but the first term on
   * the left is what the step expended. For the other methods work is what the mean of the forces
   * at both ends did, and the inertia of moved vertices at their mean velocity; what is missing in
   * the balance then is dissipated.
   */
  void
  DynamicIntegrator::observe(const State &state, StepReport &report)
  {
    const PhaseTimer timer(model.effort, Phase::diagnostics);
    Vector du = state.block(0), dv = state.block(1), inertia;
    du -= previous.block(0);
    dv -= previous.block(1);
    model.body.initialize(inertia);
    equation.full_mass_product(inertia, dv);

    // Half the work of the forces at the start of the step, half of those at its end; or all of
    // these.
    const double start_weight = backward_euler ? 0. : 0.5;
    const auto add_work       = [&](const double weight) {
      if (model.loads.any_applied())
        report.load_work += weight * (applied * du);
      if (model.constraints.move())
        {
          set_reactions(imbalance);
          report.load_work += weight * (reactions() * du);
        }
    };
    if (start_weight > 0.)
      add_work(start_weight);
    set_forces(state, report.time);
    add_work(1. - start_weight);
    if (model.constraints.move())
      {
        // Moved vertices may change their velocity at once: then its mean counts.
        set_reactions(inertia);
        report.load_work += backward_euler
                              ? (reactions() * du) / report.dt
                              : reactions() * previous.block(1) + 0.5 * (reactions() * dv);
      }

    if (backward_euler)
      {
        const Vector &load =
          model.loads.force(report.time, equation.pushed_surface(state.block(0)));
        report.expended = 0.5 * (dv * inertia) + imbalance * du + load * du;
      }
    inertia *= 1. / report.dt;
    inertia += imbalance;
    set_reactions(inertia);
  }
} // namespace Supple
