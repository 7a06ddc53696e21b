#include <supple/run/skipped_pulses.h>

#include <supple/base/text.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Supple
{
  using namespace dealii;

  SkippedPulses::SkippedPulses(const Parameters &parameters,
                               const TimeParameters &steps,
                               const BoundingBox<3> &box)
    : steps(steps)
  {
    for (TimeDependence &dependence : time_dependences(parameters, box))
      courses.push_back({std::move(dependence),
                         std::numeric_limits<double>::max(),
                         std::numeric_limits<double>::lowest()});
  }


  void
  SkippedPulses::begin(const Observation &now, const bool /* resumed */)
  {
    time = now.measurement.time;
  }


  bool
  SkippedPulses::after_step(const Observation &now)
  {
    for (Course &course : courses)
      look(course, time, now.measurement.time);
    time = now.measurement.time;
    return true;
  }


  std::vector<double>
  SkippedPulses::times_between(const double from,
                               const double to,
                               const std::vector<double> &instants)
  {
    constexpr unsigned int n_parts = 32;

    std::vector<double> ends = {from};
    for (const double instant : instants)
      if (instant > from && instant < to)
        ends.push_back(instant);
    ends.push_back(to);

    std::vector<double> times;
    for (unsigned int k = 1; k < n_parts; ++k)
      times.push_back(from + k * (to - from) / n_parts);
    for (std::size_t k = 1; k < ends.size(); ++k)
      {
        times.push_back(0.5 * (ends[k - 1] + ends[k]));
        if (k + 1 < ends.size())
          times.push_back(ends[k]);
      }
    return times;
  }


  void
  SkippedPulses::look(Course &course, const double from, const double to) const
  {
    // where it jumps at an end of the step, the step has what is within it
    const double begin              = from + (steps.is_instant(from) ? steps.moment() : 0.);
    const double end                = to - (steps.is_instant(to) ? steps.moment() : 0.);
    const std::vector<double> times = times_between(begin, end, course.of.numbers);
    for (const Point<3> &point : course.of.points)
      {
        const double first = course.of.value.value(point, begin),
                     last  = course.of.value.value(point, end);
        double low = std::min(first, last), high = std::max(first, last);
        const double low_end = low, high_end = high;
        for (const double instant : times)
          {
            const double value = course.of.value.value(point, instant);
            if (!std::isfinite(value))
              continue;
            low  = std::min(low, value);
            high = std::max(high, value);
          }
        course.lowest       = std::min(course.lowest, low);
        course.highest      = std::max(course.highest, high);
        const double excess = std::max(low_end - low, high - high_end);
        if (!(excess > course.excess))
          continue;
        course.excess = excess;
        course.from   = from;
        course.to     = to;
      }
  }


  std::vector<std::string>
  SkippedPulses::warnings() const
  {
    std::vector<std::string> list;
    for (const Course &course : courses)
      if (course.excess > 0.25 * (course.highest - course.lowest) &&
          course.excess > 1e-9 * std::max(std::abs(course.highest), std::abs(course.lowest)))
        list.push_back(course.of.entry + " rises and falls by " + digits(course.excess, 3) +
                       " between the ends of the step from " + digits(course.from, 6) + " to " +
                       digits(course.to, 6) +
                       " s: the method may have stepped over it, and no estimate of the error "
                       "knows of it. Take shorter steps (Time/Step, Time/Longest step).");
    return list;
  }


  std::string
  SkippedPulses::name() const
  {
    return courses.empty() ? "" : "pulses";
  }


  nlohmann::json
  SkippedPulses::save() const
  {
    nlohmann::json all = nlohmann::json::array();
    for (const Course &course : courses)
      all.push_back({{"entry", course.of.entry},
                     {"text", course.of.text},
                     {"lowest", course.lowest},
                     {"highest", course.highest},
                     {"excess", course.excess},
                     {"from", course.from},
                     {"to", course.to}});
    return all;
  }


  void
  SkippedPulses::load(const nlohmann::json &saved)
  {
    // A scene that has changed since then may have other ones.
    for (Course &course : courses)
      for (const nlohmann::json &values : saved)
        if (values.at("entry") == course.of.entry && values.at("text") == course.of.text)
          {
            course.lowest  = values.at("lowest");
            course.highest = values.at("highest");
            course.excess  = values.at("excess");
            course.from    = values.at("from");
            course.to      = values.at("to");
          }
  }
} // namespace Supple
