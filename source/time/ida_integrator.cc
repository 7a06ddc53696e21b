#include <supple/time/ida_integrator.h>

#include <supple/base/error.h>

#include <idas/idas.h>
#include <nlohmann/json.hpp>

namespace Supple
{
  namespace
  {
    /** Steps that one operator serves at most, as in ARKode. */
    constexpr long longest_use = 20;
  } // namespace


  IdaIntegrator::IdaIntegrator(const Model &model)
    : DynamicIntegrator(model,
                        EquationOfMotion::Rotations::following,
                        EquationOfMotion::HeldVelocity::derivative)
    , rates(equation.n_unknowns(), model.body.mesh.communicator, context)
    , error(equation.n_unknowns(), model.body.mesh.communicator, context)
    , work_space(equation.n_unknowns())
  {
    create_memory();
    set_linear_system();
  }


  IdaIntegrator::~IdaIntegrator()
  {
    IDAFree(&memory);
  }


  std::string
  IdaIntegrator::name() const
  {
    return "backward differentiation up to order " + std::to_string(settings.maximum_order) +
           " (IDA, variable steps)";
  }


  nlohmann::json
  IdaIntegrator::save()
  {
    nlohmann::json saved = {{"time", time}, {"equation", equation.save(true)}};
    if (started)
      {
        saved["memory"]        = save_memory();
        saved["linearized_at"] = linearized_at;
      }
    return saved;
  }


  void
  IdaIntegrator::load(const nlohmann::json &saved)
  {
    time = saved.at("time");
    equation.load(saved.at("equation"));
    if (!saved.contains("memory"))
      return;
    load_memory(saved.at("memory"));
    set_end(end);
    linearized_at = saved.at("linearized_at");
    IDAGetNumNonlinSolvIters(memory, &newton_iterations);
    started = true;
  }


  void
  IdaIntegrator::create_memory()
  {
    memory = IDACreate(context);
    Compatibility::collect_ida_errors(memory, context.message);
    IDAInit(
      memory,
      [](sunrealtype time, N_Vector y, N_Vector rate, N_Vector F, void *self) {
        auto &integrator = *static_cast<IdaIntegrator *>(self);
        return integrator.failure.guard([&] {
          integrator.residual(time, Sundials::data(y), Sundials::data(rate), Sundials::data(F));
        });
      },
      0.,
      unknowns,
      rates);
    IDASetUserData(memory, this);
    IDASVtolerances(memory, set_tolerances(), absolute_tolerances);
    IDASetMaxOrd(memory, settings.maximum_order);
    IDASetMaxNumSteps(memory, -1);
    if (settings.longest_step > 0.)
      IDASetMaxStep(memory, settings.longest_step);
  }


  void
  IdaIntegrator::set_linear_system()
  {
    // With c = 1/gamma:  c x_u - x_q = b_u,  K' x_u + (c M + D) x_q = b_q.
    system.solve = [this](double *x, const double *b) {
      return failure.guard([&] {
        keep_up_to_date();
        for (unsigned int i = 0; i < equation.n_unknowns(); ++i)
          work_space[i] = equation.current_gamma() * b[i];
        equation.solve_newton(x, work_space.data());
      });
    };
    IDASetLinearSolver(memory, system.solver, system.matrix);
    IDASetJacFn(memory,
                [](sunrealtype time,
                   sunrealtype c,
                   N_Vector y,
                   N_Vector,
                   N_Vector,
                   SUNMatrix,
                   void *self,
                   N_Vector,
                   N_Vector,
                   N_Vector) {
                  auto &integrator = *static_cast<IdaIntegrator *>(self);
                  IDAGetNumSteps(integrator.memory, &integrator.linearized_at);
                  return integrator.failure.guard(
                    [&] { integrator.equation.linearize(time, Sundials::data(y), 1. / c); });
                });
  }


  /**
   * IDA has the operator assembled anew when the step changes or Newton's method fails, and judges
   * by what it converged like then. Over many steps of one length a body turns so far that one
   * correction leaves more of an error than the prediction of the next step can bear: it grows from
   * step to step.
   */
  void
  IdaIntegrator::keep_up_to_date()
  {
    long n_steps = 0;
    IDAGetNumSteps(memory, &n_steps);
    if (!model.forces.change_operator() || n_steps < linearized_at + longest_use)
      return;
    equation.relinearize();
    linearized_at = n_steps;
  }


  void
  IdaIntegrator::residual(const double time,
                          const double *const y,
                          const double *const rate,
                          double *const F)
  {
    equation.evaluate(work_space.data(), within_step(time), y);
    equation.mass_product(F, rate);
    for (unsigned int i = 0; i < equation.n_unknowns(); ++i)
      F[i] -= work_space[i];
  }


  void
  IdaIntegrator::start()
  {
    equation.get_unknowns(unknowns.data());
    equation.evaluate(work_space.data(), within_step(time), unknowns.data());
    equation.solve_mass(rates.data(), work_space.data());
    begin_at(time, settings.step, end);
    begin_past(time, settings.step);
    started = true;
  }


  void
  IdaIntegrator::begin_at(const double at, const double first_size, const double end_of_run)
  {
    IDAReInit(memory, at, unknowns, rates);
    set_end(end_of_run);
    IDASetInitStep(memory, first_size);
  }


  void
  IdaIntegrator::set_end(const double end_of_run)
  {
    IDASetStopTime(memory, end_of_run);
    IDASetMinStep(memory, shortest_step(end_of_run));
  }


  bool
  IdaIntegrator::repeat_past()
  {
    double at = past.start;
    begin_at(past.start, past.first_size, past.end);
    for (unsigned int step = 0; step < past.n_steps; ++step)
      {
        IDASetStopTime(memory, next_stop(at, past.end));
        if (IDASolve(memory, past.end, &at, unknowns, rates, IDA_ONE_STEP) < 0)
          return false;
      }
    return true;
  }


  void
  IdaIntegrator::count_rejections()
  {
    long inaccurate, failed;
    IDAGetNumErrTestFails(memory, &inaccurate);
    IDAGetNumStepSolveFails(memory, &failed);
    model.effort.rejected_steps = inaccurate + failed;
    model.effort.failed_steps   = failed;
  }


  StepReport
  IdaIntegrator::take_step()
  {
    // a formula over steps of the past must not reach over a jump
    if (!started || settings.is_instant(time))
      start();
    context.message.clear();
    StepReport report;
    IDASetStopTime(memory, next_stop(time, end));
    const int status = IDASolve(memory, end, &report.time, unknowns, rates, IDA_ONE_STEP);
    count_rejections();
    if (status < 0)
      throw_what_failed();
    ++past.n_steps;
    failure.forget(); // what failed on the way was mended by a smaller step
    equation.set_configuration(report.time, unknowns.data());

    IDAGetEstLocalErrors(memory, error);
    report.local_error = largest_displacement(error.data());
    long count         = 0;
    IDAGetNumNonlinSolvIters(memory, &count);
    report.newton_iterations = count - newton_iterations;
    newton_iterations        = count;
    model.effort.newton_iterations += report.newton_iterations;
    return report;
  }
} // namespace Supple
