#ifndef supple_step_doubling_h
#define supple_step_doubling_h

#include <supple/run/companion.h>
#include <supple/run/listener.h>

#include <optional>
#include <string>

namespace Supple
{
  /**
   * The error of a run by step doubling: a second run of the same scene, with half the step, moves
   * along. Where the error falls with the power p of the step,
   *
   *   u - exact = 2^p/(2^p - 1) (u - u_second).
   *
   * With variable steps the second run has a tenth of the tolerances, the factor is 10/9, and the
   * two are compared where they are at the same time, which is at the end.
   *
   * Where that is more than a tenth of the motion, steps are too long for p to be believed. Then a
   * third run, halved or tightened once more, follows at the end: g = |u - u_second| / |u_second -
   * u_third| takes the place of 2^p (Roache 1998). If the error falls too slowly for that, only a
   * lower bound is known: what the third run has gained, and what that still lacks by the order p.
   */
  class StepDoubling : public Listener
  {
  public:
    /** What three runs tell. */
    struct Observed
    {
      double error;                ///< of the first run, at the instant it was largest [m]
      double gain;                 ///< g
      std::optional<double> order; ///< log2 g with fixed steps, if there is one
      bool at_least;               ///< the error may be larger
    };

    /** What the second run is to be made of. @param scene of the run whose error is asked for */
    static Parameters
    second_scene(const Parameters &scene);

    /** @param time of the run whose error is asked for
     *  @param second_run of second_scene()
     *  @param third_run  of second_scene() of that; begun where it is needed alone
     *  @param motion     largest of a vertex so far [m]; it changes, and must outlive this */
    StepDoubling(const TimeParameters &time,
                 const Companion::Run &second_run,
                 const Companion::Run &third_run,
                 const double &motion);

    /** Moves the second run up to the time of this state. */
    bool
    after_step(const Observation &now) override;

    void
    end(const Observation &now) override;

    std::string
    name() const override
    {
      return "second run";
    }

    nlohmann::json
    save() const override;

    void
    load(const nlohmann::json &saved) override;

    /** The error of the displacement after the last step, largest over all vertices [m]; nothing
     * where the two runs are not at the same time. */
    const std::optional<double> &
    error() const
    {
      return error_now;
    }

    /** Three runs, if there was a third. */
    const std::optional<Observed> &
    observed() const
    {
      return of_three;
    }

    /** The best that is known [m]. */
    double
    best() const
    {
      return of_three ? of_three->error : largest;
    }

    /** "half the step", "half and a quarter of the step" */
    std::string
    steps_in_words() const;

    /** Why no error is known; empty while there is a second run. */
    const std::string &
    failure() const
    {
      return second_run.failure;
    }

    /** That the other runs took. */
    double
    seconds() const
    {
      return second_run.seconds + third_run.seconds;
    }

    /** Why there is no third run, where there should be one. */
    const std::string &
    third_failure() const
    {
      return third_run.failure;
    }

    double largest = 0.;      ///< error so far, of the order p [m]
    double last    = 0.;      ///< error where it was found last [m]
    const unsigned int order; ///< p

  private:
    std::optional<double>
    follow(double time, const Vector &displacement);

    /** Runs the third one up to the instant of the largest error. */
    void
    add_third_run();

    Observed
    observe(double first_to_second, double second_to_third, double first_to_third) const;

    const bool variable_steps;
    const double gain; ///< how much the error falls from run to run
    Companion second_run, third_run;
    std::optional<double> error_now;
    const double &motion; ///< largest of a vertex so far [m]
    double time_of_largest = 0.;
    bool from_before       = false; ///< it was largest before the run went on from a checkpoint
    Vector first_at_largest, second_at_largest; ///< displacements when the error was largest [m]
    std::optional<Observed> of_three;
  };
} // namespace Supple

#endif
