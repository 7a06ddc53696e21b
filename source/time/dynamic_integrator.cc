#include <supple/time/dynamic_integrator.h>

#include <supple/base/error.h>
#include <supple/mechanics/vertex_values.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace Supple
{
  using Json = nlohmann::json;

  DynamicIntegrator::DynamicIntegrator(const Model &model,
                                       const EquationOfMotion::Rotations rotations,
                                       const EquationOfMotion::HeldVelocity held_velocity)
    : TimeIntegrator(model, model.time.last_end())
    , settings(model.time)
    , equation(model, rotations, held_velocity)
    , backward_euler(held_velocity == EquationOfMotion::HeldVelocity::difference)
    , adaptive(settings.has_variable_steps())
    , context(model.body.mesh.communicator)
    , system(context)
    , unknowns(equation.n_unknowns(), model.body.mesh.communicator, context)
    , absolute_tolerances(equation.n_unknowns(), model.body.mesh.communicator, context)
    , failure(context)
    , guard(model)
    , guarded(settings.energy_guard == TimeParameters::EnergyGuard::reject)
  {
    for (Vector *vector :
         {&imbalance, &applied, &load, &momentum, &momentum_at_start, &du, &dv, &dp})
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


  void
  DynamicIntegrator::tie_linear_tolerance(const bool corrected)
  {
    // Of a correction of Newton's method: a hundredth is left to the next one, which tells whether
    // that is enough. In a single solution what is left adds up over the steps.
    constexpr double of_correction = 1e-2, of_solution = 1e-2, loosest = 1e-4;

    const bool direct = model.solver.name() == "ldlt" || model.solver.name() == "cholmod";
    if (!adaptive || direct || model.scene.changes("Solver/Tolerance"))
      return;
    model.solver.set_tolerance(
      corrected ? of_correction
                : std::clamp(of_solution * settings.relative_tolerance, 1e-8, loosest));
  }


  double
  DynamicIntegrator::shortest_step(const double end_of_run)
  {
    return 1e-12 * end_of_run;
  }


  double
  DynamicIntegrator::within_step(const double at) const
  {
    // stages of some methods are beyond the end of their step
    const auto next = std::upper_bound(settings.instants.begin(),
                                       settings.instants.end(),
                                       time + 2. * settings.moment());
    if (next != settings.instants.end() && at > *next - settings.moment())
      return *next - settings.moment();
    if (at < time + settings.moment() && settings.is_instant(time))
      return time + settings.moment();
    return at;
  }


  void
  DynamicIntegrator::keep_past()
  {
    keeps_past = true;
    equation.keep_origin();
  }


  void
  DynamicIntegrator::begin_past(const double start, const double first_size)
  {
    past = {start, first_size, end, 0};
    if (keeps_past)
      context.record->begin();
  }


  Json
  DynamicIntegrator::save_memory() const
  {
    const Sundials::Decisions &decisions = context.record->decisions();

    Json vectors = Json::array();
    for (const N_Vector vector : remembered())
      {
        vectors.push_back(gathered_by_vertex(model.body, Sundials::data(vector)));
        vectors.push_back(
          gathered_by_vertex(model.body, Sundials::data(vector) + equation.n_unknowns() / 2));
      }
    return {{"start", past.start},
            {"first_size", past.first_size},
            {"end", past.end},
            {"steps", past.n_steps},
            {"reductions", decisions.reductions},
            {"failures", decisions.failures},
            {"calls", decisions.n_calls},
            {"vectors", vectors}};
  }


  void
  DynamicIntegrator::load_memory(const Json &saved)
  {
    past.start      = saved.at("start");
    past.first_size = saved.at("first_size");
    past.end        = saved.at("end");
    past.n_steps    = saved.at("steps");

    Sundials::Decisions decisions;
    decisions.reductions = saved.at("reductions").get<std::vector<double>>();
    decisions.failures   = saved.at("failures").get<std::map<unsigned long, int>>();
    decisions.n_calls    = saved.at("calls");
    context.record->play(decisions);
    const bool repeated = repeat_past();
    const bool ended    = context.record->end_of_play();

    const auto values = saved.at("vectors").get<std::vector<std::vector<double>>>();
    const std::vector<N_Vector> vectors = remembered();
    if (!repeated || !ended || values.size() != 2 * vectors.size())
      throw std::out_of_range("steps of another integrator");
    for (std::size_t k = 0; k < vectors.size(); ++k)
      {
        double *const entries = Sundials::data(vectors[k]);
        scatter_by_vertex(model.body, values[2 * k], entries);
        scatter_by_vertex(model.body, values[2 * k + 1], entries + equation.n_unknowns() / 2);
      }
  }


  std::vector<N_Vector>
  DynamicIntegrator::remembered() const
  {
    std::vector<N_Vector> vectors = context.record->vectors;
    vectors.push_back(unknowns);
    return vectors;
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
  DynamicIntegrator::advance(const bool observed)
  {
    Configuration &configuration = model.configuration;
    configuration.begin_step(time);
    if ((!started || settings.is_instant(time)) && (observed || guarded))
      set_forces(within_step(time));
    if (observed || guarded)
      set_momentum_at_start();
    has_momentum = false;
    if (!started && guarded)
      guard.start(time, momentum_at_start);
    started = true;

    const double start                   = time;
    const unsigned int iterations_so_far = equation.linear_iterations;
    StepReport report                    = step_once(observed || guarded);
    while (guarded && guard.rises(report) && make_safer())
      {
        try
          {
            report = step_again(start);
          }
        catch (const ComputationError &)
          {
            if (!make_simpler())
              throw;
            report = step_again(start);
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
  DynamicIntegrator::step_again(const double start)
  {
    ++model.effort.rejected_steps;
    time = start;
    model.configuration.reject(model.effort);
    set_forces(time);
    return step_once(true);
  }


  StepReport
  DynamicIntegrator::step_once(const bool observed)
  {
    Configuration &configuration = model.configuration;
    equation.begin_step(time);
    StepReport report;
    try
      {
        report = take_step();
        if (!all_finite(configuration.displacement()) || !all_finite(configuration.velocity()))
          throw ComputationError("the motion is not finite any more");
      }
    catch (...)
      {
        configuration.reject(model.effort);
        throw;
      }
    report.dt         = report.time - time;
    const double last = within_step(report.time);
    if (backward_euler) // dt^2/2 |u''|
      report.local_error =
        0.5 * report.dt *
        largest_vertex_distance(configuration.velocity(), configuration.start_of_step().velocity);

    time = report.time;
    if (!equation.rotations_are_frozen())
      configuration.update_rotations(model.effort);
    if (observed)
      observe(report, last);
    if (equation.rotations_are_frozen())
      configuration.update_rotations(model.effort);
    return report;
  }


  void
  DynamicIntegrator::set_momentum_at_start()
  {
    if (has_momentum)
      momentum_at_start.swap(momentum);
    else
      model.body.set_mass_product(momentum_at_start, model.configuration.velocity());
  }


  void
  DynamicIntegrator::set_forces(const double at_time)
  {
    Effort uncounted; // these forces are for the eye alone
    equation.set_net_force(imbalance, at_time, uncounted);
    imbalance *= -1.;
    if (model.forces.do_work())
      model.forces.set_working(applied, model.configuration, at_time);
  }


  /**
   * With the change d of a quantity over the step, backward Euler with the rotations of the step
   * gives d(kinetic) + 1/2 dv.M dv + (f_int(u1) + D v1).du = f1.du, and all but the first term on
   * the left is what the step expended. For the other methods work is what the mean of the forces
   * at both ends did, and the inertia of moved vertices at their mean velocity; what is missing in
   * the balance then is dissipated.
   */
  void
  DynamicIntegrator::observe(StepReport &report, const double last)
  {
    const PhaseTimer timer(model.effort, Phase::diagnostics);
    const Configuration &configuration = model.configuration;
    const State &start                 = configuration.start_of_step();
    du                                 = configuration.displacement();
    dv                                 = configuration.velocity();
    du -= start.displacement;
    dv -= start.velocity;
    model.body.set_mass_product(momentum, configuration.velocity());
    has_momentum    = true;
    report.momentum = &momentum;
    dp              = momentum;
    dp -= momentum_at_start;

    // Half the work of the forces at the start of the step, half of those at its end; or all of
    // these.
    const double start_weight = backward_euler ? 0. : 0.5;
    const auto add_work       = [&](const double weight) {
      if (model.forces.do_work())
        report.load_work += weight * (applied * du);
      if (model.constraints.move())
        {
          set_reactions(imbalance);
          report.load_work += weight * (reactions() * du);
        }
    };
    if (start_weight > 0.)
      add_work(start_weight);
    set_forces(last);
    add_work(1. - start_weight);
    report.load_work += model.forces.work_of_time(configuration,
                                                  report.time - report.dt,
                                                  report.time,
                                                  1. - start_weight);
    add_work_of_tools(report, start_weight);
    if (model.constraints.move())
      {
        // Moved vertices may change their velocity at once: then its mean counts.
        set_reactions(dp);
        report.load_work += backward_euler
                              ? (reactions() * du) / report.dt
                              : reactions() * start.velocity + 0.5 * (reactions() * dv);
      }

    if (backward_euler)
      {
        model.forces.set_loads(load, configuration, report.time);
        report.expended = 0.5 * (dv * dp) + imbalance * du + load * du;
      }
    dp *= 1. / report.dt;
    dp += imbalance;
    set_reactions(dp);
  }
} // namespace Supple
