#include <supple/run/step_doubling.h>


#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Supple
{
  namespace
  {
    /** From this part of the motion on a second run alone is not believed. */
    constexpr double large = 0.1;

    /** An observed order below this part of that of the method says that the steps are too long for
     * any. */
    constexpr double believable = 0.7;

    /** With variable steps the tolerance is that of a step, whose length goes with its (p+1)-st
     * root, and the error with its p-th power. */
    double
    gain_of(const TimeParameters &time)
    {
      const double p = time.order();
      return time.has_variable_steps() ? std::pow(10., p / (p + 1.)) : std::pow(2., p);
    }
  } // namespace


  Parameters
  StepDoubling::second_scene(const Parameters &scene)
  {
    Parameters second = Companion::scene(scene);
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


  StepDoubling::StepDoubling(const TimeParameters &time,
                             const Companion::Run &second_run,
                             const Companion::Run &third_run,
                             const double &motion)
    : order(time.order())
    , variable_steps(time.has_variable_steps())
    , gain(gain_of(time))
    , second_run(second_run)
    , third_run(third_run)
    , motion(motion)
  {
  }


  std::string
  StepDoubling::steps_in_words() const
  {
    if (variable_steps)
      return of_three ? "a tenth and a hundredth of the tolerances" : "a tenth of the tolerances";
    return of_three ? "half and a quarter of the step" : "half the step";
  }


  bool
  StepDoubling::after_step(const Observation &now)
  {
    error_now = follow(now.measurement.time, now.state.displacement);
    if (now.last && failure().empty() && largest > large * motion)
      {
        if (from_before)
          third_run.failure = "the error was largest before the run went on from a checkpoint";
        else
          add_third_run();
      }
    return true;
  }


  nlohmann::json
  StepDoubling::save() const
  {
    return largest;
  }


  void
  StepDoubling::load(const nlohmann::json &saved)
  {
    largest     = saved;
    from_before = true;
  }


  void
  StepDoubling::end(const Observation & /* now */)
  {
    second_run.require_meeting();
  }


  std::optional<double>
  StepDoubling::follow(const double time, const Vector &displacement)
  {
    const std::optional<Companion::Arrival> second = second_run.move_to(time);
    if (!second)
      return {};
    last = gain / (gain - 1.) * largest_vertex_distance(displacement, second->displacement);
    if (!std::isfinite(last))
      {
        second_run.failure = "its motion is too large to be compared";
        return {};
      }
    if (last >= largest)
      {
        from_before       = false;
        largest           = last;
        time_of_largest   = time;
        first_at_largest  = displacement;
        second_at_largest = second->displacement;
      }
    return last;
  }


  void
  StepDoubling::add_third_run()
  {
    if (const std::optional<Companion::Arrival> third = third_run.move_to(time_of_largest))
      of_three = observe(largest_vertex_distance(first_at_largest, second_at_largest),
                         largest_vertex_distance(second_at_largest, third->displacement),
                         largest_vertex_distance(first_at_largest, third->displacement));
    else if (third_run.failure.empty())
      third_run.failure = "it has no time in common with the others";
  }


  StepDoubling::Observed
  StepDoubling::observe(const double first_to_second,
                        const double second_to_third,
                        const double first_to_third) const
  {
    Observed result;
    result.gain     = first_to_second / second_to_third;
    result.at_least = !(std::log(result.gain) >= believable * std::log(gain));
    if (!variable_steps && std::isfinite(result.gain) && result.gain > 0.)
      result.order = std::log2(result.gain);
    const double trusted = std::min(result.gain, gain); // a faster fall is luck
    result.error         = result.at_least
                             ? std::max(first_to_third, first_to_second) + second_to_third / (gain - 1.)
                             : trusted / (trusted - 1.) * first_to_second;
    return result;
  }
} // namespace Supple
