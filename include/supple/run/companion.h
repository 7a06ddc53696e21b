#ifndef supple_companion_h
#define supple_companion_h

#include <supple/mechanics/body.h>
#include <supple/scene/parameters.h>

#include <functional>
#include <optional>
#include <string>

namespace Supple
{
  /** A run of another scene that moves along with a run, to tell the error of that. */
  class Companion
  {
  public:
    /** Where a companion is. */
    struct Arrival
    {
      double time; ///< [s], or load factor
      const Body &body;
      const Vector &displacement; ///< [m]
    };

    /** Moves a run up to a time or just past it. @throws ComputationError */
    using Run = std::function<Arrival(double time)>;

    explicit Companion(const Run &run)
      : run(run)
    {
    }

    /** A scene without what a companion does not need. */
    static Parameters
    scene(const Parameters &scene);

    /** Moves the companion to a time. @return nothing if it is not there then, or has failed */
    std::optional<Arrival>
    move_to(double time);

    /** To be called at the end of the run: if the two have never been at the same time, that is a
     * failure. */
    void
    require_meeting();

    double seconds = 0.; ///< that the companion took
    std::string failure; ///< why nothing is known by it; empty while all is well

  private:
    const Run run;
    bool met = false; ///< whether the two runs have been at the same time
  };
} // namespace Supple

#endif
