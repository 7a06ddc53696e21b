#ifndef supple_dynamic_integrator_h
#define supple_dynamic_integrator_h

#include <supple/time/energy_guard.h>
#include <supple/time/equation_of_motion.h>
#include <supple/time/sundials.h>

#include <algorithm>

namespace Supple
{
  /** What all integrators of the equation of motion share: SUNDIALS's surroundings, and a look at
   * each step when it is done. */
  class DynamicIntegrator : public TimeIntegrator
  {
  public:
    StepReport
    advance(bool observed) final;

    void
    keep_past() final;

  protected:
    DynamicIntegrator(const Model &model,
                      EquationOfMotion::Rotations rotations,
                      EquationOfMotion::HeldVelocity held_velocity);

    /**
     * Takes one step from the unknowns, which are those of the configuration, and sets that to its
     * end.
     * @throws ComputationError
     */
    virtual StepReport
    take_step() = 0;

    /** Prepares to do the last step again in a way that is less likely to raise the energy.
     * @return false if it stands as it is */
    virtual bool
    make_safer() = 0;

    /** The safer way has failed. Prepares for another one, that needs no iteration.
     * @return false if there is none */
    virtual bool
    make_simpler()
    {
      return false;
    }

    /** The last step stands, and the next one is as usual again. */
    virtual void
    accept_step()
    {
    }

    /** Sets the absolute tolerance of each unknown. @return the relative tolerance */
    double
    set_tolerances();

    /** Has variable steps with conjugate gradients solve their linear systems as well as the error
     * that is asked for needs, unless the scene says how well.
     * @param corrected whether Newton's method mends what is left */
    void
    tie_linear_tolerance(bool corrected);

    /** Of variable steps [s]: those that end up here would go on for ever.
     * @param end_of_run [s] */
    static double
    shortest_step(double end_of_run);

    /** The time at which the loads and motions of the step that begins at `time` count: where they
     * jump at an end of the step, within it. */
    double
    within_step(double at) const;

    /** Where the variable step that begins at a time ends at the latest [s]. */
    double
    next_stop(const double from, const double end_of_run) const
    {
      const double asked = stop > from ? stop : end_of_run;
      return std::min({settings.next_stop(from), end_of_run, asked});
    }

    /** From where on SUNDIALS's decisions are kept. */
    struct Past
    {
      double start         = 0.; ///< as SUNDIALS counts [s]
      double first_size    = 0.; ///< of the first step [s]
      double end           = 0.; ///< of the run [s]
      unsigned int n_steps = 0;  ///< since then
    };

    /** Keeps SUNDIALS's decisions from here on. */
    void
    begin_past(double start, double first_size);

    /** What SUNDIALS's integrator remembers: its past in decisions, the contents of its vectors.
     * Collective, counts on the first process. */
    nlohmann::json
    save_memory() const;

    /** The same taken back. Collective.
     * @throws nlohmann::json::exception, std::out_of_range if @p saved is something else */
    void
    load_memory(const nlohmann::json &saved);

    /** Has SUNDIALS take the steps of the past from its start again. @return whether it did */
    virtual bool
    repeat_past() = 0;

    /** Throws what a callback threw, or else what SUNDIALS says. */
    [[noreturn]] void
    throw_what_failed();

    /** The largest length, over all vertices, of the displacements in a vector of unknowns. */
    double
    largest_displacement(const double *unknowns) const;

    const TimeParameters &settings;
    EquationOfMotion equation;
    const bool backward_euler; ///< its energy balance is exact
    const bool adaptive;       ///< steps
    Sundials::Context context;
    Sundials::LinearSystem system;
    Sundials::StateVector unknowns, absolute_tolerances;
    Sundials::Failure failure;
    Past past;

  private:
    /** The rate at which a pressure wave runs through the body [1/s]. */
    double
    wave_rate() const;

    /** The vectors that SUNDIALS goes on with. */
    std::vector<N_Vector>
    remembered() const;

    /** Reactions, work and what was expended.
     * @param last time of the step at which forces count */
    void
    observe(StepReport &report, double last);

    /** To be called before a step that is observed. */
    void
    set_momentum_at_start();

    /** Sets imbalance and applied. */
    void
    set_forces(double at_time);

    /** One step and what is to be known of it. @throws ComputationError with the configuration as
     * it was */
    StepReport
    step_once(bool observed);

    /** The step from @p start once more, in the way that was prepared. */
    StepReport
    step_again(double start);

    EnergyGuard guard;
    const bool guarded;
    bool started      = false;
    bool keeps_past   = false;
    bool has_momentum = false; ///< of the configuration: the last step was observed
    Vector momentum;           ///< M v of the configuration [kg m/s]
    Vector momentum_at_start;  ///< of the step
    Vector du, dv, dp;         ///< over the last observed step: displacement, velocity, momentum
    Vector imbalance;          ///< f_int + D v - f, at the end of the last observed step [N]
    Vector load;               ///< those of f that are loads [N]
    Vector applied;            ///< of f, what is counted as work [N]
  };
} // namespace Supple

#endif
