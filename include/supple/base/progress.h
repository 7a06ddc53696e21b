#ifndef supple_progress_h
#define supple_progress_h

#include <chrono>
#include <string>

namespace Supple
{
  /** A line on the terminal that tells how far the run is; silent when the output is no terminal.
   */
  class Progress
  {
  public:
    Progress(bool wanted, bool plain);

    /** Called after each step; writes at most a few times a second. */
    void
    update(unsigned int step, double part_done);

    /** Takes the line away. */
    void
    clear();

  private:
    using Clock = std::chrono::steady_clock;

    const bool active;
    const bool plain;
    const Clock::time_point start;
    Clock::time_point last;
    bool shown              = false;
    unsigned int next_tenth = 1;
  };


  /** "1 h 02 min", "3 min 20 s" or "4.2 s" */
  std::string
  readable_duration(double seconds);
} // namespace Supple

#endif
