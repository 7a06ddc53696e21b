#include <supple/base/progress.h>

#include <unistd.h>

#include <cstdio>
#include <iostream>

namespace Supple
{
  std::string
  readable_duration(const double seconds)
  {
    char text[64];
    if (seconds < 60.)
      std::snprintf(text, sizeof(text), "%.1f s", seconds);
    else if (seconds < 3600.)
      std::snprintf(text, sizeof(text), "%d min %02d s", int(seconds) / 60, int(seconds) % 60);
    else
      std::snprintf(
        text, sizeof(text), "%d h %02d min", int(seconds) / 3600, int(seconds) / 60 % 60);
    return text;
  }


  Progress::Progress(const bool wanted, const bool plain)
    : active(wanted && isatty(STDOUT_FILENO))
    , plain(plain)
    , start(Clock::now())
    , last(start)
  {
  }


  void
  Progress::update(const unsigned int step, const double part_done)
  {
    if (!active)
      return;
    const auto now = Clock::now();
    if (plain ? 10. * part_done < next_tenth
              : (now - last < std::chrono::milliseconds(200) && part_done < 1.))
      return;
    while (10. * part_done >= next_tenth)
      ++next_tenth;
    last = now;

    const double seconds = std::chrono::duration<double>(now - start).count();
    char text[128];
    std::snprintf(text,
                  sizeof(text),
                  "%s%3.0f %%  step %u  %.3g steps/s  %s left%s",
                  plain ? "" : "\r",
                  100. * part_done,
                  step,
                  step / seconds,
                  readable_duration(seconds * (1. - part_done) / part_done).c_str(),
                  plain ? "\n" : "\033[K");
    std::cout << text << std::flush;
    shown = !plain;
  }


  void
  Progress::clear()
  {
    if (shown)
      std::cout << "\r\033[K" << std::flush;
    shown = false;
  }
} // namespace Supple
