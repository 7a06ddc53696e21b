#include <supple/run/companion.h>

#include <supple/base/error.h>
#include <supple/base/stopwatch.h>

#include <cmath>

namespace Supple
{
  Parameters
  Companion::scene(const Parameters &scene)
  {
    Parameters companion          = scene;
    companion.time.estimate_error = false;
    companion.space.estimate      = SpaceParameters::Estimate::never;
    companion.space.second_mesh   = SpaceParameters::SecondMesh::none;
    companion.output.history      = false;
    companion.output.frames       = OutputParameters::Frames::none;
    return companion;
  }


  std::optional<Companion::Arrival>
  Companion::move_to(const double time)
  {
    if (!failure.empty())
      return {};
    const Stopwatch stopwatch;
    std::optional<Arrival> arrival;
    try
      {
        arrival.emplace(run(time));
      }
    catch (const ComputationError &error)
      {
        failure = error.what();
      }
    seconds += stopwatch.seconds();
    if (!arrival || std::abs(arrival->time - time) > 1e-9 * time)
      return {};
    met = true;
    return arrival;
  }


  void
  Companion::require_meeting()
  {
    if (!met && failure.empty())
      failure = "up to the end the two runs have no time in common";
  }
} // namespace Supple
