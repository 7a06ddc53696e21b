#ifndef supple_replay_h
#define supple_replay_h

#include <supple/live/session.h>

#include <functional>
#include <string>
#include <vector>

namespace Supple
{
  /** A session that is done again, deed by deed. */
  class Replay
  {
  public:
    /**
     * Parameters as of Session.
     * @param deeds    what is done
     * @param by_time  at the same times, not after as many steps
     * @throws InputError if a deed can't be done
     */
    Replay(const Parameters &first,
           const Session::Scene &scene,
           const std::vector<Deed> &deeds,
           bool by_time,
           const std::string &folder,
           bool quiet,
           double finer,
           MPI_Comm communicator);

    /** Runs it to its end. @throws as Simulation::run(), and InputError if a deed can't be done in
     * its state, after all files are complete */
    void
    run();

    void
    check();

    /** Makes it ready for advance(). */
    void
    begin();

    /** Does what is to be done now, and takes a step. @return whether no listener asks to stop */
    bool
    advance();

    /** Whether all is done. */
    bool
    finished() const;

    /** How much of the time is over, up to 1. */
    double
    part_done() const;

    const Session &
    session() const
    {
      return of_deeds;
    }

  private:
    bool
    is_due(const Deed &deed) const;

    void
    do_what_is_due();

    const std::vector<Deed> deeds;
    const bool by_time;
    const bool talks;
    Session of_deeds;
    std::size_t next = 0; ///< deed
  };
} // namespace Supple

#endif
