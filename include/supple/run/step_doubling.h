#ifndef supple_step_doubling_h
#define supple_step_doubling_h

#include <supple/run/listener.h>
#include <supple/scene/parameters.h>

#include <functional>
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
   */
  class StepDoubling : public Listener
  {
  public:
    /** Where the second run is. */
    struct Arrival
    {
      double time;                ///< [s], or load factor
      const Vector &displacement; ///< [m]
    };

    /** Moves the second run up to a time or just past it. */
    using SecondRun = std::function<Arrival(double time)>;

    /** What the second run is to be made of. @param scene of the run whose error is asked for */
    static Parameters
    second_scene(const Parameters &scene);

    /** @param time of the run whose error is asked for
     *  @param second_run of second_scene(); it may throw a ComputationError */
    StepDoubling(const TimeParameters &time, const SecondRun &second_run);

    void
    begin(const Observation &now, bool resumed) override;

    /** Moves the second run up to the time of this state. */
    bool
    after_step(const Observation &now) override;

    /** Where the two runs were at the same time nowhere, no error is known. */
    void
    end(const Observation &now) override;

    /** The error of the displacement after the last step, largest over all vertices [m]; nothing
     * where the two runs are not at the same time. */
    const std::optional<double> &
    error() const
    {
      return error_now;
    }

    double largest = 0.;    ///< error so far [m]
    double last    = 0.;    ///< error where it was found last [m]
    double seconds = 0.;    ///< that the second run took
    std::string failure;    ///< why no error is known; empty while there is a second run
    const std::string name; ///< "half the step" or "a tenth of the tolerances"

  private:
    std::optional<double>
    follow(double time, const Vector &displacement);

    const double factor;
    const SecondRun second_run;
    std::optional<double> error_now;
    bool compared = false; ///< whether the two runs have been at the same time
  };
} // namespace Supple

#endif
