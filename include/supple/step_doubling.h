#ifndef supple_step_doubling_h
#define supple_step_doubling_h

#include <supple/parameters.h>
#include <supple/vector.h>

#include <memory>
#include <optional>
#include <string>

namespace Supple
{
  class Simulation;

  /**
   * The error of a run by step doubling: a second run of the same scene, with half the step, moves
   * along. Where the error falls with the power p of the step,
   *
   *   u - exact = 2^p/(2^p - 1) (u - u_second).
   *
   * With variable steps the second run has a tenth of the tolerances, the factor is 10/9, and the
   * two are compared where they are at the same time, which is at the end.
   */
  class StepDoubling
  {
  public:
    /** @param scene of the run whose error is asked for */
    StepDoubling(const Parameters &scene, MPI_Comm communicator);

    ~StepDoubling();

    /**
     * Moves the second run up to this time.
     * @return the error of the displacement, largest over all vertices [m]; nothing where the two
     * runs are not at the same time
     */
    std::optional<double>
    follow(double time, const State &state);

    double largest = 0.;    ///< error so far [m]
    double last    = 0.;    ///< error where it was found last [m]
    double seconds = 0.;    ///< that the second run took
    std::string failure;    ///< why there is no second run any more; empty while there is
    const std::string name; ///< "half the step" or "a tenth of the tolerances"

  private:
    const double factor;
    std::unique_ptr<Simulation> second;
  };
} // namespace Supple

#endif
