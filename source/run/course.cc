#include <supple/run/course.h>

#include <nlohmann/json.hpp>

#include <cmath>

namespace Supple
{
  double
  Course::seconds_since_start() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }


  double
  Course::seconds() const
  {
    return seconds_before + seconds_since_start() - setup_seconds;
  }


  nlohmann::json
  Course::save() const
  {
    return {{"step", now.step},
            {"time", now.time},
            {"error_estimate", error_estimate},
            {"largest_motion", largest_motion},
            {"seconds", seconds()}};
  }


  void
  Course::load(const nlohmann::json &saved)
  {
    now.step = steps_before = saved.at("step");
    now.time                = saved.at("time");
    // JSON has null for what is not a number.
    const auto &local_errors = saved.at("error_estimate");
    error_estimate           = local_errors.is_null() ? NAN : local_errors.get<double>();
    largest_motion           = saved.at("largest_motion");
    seconds_before           = saved.at("seconds");
  }
} // namespace Supple
