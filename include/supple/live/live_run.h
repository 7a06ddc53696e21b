#ifndef supple_live_run_h
#define supple_live_run_h

#include <supple/base/interrupt.h>
#include <supple/live/live_server.h>
#include <supple/live/mailbox.h>
#include <supple/live/pace.h>
#include <supple/live/replay.h>
#include <supple/live/session.h>
#include <supple/output/body_surface.h>

#include <nlohmann/json.hpp>

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  class Words;


  /**
   * A session that a page moves, in real time or as fast as it can.
   *
   * The step never depends on the clock: what is done by hand is taken between two steps, and
   * repeated by FOLDER/live.prm to the same digits. The first process has the server; all others do
   * what it tells them.
   */
  class LiveRun
  {
  public:
    /** Parameters as of Session. @throws InputError */
    LiveRun(const Parameters &first,
            const Session::Scene &scene,
            const std::string &folder,
            bool quiet,
            MPI_Comm communicator);

    ~LiveRun();

    /** Serves the page until it quits, or the program is interrupted. @throws InputError,
     * WriteError */
    void
    run();

  private:
    /** What the first process has all do. */
    struct Orders
    {
      std::vector<Mailbox::Request> requests;
      bool arrival = false; ///< a page has come
      bool step    = false;
      bool frame   = false; ///< to be shown
      bool rows    = false;
    };

    void
    open_session();

    void
    start_server();

    /** Until the page or the user ends it. */
    void
    serve();

    /** Waits for what is to be done. */
    Orders
    next_orders();

    Orders
    shared(const Orders &orders) const;

    void
    obey(const Mailbox::Request &request);

    /** @throws InputError if the session can't do that; nothing has changed then */
    void
    act(const std::string &command);

    /** Does what a page says of the time and the session. @return whether it says that */
    bool
    control(const std::string &what, Words &words);

    /** Does what a page says of a hand. @return whether it says that */
    bool
    move_by_hand(const std::string &what, Words &words);

    /** Releases a vertex that is to be taken otherwise. */
    void
    let_go(unsigned int vertex);

    void
    take_step();

    /** A step of the run with half the step, if there is one. */
    void
    go_on_again();

    void
    start_again();

    void
    end_again(const std::string &status, const std::string &message);

    /** How long a hand takes to a new place [s]. */
    double
    duration_of_move() const;

    std::string
    move_to(const std::string &whom, const dealii::Tensor<1, 3> &place) const;

    void
    show_frame();

    void
    show_rows();

    void
    show_state();

    void
    tell(const nlohmann::ordered_json &message, bool droppable = false);

    void
    note_step();

    const Parameters first;
    const Session::Scene scene;
    const std::string folder;
    const MPI_Comm communicator;
    const bool root, talks;
    const std::unique_ptr<Listener> watcher;    ///< has energies measured whatever is written
    const std::vector<std::string> entry_names; ///< that may be set
    std::unique_ptr<Session> session;
    std::unique_ptr<BodySurface> surface;
    Mailbox mailbox;                                          ///< on the first process
    std::unique_ptr<LiveServer> server;                       ///< on the first process
    Pace pace;                                                ///< on the first process
    Pace::Clock::time_point last_frame, last_rows, last_mark; ///< on the first process
    std::optional<InterruptGuard> interrupt;

    bool running = false, ending = false, changed = false;
    double speed                = 1.;
    unsigned int single_steps   = 0; ///< to be taken
    unsigned int session_number = 1;
    unsigned int last_request   = 0;

    std::unique_ptr<Replay> again;
    double seconds_of_again = 0.; ///< that it took
    Vector displacement_to_meet;  ///< where the session was when it was begun [m]

    // Since the last rows.
    std::vector<std::vector<double>> history, probes, errors;
    std::vector<std::vector<std::vector<double>>> of_tools;
    std::deque<std::pair<double, std::vector<Session::Grip>>> grips; ///< of the last tenth second
  };
} // namespace Supple

#endif
