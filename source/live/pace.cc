#include <supple/live/pace.h>

#include <numeric>

namespace Supple
{
  namespace
  {
    double
    seconds_between(const Pace::Clock::time_point from, const Pace::Clock::time_point to)
    {
      return std::chrono::duration<double>(to - from).count();
    }
  } // namespace


  void
  Pace::start(const double time, const double wanted)
  {
    start_when = Clock::now();
    start_time = time;
    speed      = wanted;
    late       = false;
    recent.clear();
  }


  Pace::Clock::time_point
  Pace::due(const double time)
  {
    constexpr double longest_debt = 0.1; // [s]

    const Clock::time_point now = Clock::now();
    if (speed == 0.)
      return now;
    const std::chrono::duration<double> since((time - start_time) / speed);
    const auto when = start_when + std::chrono::duration_cast<Clock::duration>(since);
    late            = seconds_between(when, now) > longest_debt;
    if (late)
      {
        start_when = now;
        start_time = time;
      }
    return when;
  }


  void
  Pace::note(const double time, const double seconds)
  {
    const Clock::time_point now = Clock::now();
    recent.push_back({now, time, seconds});
    while (recent.size() > 2 && seconds_between(recent.front().when, now) > 1.)
      recent.pop_front();
  }


  double
  Pace::factor() const
  {
    if (recent.size() < 2)
      return 0.;
    return (recent.back().time - recent.front().time) /
           seconds_between(recent.front().when, recent.back().when);
  }


  double
  Pace::steps_per_second() const
  {
    if (recent.size() < 2)
      return 0.;
    return (recent.size() - 1) / seconds_between(recent.front().when, recent.back().when);
  }


  double
  Pace::seconds_per_step() const
  {
    if (recent.empty())
      return 0.;
    return std::accumulate(recent.begin(),
                           recent.end(),
                           0.,
                           [](const double sum, const Instant &instant) {
                             return sum + instant.seconds;
                           }) /
           recent.size();
  }
} // namespace Supple
