#include <supple/time/arkode_integrator.h>

#include <supple/base/error.h>
#include <supple/time/runge_kutta_tables.h>

#include <arkode/arkode_arkstep.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Supple
{
  using Method = TimeMethod;

  namespace
  {
    /** Within this part of the step a time is the end of the step: it differs by round-off. */
    constexpr double grid_accuracy = 1e-9;

    /** Errors of a single step above this part of the diameter are no errors any more. */
    constexpr double largest_error = 0.1;

    /** A force [N] that the error of a step with it will be too large. */
    constexpr double absurd = 1e30;

    EquationOfMotion::Rotations
    rotations_of(const Method method)
    {
      return method == Method::backward_euler ? EquationOfMotion::Rotations::frozen
                                              : EquationOfMotion::Rotations::following;
    }


    EquationOfMotion::HeldVelocity
    held_velocity_of(const Method method)
    {
      return method == Method::backward_euler || method == Method::implicit_backward_euler
               ? EquationOfMotion::HeldVelocity::difference
               : EquationOfMotion::HeldVelocity::derivative;
    }
  } // namespace


  ArkodeIntegrator::ArkodeIntegrator(const Model &model)
    : DynamicIntegrator(model, rotations_of(model.time.method), held_velocity_of(model.time.method))
    , split(settings.is_semi_implicit() && !model.forces.are_linear())
    , remembers(adaptive || (!settings.is_explicit() && settings.method != Method::backward_euler))
    , mass_system(context)
    , error(equation.n_unknowns(), model.body.mesh.communicator, context)
    , last_size(settings.step)
  {
    if (split)
      equation.split();
    create_memory();
    set_table();
    ARKStepSVtolerances(memory, set_tolerances(), absolute_tolerances);
    if (!settings.is_explicit())
      {
        if (model.forces.contact())
          contact_stages = std::make_unique<ContactStages>(
            model, equation, context, failure, memory, [this](const double at) {
              return time_of(at);
            });
        set_linear_systems();
        tie_linear_tolerance(!linear);
      }
    if (adaptive)
      {
        ARKStepSetMaxStep(memory, longest_step());
        ARKStepSetMaxFirstGrowth(memory, 10.); // not 10000: the first step was not a guess
        if (split)
          ARKStepSetMaxErrTestFails(memory, 20); // from a first step that is far too long
      }
    else
      set_step_size(settings.step);
  }


  ArkodeIntegrator::~ArkodeIntegrator()
  {
    ARKStepFree(&memory);
  }


  std::string
  ArkodeIntegrator::name() const
  {
    return settings.method_name() + " (ARKode" + (adaptive ? ", variable steps)" : ")");
  }


  nlohmann::json
  ArkodeIntegrator::save()
  {
    nlohmann::json saved = {{"time", time},
                            {"grid", grid},
                            {"grid_start", grid_start},
                            {"last_size", last_size},
                            {"was_rejected", was_rejected}};
    saved["equation"]    = equation.save(adaptive || split);
    if (remembers && started)
      saved["memory"] = save_memory();
    return saved;
  }


  void
  ArkodeIntegrator::load(const nlohmann::json &saved)
  {
    time         = saved.at("time");
    grid         = saved.at("grid");
    grid_start   = saved.at("grid_start");
    last_size    = saved.at("last_size");
    was_rejected = saved.at("was_rejected");
    equation.load(saved.at("equation"));
    if (!remembers || !saved.contains("memory"))
      return;
    load_memory(saved.at("memory"));
    if (adaptive)
      set_end(end);
    ARKStepGetNumNonlinSolvIters(memory, &newton_iterations);
    long inaccurate, failed; // of the past that was repeated
    ARKStepGetNumErrTestFails(memory, &inaccurate);
    ARKStepGetNumStepSolveFails(memory, &failed);
    rejections = inaccurate + failed;
    started    = true;
  }


  void
  ArkodeIntegrator::create_memory()
  {
    const ARKRhsFn rate = [](sunrealtype time, N_Vector y, N_Vector f, void *self) {
      auto &integrator = *static_cast<ArkodeIntegrator *>(self);
      return integrator.failure.guard([&] {
        integrator.evaluate(integrator.time_of(time), Sundials::data(y), Sundials::data(f));
      });
    };
    const ARKRhsFn rest = [](sunrealtype time, N_Vector y, N_Vector f, void *self) {
      return static_cast<ArkodeIntegrator *>(self)->evaluate_rest(time, y, f);
    };
    memory = settings.is_explicit()
               ? ARKStepCreate(rate, nullptr, 0., unknowns, context)
               : ARKStepCreate(split ? rest : nullptr, rate, 0., unknowns, context);
    Compatibility::collect_arkode_errors(memory, context.message);
    ARKStepSetUserData(memory, this);
    ARKStepSetMaxNumSteps(memory, -1);
    ARKStepSetMaxHnilWarns(memory, -1);

    // Nothing is asked for between steps; the default would compute the rates at the end of each.
    ARKStepSetInterpolantType(memory, ARK_INTERP_LAGRANGE);
  }


  void
  ArkodeIntegrator::set_table()
  {
    const ARKodeButcherTable table = butcher_table(settings.method);
    const ARKodeButcherTable rest  = split ? explicit_part(settings.method) : nullptr;
    const int order                = table->q;
    const int status               = settings.is_explicit()
                                       ? ARKStepSetTables(memory, order, table->p, nullptr, table)
                                       : ARKStepSetTables(memory, order, table->p, table, rest);
    diagonal                       = table->A[table->stages - 1][table->stages - 1];
    set_embedded_formula(*table);
    if (settings.is_explicit())
      stable = find_stable_step(model.implicit_operator, table, end);
    ARKodeButcherTable_Free(table);
    if (rest)
      ARKodeButcherTable_Free(rest);
    if (status != 0)
      throw_what_failed();
    check_stability();
  }


  void
  ArkodeIntegrator::set_embedded_formula(const ARKodeButcherTableMem &table)
  {
    if (adaptive || !table.d)
      return;
    for (int i = 0; i < table.stages; ++i)
      error_weights.push_back(table.b[i] - table.d[i]);
    first_stage_is_start = table.A[0][0] == 0.;
    ARKStepSetPostprocessStageFn(memory, [](sunrealtype, N_Vector y, void *self) {
      static_cast<ArkodeIntegrator *>(self)->add_stage(Sundials::data(y));
      return 0;
    });
  }


  void
  ArkodeIntegrator::begin_error()
  {
    stage = 0;
    std::fill_n(error.data(), equation.n_unknowns(), 0.);
    if (!error_weights.empty() && first_stage_is_start &&
        !Compatibility::tells_of_explicit_first_stage)
      add_stage(unknowns.data());
  }


  /** The displacement by the formula less that by the embedded one is h sum (b_i - d_i) v_i: of
   * displacements no forces are needed. ARKode itself estimates errors of variable steps alone. */
  void
  ArkodeIntegrator::add_stage(const double *const y)
  {
    if (stage == error_weights.size()) // a step of the past is repeated
      begin_error();
    const unsigned int n = equation.n_unknowns() / 2;
    const double weight  = set_size * error_weights[stage++];
    for (unsigned int i = 0; i < n; ++i)
      error.data()[i] += weight * y[n + i];
  }


  double
  ArkodeIntegrator::embedded_error()
  {
    if (error_weights.empty())
      return std::numeric_limits<double>::quiet_NaN();
    for (const unsigned int dof : model.constraints.owned())
      error.data()[dof] = 0.;
    return largest_displacement(error.data());
  }


  /** Beyond the stable step the fastest oscillations grow, and with them what the relative
   * tolerance allows: an explicit method with a loose one would follow them to any height. */
  double
  ArkodeIntegrator::longest_step() const
  {
    const double wanted = settings.longest_step; // 0: any
    if (!stable)
      return wanted;
    return wanted > 0. ? std::min(wanted, stable->step) : stable->step;
  }


  void
  ArkodeIntegrator::check_stability() const
  {
    if (adaptive || !stable || settings.step <= stable->step)
      return;
    throw InputError(model.scene.origin("Time/Step") + ": " + settings.method_name() +
                     " is stable up to a step of " + stable->description() +
                     ". Take a shorter step, variable steps or an implicit method.");
  }


  void
  ArkodeIntegrator::set_linear_systems()
  {
    system.solve = [this](double *x, const double *b) {
      return failure.guard([&] {
        sunrealtype gamma;
        ARKStepGetCurrentGamma(memory, &gamma);
        if (split)
          {
            equation.prepare_split(gamma);
            equation.solve(x, b);
          }
        else if (linear) // one solution must be right
          {
            equation.set_gamma(gamma);
            equation.solve(x, b);
          }
        else
          equation.solve_newton(x, b);
      });
    };
    mass_system.solve = [this](double *x, const double *b) {
      return failure.guard([&] { equation.solve_mass(x, b); });
    };
    mass_system.product = [this](double *y, const double *x) {
      return failure.guard([&] { equation.mass_product(y, x); });
    };

    ARKStepSetLinearSolver(memory, system.solver, system.matrix);
    ARKStepSetLinSysFn(memory,
                       [](sunrealtype time,
                          N_Vector y,
                          N_Vector,
                          SUNMatrix,
                          SUNMatrix,
                          Compatibility::Boolean,
                          Compatibility::Boolean *current,
                          sunrealtype gamma,
                          void *self,
                          N_Vector,
                          N_Vector,
                          N_Vector) {
                         auto &integrator = *static_cast<ArkodeIntegrator *>(self);
                         *current         = 1;
                         if (integrator.split) // the solution looks after it
                           return 0;
                         return integrator.failure.guard([&] {
                           integrator.equation.linearize(integrator.time_of(time),
                                                         Sundials::data(y),
                                                         gamma);
                         });
                       });
    ARKStepSetLinearSolutionScaling(memory, 0);

    ARKStepSetMassLinearSolver(memory, mass_system.solver, mass_system.matrix, 0);
    ARKStepSetMassFn(memory, [](sunrealtype, SUNMatrix, void *, N_Vector, N_Vector, N_Vector) {
      return 0;
    });

    // The force at the end of a stage follows from the solution of its equation.
    ARKStepSetDeduceImplicitRhs(memory, 1);
    ARKStepSetPredictorMethod(memory, 0);
    set_linear(settings.method == Method::backward_euler || split || model.forces.are_linear());
  }


  void
  ArkodeIntegrator::set_linear(const bool is_linear)
  {
    linear = is_linear && !contact_stages;
    if (linear)
      {
        ARKStepSetLinear(memory, !split && model.forces.change_operator() ? 1 : 0);
        return;
      }
    ARKStepSetNonlinear(memory);
    if (!adaptive)
      {
        ARKStepSetMaxNonlinIters(memory, settings.newton_limit);
        ARKStepSetNonlinConvCoef(memory, 1.);
        ARKStepSetLSetupFrequency(memory, 1);
      }
  }


  void
  ArkodeIntegrator::evaluate(const double time, const double *const y, double *const f)
  {
    if (split)
      equation.evaluate_implicit(f, time, y);
    else
      equation.evaluate(f, time, y);
    if (settings.is_explicit())
      equation.solve_mass(f, f);
  }


  /** ARKode takes what fails here for the end of all: instead the error of the step becomes such
   * that it is rejected. */
  int
  ArkodeIntegrator::evaluate_rest(const double time, const N_Vector y, const N_Vector f)
  {
    const int status = failure.guard(
      [&] { equation.evaluate_explicit(Sundials::data(f), time_of(time), Sundials::data(y)); });
    if (status <= 0 || !adaptive)
      return status;
    std::fill_n(Sundials::data(f), equation.n_unknowns(), absurd);
    return 0;
  }


  void
  ArkodeIntegrator::renew_splitting()
  {
    double size = set_size;
    if (adaptive)
      ARKStepGetCurrentStep(memory, &size);
    equation.renew_splitting(diagonal * size, settings.renewal_angle, was_rejected);
    was_rejected = false;
  }


  void
  ArkodeIntegrator::check_growth(const double error) const
  {
    if (std::isfinite(error) && error < largest_error * model.body.mesh.diameter())
      return;
    std::ostringstream text;
    text << "the error of a single step is " << error << " m" << advice_on_growth();
    throw ComputationError(text.str());
  }


  std::string
  ArkodeIntegrator::advice_on_growth() const
  {
    std::ostringstream text;
    text << "; errors grow from step to step where steps are too long for "
         << settings.method_name() << ", as those of " << set_size
         << " s may be here. Shorten the step (Time/Step) or let it vary (Time/Variable steps = "
            "true)";
    return text.str();
  }


  void
  ArkodeIntegrator::throw_too_long()
  {
    try
      {
        throw_what_failed();
      }
    catch (const ComputationError &error)
      {
        throw ComputationError(error.what() + advice_on_growth());
      }
  }


  void
  ArkodeIntegrator::restart()
  {
    equation.get_unknowns(unknowns.data());
    reset(time, last_size, end);
    if (adaptive)
      begin_past(time, last_size);
    started = true;
  }


  void
  ArkodeIntegrator::reset(const double at, const double first_size, const double end_of_run)
  {
    ARKStepReset(memory, at, unknowns);
    ode_time = at;
    if (!adaptive)
      return;
    set_end(end_of_run); // which the line above has made it forget
    ARKStepSetInitStep(memory, first_size);
  }


  void
  ArkodeIntegrator::set_end(const double end_of_run)
  {
    ARKStepSetStopTime(memory, end_of_run);
    ARKStepSetMinStep(memory, shortest_step(end_of_run));
  }


  bool
  ArkodeIntegrator::repeat_past()
  {
    reset(past.start, past.first_size, past.end);
    if (!adaptive)
      set_step_size(past.first_size);
    for (unsigned int step = 0; step < past.n_steps; ++step)
      if (evolve_once(past.end) < 0)
        return false;
    return true;
  }


  /** ARKode adds step to step. A load that ends with a step must have ended in the solution as it
   * has in the work, and in whatever else is told of this step. */
  double
  ArkodeIntegrator::time_of(const double at) const
  {
    if (adaptive)
      return within_step(at);
    const double from_start = time + (at - ode_start);
    return std::abs(from_start - step_end) < grid_accuracy * settings.step ? step_end : from_start;
  }


  int
  ArkodeIntegrator::evolve_once(const double end_of_run)
  {
    if (adaptive) // what was set is forgotten when it is reached
      ARKStepSetStopTime(memory, next_stop(ode_time, end_of_run));
    // a time that one step does not reach: ARKode would interpolate
    return ARKStepEvolve(memory, 2. * end_of_run, unknowns, &ode_time, ARK_ONE_STEP);
  }


  bool
  ArkodeIntegrator::evolve()
  {
    context.message.clear();
    ode_start = ode_time;
    if (remembers && !adaptive) // of fixed steps one is as good as all, and nothing is decided
      past = {ode_start, set_size, end, 0};
    begin_error();
    if (split)
      renew_splitting();
    if (evolve_once(end) < 0)
      return false;
    failure.forget(); // what failed on the way was mended by a smaller step
    ++past.n_steps;
    return true;
  }


  void
  ArkodeIntegrator::count_rejections()
  {
    long inaccurate, failed;
    ARKStepGetNumErrTestFails(memory, &inaccurate);
    ARKStepGetNumStepSolveFails(memory, &failed);
    was_rejected                = inaccurate + failed != rejections;
    rejections                  = inaccurate + failed;
    model.effort.rejected_steps = inaccurate + failed;
    model.effort.failed_steps   = failed;
  }


  StepReport
  ArkodeIntegrator::take_step()
  {
    if (!started)
      restart();
    StepReport report;
    if (adaptive)
      {
        const bool succeeded = evolve();
        count_rejections();
        if (!succeeded)
          throw_what_failed();
        report.time = ode_time;
        ARKStepGetEstLocalErrors(memory, error);
        report.local_error = largest_displacement(error.data());
      }
    else
      report = take_fixed_step();
    equation.set_configuration(report.time, unknowns.data());

    long count = 0;
    if (!settings.is_explicit())
      ARKStepGetNumNonlinSolvIters(memory, &count);
    report.newton_iterations = linear ? 0 : count - newton_iterations;
    newton_iterations        = count;
    model.effort.newton_iterations += report.newton_iterations;
    return report;
  }


  double
  ArkodeIntegrator::next_step_size() const
  {
    if (time == grid_time(grid) && std::min(last_size, size_limit) > 0.999 * settings.step)
      return settings.step; // the very same number: nothing is factorized anew
    const double rest   = grid_time(grid + 1) - time;
    const double longer = std::min(2. * last_size, size_limit);
    return longer > 0.999 * rest ? rest : longer;
  }


  double
  ArkodeIntegrator::end_of_step(const double size) const
  {
    const double next = grid_time(grid + 1);
    return time + size > next - grid_accuracy * settings.step ? next : time + size;
  }


  void
  ArkodeIntegrator::set_rotations(const EquationOfMotion::Rotations rotations)
  {
    equation.set_rotations(rotations);
    set_linear(rotations == EquationOfMotion::Rotations::frozen || model.forces.are_linear());
  }


  /** First the same step with rotations that follow, then half of it. What rises in the smallest
   * step too is taken as if there were no guard: many small steps would raise it further. */
  bool
  ArkodeIntegrator::make_safer()
  {
    if (given_up)
      return false;
    const bool smaller = !equation.rotations_are_frozen() || newton_fails;
    given_up = smaller && last_size < settings.step * std::pow(0.5, settings.n_retries - 0.5);
    if (given_up)
      {
        if (settings.method != Method::backward_euler)
          return false;
        set_rotations(EquationOfMotion::Rotations::frozen);
        last_size  = settings.step;
        size_limit = settings.step;
      }
    else if (smaller)
      size_limit = 0.5 * last_size;
    else
      {
        set_rotations(EquationOfMotion::Rotations::following);
        size_limit = last_size;
      }
    if (time == grid_time(grid)) // it is where the step to be done again has landed
      --grid;
    started = false;
    return true;
  }


  /** Where many cells are inverted their forces jump, and Newton's method may find no solution in
   * steps of any size. */
  bool
  ArkodeIntegrator::make_simpler()
  {
    if (settings.method != Method::backward_euler || equation.rotations_are_frozen())
      return false;
    set_rotations(EquationOfMotion::Rotations::frozen);
    newton_fails = true;
    size_limit   = 0.5 * std::min(last_size, settings.step);
    started      = false;
    return true;
  }


  void
  ArkodeIntegrator::accept_step()
  {
    size_limit = std::numeric_limits<double>::max();
    if (settings.method == Method::backward_euler && !equation.rotations_are_frozen())
      set_rotations(EquationOfMotion::Rotations::frozen);
    if (time == grid_time(grid))
      newton_fails = given_up = false;
  }


  void
  ArkodeIntegrator::set_step_size(const double size)
  {
    if (size != set_size)
      ARKStepSetFixedStep(memory, size);
    set_size = size;
  }


  void
  ArkodeIntegrator::throw_at(const double size)
  {
    try
      {
        throw_what_failed();
      }
    catch (const ComputationError &error)
      {
        if (size == settings.step)
          throw;
        std::ostringstream text;
        text << error.what() << ", even in a step of " << size << " s";
        throw ComputationError(text.str());
      }
  }


  StepReport
  ArkodeIntegrator::take_fixed_step()
  {
    double size = next_step_size();
    set_step_size(size);
    step_end              = end_of_step(size);
    const double smallest = settings.step * std::pow(0.5, settings.n_retries + 0.5);
    while (!evolve())
      {
        if (split)
          throw_too_long();
        if (0.5 * size < smallest)
          throw_at(size);
        failure.forget();
        ++model.effort.rejected_steps;
        ++model.effort.failed_steps;
        model.configuration.reject(model.effort);
        restart();
        set_step_size(size *= 0.5);
        step_end = end_of_step(size);
      }
    last_size = size;

    StepReport report;
    report.local_error = embedded_error();
    if (split)
      check_growth(report.local_error);
    report.time = step_end;
    if (report.time == grid_time(grid + 1))
      ++grid;
    return report;
  }
} // namespace Supple
