#ifndef supple_step_report_h
#define supple_step_report_h

#include <supple/linear_algebra/vector.h>

#include <optional>
#include <vector>

namespace Supple
{
  /** What a step has to tell. */
  struct StepReport
  {
    double time                    = 0.; ///< at the end of the step [s]; the load factor if static
    double dt                      = 0.; ///< [s]
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;
    double load_work               = 0.; ///< as in Measurement::work, of this step [J]

    std::vector<double> tool_works; ///< of each rigid tool, part of load_work [J]
    double rubbed = 0.;             ///< what friction on tools turned into heat [J]

    /** Estimate, largest over all vertices [m]; where a method has none, not a number. */
    double local_error = 0.;

    /**
     * Energy the step took out of the motion or put into the springs [J]: what the elastic energy
     * did not get of it is dissipated. Where a method does not know it, what is missing in the
     * balance of energies is taken for dissipated.
     */
    std::optional<double> expended;

    /** M v at the end of an observed step [kg m/s], on all rows; lives until the next step. Null in
     * static scenes. */
    const Vector *momentum = nullptr;
  };


  /** The part of the largest energy by which the total energy may rise in a step: it covers
   * round-off and inexact solutions. */
  constexpr double energy_accuracy = 1e-9;
} // namespace Supple

#endif
