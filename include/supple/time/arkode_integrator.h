#ifndef supple_arkode_integrator_h
#define supple_arkode_integrator_h

#include <supple/time/contact_stages.h>
#include <supple/time/dynamic_integrator.h>

#include <arkode/arkode_butcher.h>

#include <limits>
#include <vector>

namespace Supple
{
  /**
   * Runge-Kutta methods by SUNDIALS's ARKode: backward Euler, diagonally implicit and explicit
   * ones, with fixed or variable steps.
   *
   * Backward Euler with the rotations frozen at the start of each step is one linear system,
   *
   *   (M + dt D + dt^2 K') v1 = M v0 + dt (f1 - K' (X + u0) + f0),   u1 = u0 + dt v1;
   *
   * all other implicit methods let them follow and find each stage by Newton's method. A fixed step
   * that fails is tried again in halves, until the next multiple of the step is reached.
   *
   * Semi-implicit methods split the force, see EquationOfMotion::split(), and have two tables: one
   * for the part that is linear in the unknowns, whose matrix serves all stages of many steps, and
   * one for the rest, which is only evaluated. Of linear scenes there is no rest.
   */
  class ArkodeIntegrator : public DynamicIntegrator
  {
  public:
    explicit ArkodeIntegrator(const Model &model);

    ~ArkodeIntegrator() override;

    std::string
    name() const override;

    nlohmann::json
    save() override;

    void
    load(const nlohmann::json &saved) override;

    void
    begin_at(const double start) override
    {
      time = grid_start = start;
    }

    std::optional<StableStep>
    stable_step() const override
    {
      return stable;
    }

  private:
    StepReport
    take_step() override;

    bool
    make_safer() override;

    bool
    make_simpler() override;

    void
    accept_step() override;

    /** Stages are one linear system each, or Newton's method. */
    void
    set_linear(bool linear);

    /** Of backward Euler alone. */
    void
    set_rotations(EquationOfMotion::Rotations rotations);

    void
    create_memory();

    /** @throws InputError if a fixed step of an explicit method is too long */
    void
    set_table();

    /** Has fixed steps estimate their error by the embedded formula, if the method has one. */
    void
    set_embedded_formula(const ARKodeButcherTableMem &table);

    /** Of the step that begins. */
    void
    begin_error();

    /** Adds the next stage to the error. @param y the unknowns there */
    void
    add_stage(const double *y);

    /** Of a fixed step [m]; not a number without an embedded formula. */
    double
    embedded_error();

    void
    check_stability() const;

    /** Of variable steps [s]; 0 if any. */
    double
    longest_step() const;

    void
    set_linear_systems();

    /** ARKode's right hand side: the net force, over the mass where there is no mass matrix; of
     * semi-implicit methods the part that is linear. */
    void
    evaluate(double time, const double *y, double *f);

    /** The rest of it. */
    int
    evaluate_rest(double time, N_Vector y, N_Vector f);

    /** Of semi-implicit methods, at the start of a step. */
    void
    renew_splitting();

    /** @throws ComputationError if this step of a semi-implicit method, with this error [m], was
     * too long: errors grow from step to step */
    void
    check_growth(double error) const;

    /** What to do about it. */
    std::string
    advice_on_growth() const;

    /** Says what failed in a fixed step of a semi-implicit method: smaller steps from here on would
     * not mend what has grown before. */
    [[noreturn]] void
    throw_too_long();

    /** Takes the unknowns from the configuration and forgets the past. */
    void
    restart();

    /** The time [s] at so many steps of full size from the start. */
    double
    grid_time(const unsigned int n_steps) const
    {
      return grid_start + n_steps * settings.step;
    }

    /** Sets ARKode to a state without a past, with a first step. @param end_of_run [s] */
    void
    reset(double at, double first_size, double end_of_run);

    bool
    repeat_past() override;

    /** Where variable steps end. */
    void
    set_end(double end_of_run);

    /** One step of ARKode, up to the next stop if it is variable. @return negative if it failed */
    int
    evolve_once(double end_of_run);

    /** The same with all that belongs to it. @return whether it succeeded */
    bool
    evolve();

    /** Of variable steps, so far. */
    void
    count_rejections();

    /** The largest step that does not pass the next multiple of the step, nor is much larger than
     * the last one. */
    double
    next_step_size() const;

    void
    set_step_size(double size);

    /** Says what failed, and how small the step was. */
    [[noreturn]] void
    throw_at(double size);

    /** The time [s] after a fixed step of this size: the next multiple of the step if that is
     * reached. */
    double
    end_of_step(double size) const;

    /** What ARKode's time is to us: without the round-off of its sum of steps, so that loads and
     * motions at the end of a step are those of the time that is reported. */
    double
    time_of(double at) const;

    StepReport
    take_fixed_step();

    const bool split;                  ///< the method is semi-implicit, and there is a rest
    double diagonal   = 0.;            ///< gamma over the step, of a semi-implicit method
    bool was_rejected = false;         ///< the last step, or a try of it
    long rejections   = 0;             ///< that ARKode has counted
    const bool remembers;              ///< more than the configuration from step to step
    bool linear = false;               ///< each stage is one linear system
    std::vector<double> error_weights; ///< of the stages of a fixed step, see add_stage()
    bool first_stage_is_start = false; ///< of a step
    unsigned int stage        = 0;     ///< the next one
    Sundials::LinearSystem mass_system;
    Sundials::StateVector error;
    void *memory           = nullptr;
    bool started           = false;
    double ode_time        = 0.; ///< ARKode's time [s]
    double ode_start       = 0.; ///< the same at the start of the step [s]
    double step_end        = 0.; ///< the end of the fixed step, as reported [s]
    double set_size        = 0.; ///< the fixed step ARKode knows of [s]
    double last_size       = 0.; ///< of the last fixed step that succeeded [s]
    double size_limit      = std::numeric_limits<double>::max(); ///< of the next step [s]
    double grid_start      = 0.;                                 ///< of fixed steps [s]
    unsigned int grid      = 0;     ///< steps of full size that are reached since then
    bool newton_fails      = false; ///< up to the next of them
    bool given_up          = false; ///< up to the next of them: the energy rises
    long newton_iterations = 0;
    std::optional<StableStep> stable;              ///< of an explicit method
    std::unique_ptr<ContactStages> contact_stages; ///< in a scene with tools
  };
} // namespace Supple

#endif
