#include <supple/study/aim_curve.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Supple
{
  namespace
  {
    /** What part of the aim the next run is to have: errors do not fall evenly. */
    constexpr double target = 0.75;

    /** From this part on the aim is met closely enough. */
    constexpr double close = 0.5;

    /** A run that fails, or whose error is none, tells only that x was too large. */
    constexpr double retreat = 0.3;

    constexpr double longest_stride = 30.;
    constexpr std::size_t most_runs = 6;
  } // namespace


  AimCurve::AimCurve(const unsigned int order, const bool variable_steps)
    : order(order)
    , nominal(variable_steps ? order / (order + 1.) : order)
  {
  }


  void
  AimCurve::add(const Trial &trial)
  {
    trials.push_back(trial);
  }


  const AimCurve::Trial *
  AimCurve::best(const double aim) const
  {
    const Trial *found = nullptr;
    for (const Trial &trial : trials)
      if (trial.error <= aim && (!found || trial.seconds < found->seconds))
        found = &trial;
    return found;
  }


  const AimCurve::Trial *
  AimCurve::nearest(const double aim) const
  {
    const auto distance = [aim](const Trial &trial) {
      return std::abs(std::log(std::max(trial.error, 1e-300) / aim));
    };
    const Trial *found = nullptr;
    for (const Trial &trial : trials)
      if (std::isfinite(trial.error) && (!found || distance(trial) < distance(*found)))
        found = &trial;
    return found;
  }


  double
  AimCurve::exponent() const
  {
    double found = nominal;
    for (std::size_t i = 1; i < trials.size(); ++i)
      {
        const Trial &one = trials[i - 1], &other = trials[i];
        const double slope = std::log(one.error / other.error) / std::log(one.x / other.x);
        if (std::isfinite(slope))
          found = std::clamp(slope, 0.4 * nominal, 1.5 * nominal);
      }
    return found;
  }


  std::optional<double>
  AimCurve::next(const double aim) const
  {
    if (trials.empty() || trials.size() >= most_runs)
      return {};
    const Trial *const met = best(aim);
    if (met && met->error > close * aim)
      return {};
    const Trial *const known = nearest(aim);
    if (!known)
      return retreat * trials.back().x;
    double x = known->x *
               std::clamp(std::pow(target * aim / std::max(known->error, 1e-300), 1. / exponent()),
                          1. / longest_stride,
                          longest_stride);
    // between what is too large and what is small enough, if both are known
    double large = std::numeric_limits<double>::max(), small = 0.;
    for (const Trial &trial : trials)
      if (trial.error <= aim)
        small = std::max(small, trial.x);
      else
        large = std::min(large, trial.x);
    if (small > 0. && large < std::numeric_limits<double>::max())
      {
        if (large < 1.3 * small)
          return {};
        x =
          std::clamp(x, small * std::pow(large / small, 0.2), small * std::pow(large / small, 0.8));
      }
    else if (small == 0. && x > 0.8 * large)
      x = retreat * large;
    return x;
  }


  double
  AimCurve::expected_seconds(const double aim) const
  {
    const Trial *const known = nearest(aim);
    return known ? known->seconds * std::pow(std::max(known->error, 1e-300) / aim, 1. / order)
                 : std::numeric_limits<double>::quiet_NaN();
  }


  double
  AimCurve::price_of_half() const
  {
    return std::pow(2., 1. / order);
  }
} // namespace Supple
