#ifndef supple_pace_h
#define supple_pace_h

#include <chrono>
#include <deque>

namespace Supple
{
  /** When the next step of a live session is due by the clock, and how fast it goes. */
  class Pace
  {
  public:
    using Clock = std::chrono::steady_clock;

    /** Begins anew from a time of the simulation [s]. @param speed simulated seconds a second; 0:
     * as fast as it can */
    void
    start(double time, double speed);

    /** When the step that begins at this time [s] is due. What is late by more than a tenth of a
     * second is not made up for. */
    Clock::time_point
    due(double time);

    /** A step has ended at this time [s], which took so many seconds. */
    void
    note(double time, double seconds);

    /** Simulated seconds a second, lately. */
    double
    factor() const;

    /** Lately. */
    double
    steps_per_second() const;

    /** Lately [s]. */
    double
    seconds_per_step() const;

    /** Whether steps come later than they are due. */
    bool
    is_late() const
    {
      return late;
    }

  private:
    struct Instant
    {
      Clock::time_point when;
      double time, seconds;
    };

    Clock::time_point start_when = Clock::now();
    double start_time = 0., speed = 1.;
    bool late = false;
    std::deque<Instant> recent; ///< of the last second
  };
} // namespace Supple

#endif
