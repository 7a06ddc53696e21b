#ifndef supple_summary_h
#define supple_summary_h

#include <supple/observe/diagnostics.h>
#include <supple/run/step_doubling.h>

#include <string>
#include <vector>

namespace Supple
{
  /** What summary.json tells of a run. */
  struct Summary
  {
    std::string status; ///< done, interrupted or failed: why
    std::vector<std::string> warnings;
    std::string integrator;
    std::optional<StableStep> stable_step; ///< of an explicit method
    unsigned int steps                = 0;
    double setup_seconds              = 0.;
    double run_seconds                = 0.;
    double error_estimate             = 0.;      ///< [m]
    double largest_motion             = 0.;      ///< of a vertex from its place at the start [m]
    const StepDoubling *step_doubling = nullptr; ///< if there is a second run
    unsigned int frames               = 0;
    bool history                      = false;
    bool probes                       = false;
    bool observed                     = false; ///< whether energies were measured
    Measurement last;
    Extremes extremes;
    double distance_from_rest = 0.; ///< of the vertex that is farthest from its place at rest [m]
    double distance_from_shape =
      0.; ///< the same, from the body at rest that is shifted and turned [m]

    std::string
    to_json(const Parameters &parameters, const Model &model) const;
  };
} // namespace Supple

#endif
