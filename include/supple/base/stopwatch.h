#ifndef supple_stopwatch_h
#define supple_stopwatch_h

#include <chrono>

namespace Supple
{
  /** Tells the time since it was made. */
  class Stopwatch
  {
  public:
    double
    seconds() const
    {
      return std::chrono::duration<double>(Clock::now() - start).count();
    }

  private:
    using Clock = std::chrono::steady_clock;

    const Clock::time_point start = Clock::now();
  };
} // namespace Supple

#endif
