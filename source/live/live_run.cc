#include <supple/live/live_run.h>

#include <supple/base/error.h>
#include <supple/base/files.h>
#include <supple/base/first_process.h>
#include <supple/base/stopwatch.h>
#include <supple/base/text.h>
#include <supple/forces/contact.h>
#include <supple/live/live_page.h>
#include <supple/live/words.h>

#include <deal.II/base/mpi.h>

#include <spawn.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

extern char **environ;

namespace Supple
{
  using namespace dealii;
  using Json = nlohmann::ordered_json;

  namespace
  {
    constexpr std::chrono::milliseconds between_frames(16), between_rows(50), between_marks(1000),
      nap(50);
    constexpr std::size_t most_rows = 256; ///< that are told at once
    constexpr double frame_time     = 1. / 60.;


    /** Has whatever a session shows measured. */
    class Watcher : public Listener
    {
      bool
      after_step(const Observation &) override
      {
        return true;
      }
    };


    Parameters
    from_its_start(const Parameters &scene)
    {
      Parameters begun        = alone(scene);
      begun.checkpoint.resume = false;
      return begun;
    }


    /** That other runs are left out, if the scene asks for them; empty if it does not. */
    std::string
    what_is_left_out(const Parameters &scene)
    {
      std::string entries;
      if (scene.time.estimate_error)
        entries = scene.origin("Time/Estimate error");
      if (scene.space.second_mesh != SpaceParameters::SecondMesh::none)
        entries += (entries.empty() ? "" : " and ") + scene.origin("Space/Second mesh");
      return entries.empty() ? ""
                             : entries +
                                 ": left out, for other runs know nothing of hands; the page "
                                 "runs all again with half the step.";
    }


