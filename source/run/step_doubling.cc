#include <supple/run/step_doubling.h>

#include <supple/base/error.h>

#include <chrono>
#include <cmath>

namespace Supple
{
  namespace
  {
    /** The error over the distance from the second run. With variable steps the tolerance is that
     * of a step, whose length goes with its (p+1)-st root, and the error with its p-th power. */
    double
    factor_of(const TimeParameters &time)
    {
      const double p    = time.order();
      const double gain = time.has_variable_steps() ? std::pow(10., p / (p + 1.)) : std::pow(2., p);
      return gain / (gain - 1.);
    }
  } // namespace


  Parameters
  StepDoubling::second_scene(const Parameters &scene)
  {
    Parameters second          = scene;
    second.time.estimate_error = false;
    second.output.history      = false;
    second.output.frames       = OutputParameters::Frames::none;
    if (scene.time.has_variable_steps())
      for (double *tolerance : {&second.time.relative_tolerance,
                                &second.time.displacement_tolerance,
                                &second.time.velocity_tolerance})
        *tolerance *= 0.1;
    else
      {
        second.time.step *= 0.5;
        second.time.n_steps *= 2;
      }
    return second;
  }


  StepDoubling::StepDoubling(const TimeParameters &time, const SecondRun &second_run)
    : name(time.has_variable_steps() ? "a tenth of the tolerances" : "half the step")
    , factor(factor_of(time))
    , second_run(second_run)
  {
  }


  void
  StepDoubling::begin(const Observation & /* now */, const bool /* resumed */)
  {
  }


  bool
  StepDoubling::after_step(const Observation &now)
  {
    error_now = follow(now.measurement.time, now.state.displacement);
    return true;
  }


  void
  StepDoubling::end(const Observation & /* now */)
  {
    if (!compared && failure.empty())
      failure = "up to the end the two runs have no time in common";
  }


  std::optional<double>
  StepDoubling::follow(const double time, const Vector &displacement)
  {
    if (!failure.empty())
      return {};
    const auto start = std::chrono::steady_clock::now();
    std::optional<Arrival> second;
    try
      {
        second.emplace(second_run(time));
      }
    catch (const ComputationError &error)
      {
        failure = error.what();
      }
    seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!second || std::abs(second->time - time) > 1e-9 * time)
      return {};

    last = factor * largest_vertex_distance(displacement, second->displacement);
    if (!std::isfinite(last))
      {
        failure = "its motion is too large to be compared";
        return {};
      }
    compared = true;
    largest  = std::max(largest, last);
    return last;
  }
} // namespace Supple
