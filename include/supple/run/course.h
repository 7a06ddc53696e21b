#ifndef supple_course_h
#define supple_course_h

#include <supple/observe/measurement.h>

#include <nlohmann/json_fwd.hpp>

#include <chrono>
#include <string>

namespace Supple
{
  /** How far a run has come. */
  struct Course
  {
    Measurement now; ///< of the present state; step and time alone if nobody asks for energies
    double error_estimate = 0.; ///< sum of the local errors [m]
    double largest_motion = 0.; ///< of a vertex from its place at the start, so far [m]

    /** The checkpoint from which the run goes on, such as "step 20 of checkpoint.cbor"; empty if
     * there is none. */
    std::string origin;
    bool origin_is_second_choice = false; ///< checkpoint.cbor is damaged
    unsigned int steps_before    = 0;     ///< of the runs that this one goes on from
    double seconds_before        = 0.;    ///< of the runs that this one goes on from

    const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    double setup_seconds                              = 0.;

    bool
    resumed() const
    {
      return !origin.empty();
    }

    double
    seconds_since_start() const;

    /** Of the run without its set-up, and of the runs that it goes on from. */
    double
    seconds() const;

    nlohmann::json
    save() const;

    void
    load(const nlohmann::json &saved);
  };
} // namespace Supple

#endif