    /**
     * Opens the page where there is a desktop; elsewhere nothing happens. The address has the
     * token, which others could read among the arguments of a program: it goes by a file that they
     * can't read, and that forwards to it.
     */
    void
    open_in_browser(const std::string &address)
    {
      const char *const own_folder = std::getenv("XDG_RUNTIME_DIR");
      if (!own_folder || (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")))
        return;
      std::string program = "xdg-open", file = std::string(own_folder) + "/supple-live.html";
      std::ofstream(file) << "<!doctype html><meta http-equiv=\"refresh\" content=\"0; url="
                          << address << "\">\n";
      std::error_code unknown;
      std::filesystem::permissions(
        file, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write, unknown);
      char *words[] = {program.data(), file.data(), nullptr};
      pid_t process;
      posix_spawnp(&process, words[0], nullptr, nullptr, words, environ);
    }


    Json
    list_of(const Tensor<1, 3> &vector)
    {
      return {vector[0], vector[1], vector[2]};
    }


    /** So many of the rows at most, the last one among them; what is no number becomes null. */
    Json
    thinned(std::vector<std::vector<double>> &rows)
    {
      Json list               = Json::array();
      const std::size_t every = rows.size() / most_rows + 1;
      for (std::size_t row = (rows.size() + every - 1) % every; row < rows.size(); row += every)
        list.push_back(rows[row]);
      rows.clear();
      return list;
    }
  } // namespace


  LiveRun::LiveRun(const Parameters &scene_at_start,
                   const Session::Scene &scene,
                   const std::string &folder,
                   const bool quiet,
                   const MPI_Comm communicator)
    : first(from_its_start(scene_at_start))
    , scene(scene)
    , folder(folder)
    , communicator(communicator)
    , root(Utilities::MPI::this_mpi_process(communicator) == 0)
    , talks(root && !quiet)
    , watcher(std::make_unique<Watcher>())
    , entry_names(names_of_entries(first))
  {
    const std::string left_out = what_is_left_out(scene_at_start);
    if (talks && !left_out.empty())
      std::cout << left_out << std::endl;
    open_session();
  }


  LiveRun::~LiveRun() = default;


  void
  LiveRun::open_session()
  {
    session.reset(); // it lets go of the folder
    session = std::make_unique<Session>(
      first, scene, folder, !talks || session_number > 1, 1., communicator);
    session->begin({}, watcher.get());
    on_first_process(communicator, [this] {
      write_whole_file(folder + "/" + repeated_scene_name, repeating_scene(first, scene, folder));
    });
    surface                      = std::make_unique<BodySurface>(session->now().present().body);
    const Contact *const contact = session->now().present().forces.contact();
    of_tools.assign(contact ? contact->all_tools().size() : 0, {});
    history.clear();
    probes.clear();
    errors.clear();
    grips.clear();
    note_step();
  }


  void
  LiveRun::start_server()
  {
    LiveContent content = live_content(*session, *surface);
    on_first_process(communicator, [&] {
      server = std::make_unique<LiveServer>(mailbox, std::move(content));
      std::cout << "The session is at " << server->address()
                << "\n(Ctrl-C ends it; on a far machine, first ssh -L with this port.)"
                << std::endl;
      open_in_browser(server->address());
    });
  }


  void
  LiveRun::run()
  {
    interrupt.emplace();
    start_server();
    try
      {
        serve();
        session->end();
      }
    catch (const std::exception &error)
      {
        tell({{"kind", "ended"}, {"message", error.what()}});
        throw;
      }
    if (root)
      {
        const std::string once_more =
          "supple " + folder + "/" + repeated_scene_name + " does the same once more.";
        tell({{"kind", "ended"}, {"message", "The session has ended. " + once_more}});
        server.reset();
        if (talks)
          std::cout << "The session is in " << folder << "; " << once_more << std::endl;
      }
  }


  void
  LiveRun::serve()
  {
    while (!ending)
      {
        const Orders orders = shared(root ? next_orders() : Orders());
        for (const Mailbox::Request &request : orders.requests)
          obey(request);
        if (orders.step && !ending)
          take_step();
        else if (again && !running)
          go_on_again();
        if (orders.arrival || changed)
          show_state();
        if (orders.rows)
          show_rows();
        if (orders.frame)
          show_frame();
        if (interrupt->requested(communicator) || session->now().finished())
          ending = true;
      }
    again.reset();
  }


  LiveRun::Orders
  LiveRun::next_orders()
  {
    const bool wants_step = running || single_steps > 0;
    const auto now        = Pace::Clock::now();
    if (!wants_step)
      mailbox.wait_until(again ? now : now + nap);
    else if (single_steps == 0)
      mailbox.wait_until(std::min(pace.due(session->now().time()), now + nap));

    Orders orders;
    const auto due   = pace.due(session->now().time());
    const auto later = Pace::Clock::now();
    orders.step      = single_steps > 0 || (running && due <= later);
    orders.requests  = mailbox.take_requests();
    orders.arrival   = mailbox.take_arrival();
    orders.frame     = later - last_frame >= between_frames && mailbox.wants_frame();
    orders.rows      = later - last_rows >= between_rows;
    if (orders.frame)
      last_frame = later;
    if (orders.rows)
      last_rows = later;
    if (running && later - last_mark >= between_marks)
      {
        session->mark_progress();
        last_mark = later;
      }
    return orders;
  }


  LiveRun::Orders
  LiveRun::shared(const Orders &orders) const
  {
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return orders;
    nlohmann::json packed = {orders.arrival, orders.step, orders.frame, orders.rows};
    for (const Mailbox::Request &request : orders.requests)
      packed.push_back({request.number, request.text});
    const auto all =
      nlohmann::json::parse(Utilities::MPI::broadcast(communicator, packed.dump(-1, ' ', true)));
    Orders same;
    same.arrival = all[0];
    same.step    = all[1];
    same.frame   = all[2];
    same.rows    = all[3];
    for (std::size_t k = 4; k < all.size(); ++k)
      same.requests.push_back({all[k][0], all[k][1]});
    return same;
  }


  void
  LiveRun::obey(const Mailbox::Request &request)
  {
    last_request = request.number;
    try
      {
        act(request.text);
      }
    catch (const InputError &error)
      {
        tell({{"kind", "refused"},
              {"number", request.number},
              {"command", request.text},
              {"message", error.what()}});
      }
  }


  void
  LiveRun::act(const std::string &command)
  {
    Words words(command);
    const std::string what = words.word("a command");
    changed                = changed || (what != "move" && what != "tool"); // which frames tell
    if (what == "release" || what == "set")
      session->act(command);
    else if (!control(what, words) && !move_by_hand(what, words))
      words.refuse("there is no such command");
  }


  bool
  LiveRun::control(const std::string &what, Words &words)
  {
    if (what == "run" || what == "pause")
      {
        running = what == "run";
        pace.start(session->now().time(), speed);
      }
    else if (what == "step")
      {
        running = false;
        ++single_steps;
      }
    else if (what == "speed")
      {
        const double wanted = words.number("a speed");
        if (wanted < 0.)
          words.refuse("a speed is 0, as fast as it can, or more");
        speed = wanted;
        pace.start(session->now().time(), speed);
      }
    else if (what == "reset")
      {
        running      = false;
        single_steps = 0;
        again.reset();
        ++session_number;
        open_session();
      }
    else if (what == "again")
      start_again();
    else if (what == "stop")
      {
        words.expect("again");
        if (again)
          end_again("failed", "It was stopped.");
      }
    else if (what == "quit")
      ending = true;
    else
      return false;
    words.expect_end();
    return true;
  }


  bool
  LiveRun::move_by_hand(const std::string &what, Words &words)
  {
    if (what == "tool")
      {
        const std::string tool   = words.word("the name of a tool");
        const Tensor<1, 3> place = words.place();
        words.expect_end();
        if (const std::string take = session->take(tool); !take.empty())
          session->act(take);
        session->act(move_to("tool " + tool, place));
        return true;
      }
    if (what != "grab" && what != "hold" && what != "move")
      return false;
    const unsigned int vertex = words.vertex();
    const Tensor<1, 3> place  = words.place();
    if (what == "grab")
      {
        const double radius = words.number("a radius"), stiffness = words.number("a stiffness");
        if (radius < 0. || stiffness < 0.)
          words.refuse("neither radius nor stiffness can be below 0");
        words.expect_end();
        const std::string deed = session->grab(vertex, radius, stiffness);
        let_go(vertex);
        session->act(deed);
      }
    else
      words.expect_end();
    if (what == "hold")
      {
        const std::string deed = session->hold(vertex);
        let_go(vertex);
        session->act(deed);
      }
    session->act(move_to("move " + std::to_string(vertex), place));
    return true;
  }


  void
  LiveRun::let_go(const unsigned int vertex)
  {
    if (session->has_in_hand(vertex))
      session->act("release " + std::to_string(vertex));
  }


  /** To the next frame of the page, in whole steps: then the hand does not turn within one. */
  double
  LiveRun::duration_of_move() const
  {
    const TimeParameters &time = session->now().present().parameters.time;
    const double wanted        = frame_time * (speed > 0. ? speed : 1.);
    if (time.has_variable_steps())
      return wanted;
    return time.step * std::max(1l, std::lround(wanted / time.step));
  }


  std::string
  LiveRun::move_to(const std::string &whom, const Tensor<1, 3> &place) const
  {
    std::string text = whom;
    for (unsigned int i = 0; i < 3; ++i)
      text += " " + digits(place[i], all_digits);
    return text + " over " + digits(duration_of_move(), all_digits);
  }


  void
  LiveRun::take_step()
  {
    if (single_steps > 0)
      --single_steps;
    const Stopwatch stopwatch;
    try
      {
        if (!session->try_step())
          ending = true;
        pace.note(session->now().time(), stopwatch.seconds());
        note_step();
      }
    catch (const InterruptedError &)
      {
        ending = true;
      }
    catch (const ComputationError &error)
      {
        running      = false;
        single_steps = 0;
        changed      = true;
        tell({{"kind", "failed"},
              {"message",
               "The step after " + digits(session->now().time(), 6) + " s failed: " + error.what() +
                 ". What was done for it is undone; the session waits in the state before."}});
      }
  }


  void
  LiveRun::note_step()
  {
    const Simulation &now = session->now();
    if (!root)
      return;
    history.push_back(now.measurement().row());
    if (now.probe_row().size() > 2)
      probes.push_back(now.probe_row());
    errors.push_back({now.time(), now.error_estimate(), now.measurement().seconds});
    if (now.measurement().contact)
      for (std::size_t t = 0; t < of_tools.size(); ++t)
        of_tools[t].push_back(
          ToolTables::row(now.measurement(), now.measurement().contact->tools[t]));
  }


  void
  LiveRun::start_again()
  {
    std::vector<Deed> deeds = session->deeds();
    const double end        = session->now().time();
    if (end == 0.)
      throw InputError("again: nothing has happened yet.");
    deeds.push_back({session->now().measurement().step, end, end_of_motion, ""});
    Parameters quiet     = first;
    quiet.space.estimate = SpaceParameters::Estimate::never;
    again = std::make_unique<Replay>(quiet, scene, deeds, true, "", true, 0.5, communicator);
    again->begin();
    seconds_of_again     = 0.;
    displacement_to_meet = session->now().current_state().displacement;
    running              = false;
    tell({{"kind", "again"}, {"status", "running"}, {"part", 0.}});
  }


  void
  LiveRun::end_again(const std::string &status, const std::string &message)
  {
    again.reset();
    tell({{"kind", "again"}, {"status", status}, {"message", message}});
  }


  void
  LiveRun::go_on_again()
  {
    const Stopwatch stopwatch;
    try
      {
        if (!again->finished())
          {
            again->advance();
            seconds_of_again += stopwatch.seconds();
            if (again->session().now().measurement().step % 20 == 0)
              tell({{"kind", "again"}, {"status", "running"}, {"part", again->part_done()}}, true);
            return;
          }
        const Simulation &other = again->session().now();
        const double difference =
          largest_vertex_distance(other.current_state().displacement, displacement_to_meet);
        const double motion = other.largest_motion();
        again.reset();
        tell({{"kind", "again"},
              {"status", "done"},
              {"part", 1.},
              {"difference", difference},
              {"relative", motion > 0. ? difference / motion : 0.},
              {"seconds", seconds_of_again}});
      }
    catch (const InterruptedError &)
      {
        ending = true;
      }
    catch (const ComputationError &error)
      {
        end_again("failed", error.what());
      }
    catch (const InputError &error)
      {
        end_again("failed", error.what());
      }
  }


  void
  LiveRun::show_frame()
  {
    const Simulation &now = session->now();
    LiveFrame frame;
    frame.displacements = surface->gathered(now.current_state().displacement);
    if (!root)
      return;
    if (const Contact *const contact = now.present().forces.contact())
      for (const Tool &tool : contact->all_tools())
        frame.tools.push_back(tool.pose(now.time()));
    frame.time             = now.time();
    frame.step             = now.measurement().step;
    frame.last_request     = last_request;
    frame.running          = running;
    frame.late             = running && pace.is_late();
    frame.factor           = running ? pace.factor() : 0.;
    frame.steps_per_second = running ? pace.steps_per_second() : 0.;
    frame.seconds_per_step = pace.seconds_per_step();
    frame.session          = session_number;
    mailbox.put_frame(std::make_shared<const std::vector<unsigned char>>(packed(frame)));
  }


  void
  LiveRun::show_rows()
  {
    const std::vector<Session::Grip> here = session->grips();
    if (!root || (history.empty() && here.empty() && grips.empty()))
      return;
    const double second =
      std::chrono::duration<double>(Pace::Clock::now().time_since_epoch()).count();
    grips.emplace_back(second, here);
    while (grips.front().first < second - 0.1)
      grips.pop_front();
    Json pulls = Json::array();
    for (const Session::Grip &grip : here)
      {
        Tensor<1, 3> mean;
        unsigned int n = 0;
        for (const auto &[when, earlier] : grips)
          for (const Session::Grip &same : earlier)
            if (same.vertex == grip.vertex)
              {
                mean += same.force;
                ++n;
              }
        pulls.push_back({{"vertex", grip.vertex},
                         {"held", grip.holds},
                         {"target", list_of(grip.target)},
                         {"place", list_of(grip.place)},
                         {"force", list_of(grip.force)},
                         {"mean", list_of(mean / n)},
                         {"stiffness", grip.stiffness},
                         {"step", session->now().measurement().step}});
      }
    if (here.empty())
      grips.clear();
    Json tools = Json::object();
    if (const Contact *const contact = session->now().present().forces.contact())
      for (std::size_t t = 0; t < of_tools.size(); ++t)
        tools[contact->all_tools()[t].parameters.name] = thinned(of_tools[t]);
    tell({{"kind", "rows"},
          {"history", thinned(history)},
          {"probes", thinned(probes)},
          {"tools", tools},
          {"error", thinned(errors)},
          {"pulls", pulls}},
         true);
  }


  void
  LiveRun::show_state()
  {
    changed                                 = false;
    const std::vector<std::string> warnings = session->now().warnings();
    const Parameters &parameters            = session->now().present().parameters;
    if (!root)
      return;
    Json held = Json::array();
    for (const auto &hand : parameters.constraints.by_hand)
      held.push_back(hand.vertex);
    tell({{"kind", "state"},
          {"running", running},
          {"speed", speed},
          {"time", session->now().time()},
          {"step", session->now().measurement().step},
          {"session", session_number},
          {"entries", values_of_entries(entry_names, parameters)},
          {"method", parameters.time.method_name()},
          {"step_size", parameters.time.has_variable_steps() ? Json() : Json(parameters.time.step)},
          {"held", held},
          {"warnings", warnings}});
  }


  void
  LiveRun::tell(const Json &message, const bool droppable)
  {
    if (root)
      mailbox.put_text(message.dump(-1, ' ', false, Json::error_handler_t::replace), droppable);
  }
} // namespace Supple
