#include <supple/live/session.h>

#include <supple/base/error.h>
#include <supple/base/files.h>
#include <supple/base/text.h>
#include <supple/forces/contact.h>
#include <supple/mechanics/selection.h>
#include <supple/output/checkpoint.h>
#include <supple/run/description.h>
#include <supple/scene/read_scene.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    constexpr const char *grips_file = "hands.csv";

    /** Without what can't go along with hands. @throws InputError */
    void
    require_session(const Parameters &scene)
    {
      if (scene.time.problem == TimeParameters::Problem::stationary)
        throw InputError(scene.origin("Time/Problem") +
                         ": hands move a body in time, and a static scene has none. Make it "
                         "dynamic: Time/Problem = dynamic.");
      if (scene.checkpoint.minutes > 0.)
        throw InputError(scene.origin("Checkpoint/Minutes") +
                         ": what is done by hand could not be repeated to the same digits where "
                         "checkpoints come by the clock. Take Checkpoint/Every.");
    }


    Parameters
    for_session(const Parameters &scene)
    {
      require_session(scene);
      Parameters session      = alone(scene);
      session.time.open_ended = true;
      return session;
    }


    /** Mean of the diagonal of K' at a vertex [N/m]. Collective. */
    double
    stiffness_at(const Problem &problem, const unsigned int vertex)
    {
      const Body &body = problem.body;
      Vector unit, force;
      body.initialize(unit);
      body.initialize(force);
      double sum = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        {
          unit = 0.;
          for (unsigned int node = 0; node < body.n_owned; ++node)
            if (body.serial_vertex[node] == vertex && !problem.constraints.holds(3 * node + i))
              unit.local_element(3 * node + i) = 1.;
          problem.implicit_operator.stiffness_vmult(force, unit);
          sum += unit * force / 3.;
        }
      return sum;
    }


    std::string
    in_words(const Tensor<1, 3> &place)
    {
      return digits(place[0], all_digits) + " " + digits(place[1], all_digits) + " " +
             digits(place[2], all_digits);
    }
  } // namespace


  Parameters
  alone(Parameters scene)
  {
    scene.time.estimate_error = false;
    scene.space.second_mesh   = SpaceParameters::SecondMesh::none;
    return scene;
  }


  std::vector<std::string>
  grip_columns()
  {
    return {"step",
            "time",
            "vertex",
            "holds",
            "target_x",
            "target_y",
            "target_z",
            "x",
            "y",
            "z",
            "fx",
            "fy",
            "fz"};
  }


  Session::Session(const Parameters &scene,
                   const Scene &read,
                   const std::string &folder,
                   const bool quiet,
                   const double finer,
                   const MPI_Comm communicator)
    : first(for_session(scene))
    , read(read)
    , folder(folder)
    , quiet(quiet)
    , finer(finer)
    , communicator(communicator)
  {
    simulation       = std::make_unique<Simulation>(present_scene(), folder, quiet, communicator);
    const Body &body = simulation->present().body;
    for (unsigned int node = 0; node < body.n_owned; ++node)
      own_nodes.emplace(body.serial_vertex[node], node);
  }


  Parameters
  Session::present_scene() const
  {
    const std::vector<Override> changes = hands.overrides();
    Parameters scene                    = changes.empty() ? first : for_session(read(changes));
    scene.mesh                          = first.mesh; // with what pilots have found
    scene.as_used                       = first.as_used;
    if (simulation)
      check_directions(scene, simulation->present().mesh.section);
    TimeParameters &time = scene.time;
    if (time.has_variable_steps())
      time.relative_tolerance *= finer < 1. ? 0.1 : 1.;
    else
      {
        // What counts as an instant depends on the end, which stays.
        time.step *= finer;
        time.n_steps = std::max(1l, std::lround(first.time.end() / time.step));
      }
    hands.put_into(scene);
    return scene;
  }


  void
  Session::check(const std::vector<Deed> &deeds, const bool thoroughly)
  {
    Hands trial;
    for (const Deed &deed : deeds)
      if (deed.text != end_of_motion)
        try
          {
            const Hands::Effect effect = trial.apply(deed.text, deed.time);
            if (deed.text.rfind("set ", 0) == 0)
              for_session(read(trial.overrides()));
            Parameters scene = first;
            trial.put_into(scene);
            require_vertices(trial);
            for (const auto &[vertex, path] : trial.holds())
              require_free(vertex);
            if (thoroughly && effect == Hands::Effect::changes)
              {
                hands = trial;
                Problem(present_scene(), simulation->present().shared_mesh);
              }
          }
        catch (const InputError &error)
          {
            throw InputError(deed.place + ": " + error.what());
          }
    hands = Hands();
  }


  void
  Session::check_start()
  {
    simulation->check();
  }


  void
  Session::begin(const std::vector<Deed> &deeds, Listener *const with_guest)
  {
    guest = with_guest;
    std::optional<unsigned int> from;
    if (first.checkpoint.resume && !folder.empty())
      from = Checkpoint::step_in(folder, communicator);
    for (const Deed &deed : deeds)
      if (from && deed.step < *from && deed.text != end_of_motion)
        {
          hands.apply(deed.text, deed.time);
          done.push_back(deed);
        }
    if (!done.empty())
      simulation = std::make_unique<Simulation>(present_scene(), folder, quiet, communicator);
    hands_before = hands;
    simulation->begin(guest);
    if (folder.empty() || Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    begin_motion_file(deeds);
    if (first.output.history)
      {
        const std::string table = folder + "/" + grips_file;
        grips_table             = from ? std::make_unique<CsvFile>(table, grip_columns(), *from)
                                       : std::make_unique<CsvFile>(table, grip_columns());
      }
  }


  /** Of a repetition all is there at once: its folder may be that of the session. */
  void
  Session::begin_motion_file(const std::vector<Deed> &deeds)
  {
    const std::string file = folder + "/" + motion_file_name;
    std::string all;
    for (const Deed &deed : deeds)
      all += line_of(deed);
    write_whole_file(file, all);
    if (!deeds.empty())
      return;
    motion_file.open(file, std::ios::app);
    if (!motion_file)
      throw WriteError(file + " can't be written.");
  }


  void
  Session::mark_progress()
  {
    write_deed({now().measurement().step, now().time(), "wait", ""});
  }


  void
  Session::write_deed(const Deed &deed)
  {
    if (!motion_file.is_open())
      return;
    motion_file << line_of(deed) << std::flush;
    if (!motion_file)
      throw WriteError(folder + "/" + motion_file_name +
                       " can't be written any more; is the disk full?");
  }


  void
  Session::require_vertex(const unsigned int vertex) const
  {
    const Body &body  = simulation->present().body;
    unsigned int here = 0;
    for (unsigned int node = 0; node < body.n_owned; ++node)
      here += body.serial_vertex[node] == vertex;
    if (Utilities::MPI::sum(here, communicator) == 0)
      throw InputError("the mesh has no cell with a vertex " + std::to_string(vertex) + ".");
  }


  void
  Session::require_vertices(const Hands &of_hands) const
  {
    for (const auto &[vertex, grab] : of_hands.grabs())
      for (const Pull::End &end : grab.ends)
        require_vertex(end.vertex);
    for (const auto &[vertex, path] : of_hands.holds())
      require_vertex(vertex);
  }


  void
  Session::require_free(const unsigned int vertex) const
  {
    const Problem &problem = simulation->present();
    unsigned int held      = 0;
    if (const auto own = own_nodes.find(vertex); own != own_nodes.end())
      for (unsigned int i = 0; i < 3; ++i)
        held += problem.constraints.holds(3 * own->second + i) &&
                !problem.body.is_held_by_nature(3 * own->second + i);
    if (Utilities::MPI::sum(held, communicator) > 0)
      throw InputError(Selection(problem.body).vertex_in_words(vertex) +
                       " is held or moved already by the scene.");
  }


  void
  Session::act(const std::string &deed)
  {
    // The run has the hands' own paths: those must stay where a deed can't be done.
    Hands trial = hands;
    if (trial.apply(deed, now().time()) == Hands::Effect::moves)
      hands.apply(deed, now().time());
    else
      {
        hands.swap(trial);
        try
          {
            require_vertices(hands);
            renew();
          }
        catch (const InputError &)
          {
            hands.swap(trial);
            throw;
          }
      }
    new_deeds.push_back({now().measurement().step, now().time(), deed, ""});
  }


  void
  Session::renew()
  {
    auto next                       = std::make_unique<Simulation>(present_scene(),
                                             simulation->present().shared_mesh,
                                             folder,
                                             true);
    const Simulation::Legacy legacy = simulation->leave();
    simulation.reset(); // it lets go of the folder
    simulation = std::move(next);
    simulation->go_on_from(legacy, guest);
    if (stop > 0.)
      simulation->stop_at(stop);
  }


  void
  Session::keep_deeds()
  {
    hands_before = hands;
    for (const Deed &deed : new_deeds)
      {
        done.push_back(deed);
        write_deed(deed);
      }
    new_deeds.clear();
  }


  void
  Session::write_grips()
  {
    const std::vector<Grip> all = grips();
    if (!grips_table || all.empty())
      return;
    std::vector<std::vector<double>> rows;
    for (const Grip &grip : all)
      {
        std::vector<double> row = {double(now().measurement().step),
                                   now().time(),
                                   double(grip.vertex),
                                   grip.holds ? 1. : 0.};
        for (const auto *vector : {&grip.target, &grip.place, &grip.force})
          for (unsigned int i = 0; i < 3; ++i)
            row.push_back((*vector)[i]);
        rows.push_back(row);
      }
    grips_table->write_rows(rows);
  }


  bool
  Session::step()
  {
    const bool goes_on = simulation->step();
    keep_deeds();
    write_grips();
    return goes_on;
  }


  bool
  Session::try_step()
  {
    try
      {
        const bool goes_on = simulation->advance();
        keep_deeds();
        write_grips();
        return goes_on;
      }
    catch (const InterruptedError &)
      {
        throw;
      }
    catch (const ComputationError &)
      {
        // SUNDIALS remembers the failure: another run goes on.
        hands = hands_before;
        new_deeds.clear();
        act("renew");
        throw;
      }
  }


  void
  Session::stop_at(const double time)
  {
    stop = time;
    simulation->stop_at(time);
  }


  void
  Session::end()
  {
    keep_deeds();
    new_deeds.push_back({now().measurement().step, now().time(), end_of_motion, ""});
    keep_deeds();
    simulation->end();
  }


  void
  Session::interrupt()
  {
    keep_deeds();
    simulation->interrupt();
  }


  Tensor<1, 3>
  Session::value_at(const unsigned int vertex, const Vector &values) const
  {
    Tensor<1, 3> value;
    if (const auto own = own_nodes.find(vertex); own != own_nodes.end())
      for (unsigned int i = 0; i < 3; ++i)
        value[i] = values.local_element(3 * own->second + i);
    return Utilities::MPI::sum(value, communicator);
  }


  Point<3>
  Session::place_of(const unsigned int vertex) const
  {
    return Selection(now().present().body).place_of_vertex(vertex) +
           value_at(vertex, now().current_state().displacement);
  }


  std::vector<Session::Grip>
  Session::grips() const
  {
    const Body &body    = now().present().body;
    const Vector &u     = now().current_state().displacement;
    const double time   = now().time();
    const auto place_at = [&](const unsigned int node) {
      Tensor<1, 3> place = body.position(node);
      for (unsigned int i = 0; i < 3; ++i)
        place[i] += u.local_element(3 * node + i);
      return place;
    };

    // What this process knows of places and forces, six numbers each.
    std::vector<Grip> list;
    std::vector<double> here;
    const auto add = [&](const Grip &grip) {
      for (const auto *vector : {&grip.place, &grip.force})
        here.insert(here.end(), vector->begin_raw(), vector->end_raw());
      list.push_back(grip);
    };
    for (const auto &[vertex, grab] : hands.grabs())
      {
        Grip grip{vertex, false, grab.path->at(time), {}, {}, 0.};
        if (const auto own = own_nodes.find(vertex); own != own_nodes.end())
          grip.place = place_at(own->second);
        for (const Pull::End &end : grab.ends)
          {
            grip.stiffness += end.stiffness;
            if (const auto own = own_nodes.find(end.vertex); own != own_nodes.end())
              grip.force += end.stiffness * (grip.target + end.offset - place_at(own->second));
          }
        add(grip);
      }
    for (const auto &[vertex, path] : hands.holds())
      {
        Grip grip{vertex, true, path->at(time), {}, {}, 0.};
        if (const auto own = own_nodes.find(vertex); own != own_nodes.end())
          {
            grip.place = place_at(own->second);
            for (unsigned int i = 0; i < 3; ++i)
              grip.force[i] = now().reactions().local_element(3 * own->second + i);
          }
        add(grip);
      }
    if (list.empty())
      return list;

    std::vector<double> all(here.size());
    Utilities::MPI::sum(here, communicator, all);
    for (std::size_t g = 0; g < list.size(); ++g)
      for (unsigned int i = 0; i < 3; ++i)
        {
          list[g].place[i] = all[6 * g + i];
          list[g].force[i] = all[6 * g + 3 + i];
        }
    return list;
  }


  std::string
  Session::grab(const unsigned int vertex, const double radius, const double stiffness) const
  {
    constexpr double usual = 10.; // times that of the body

    require_vertex(vertex);
    const Problem &problem    = now().present();
    const Body &body          = problem.body;
    const Point<3> rest       = Selection(body).place_of_vertex(vertex);
    const Tensor<1, 3> centre = place_of(vertex);
    double k                  = stiffness;
    if (k == 0.)
      k = usual * stiffness_at(problem, vertex);
    if (!(k > 0.) || !std::isfinite(k))
      throw InputError("vertex " + std::to_string(vertex) + " can't be pulled: it is held.");

    // Of each vertex within the radius: index, stiffness and offset.
    std::vector<double> own;
    for (unsigned int node = 0; node < body.n_owned; ++node)
      {
        const double distance = body.position(node).distance(rest);
        if (body.serial_vertex[node] != vertex && !(distance < radius))
          continue;
        const double part   = radius > 0. ? 1. - distance * distance / (radius * radius) : 1.;
        Tensor<1, 3> offset = body.position(node) - centre;
        for (unsigned int i = 0; i < 3; ++i)
          offset[i] += now().current_state().displacement.local_element(3 * node + i);
        if (body.serial_vertex[node] == vertex)
          offset = 0.;
        own.insert(
          own.end(),
          {double(body.serial_vertex[node]), k * part * part, offset[0], offset[1], offset[2]});
      }
    std::vector<std::array<double, 5>> ends;
    for (const std::vector<double> &of_process : Utilities::MPI::all_gather(communicator, own))
      for (std::size_t at = 0; at < of_process.size(); at += 5)
        ends.push_back({{of_process[at],
                         of_process[at + 1],
                         of_process[at + 2],
                         of_process[at + 3],
                         of_process[at + 4]}});
    std::sort(ends.begin(), ends.end());
    std::string text = "grab " + std::to_string(vertex) + " " + in_words(centre) + " by ";
    for (const auto &end : ends)
      {
        text += (&end == &ends.front() ? "" : ", ") + std::to_string(std::lround(end[0]));
        for (unsigned int i = 1; i < 5; ++i)
          text += " " + digits(end[i], all_digits);
      }
    return text;
  }


  std::string
  Session::hold(const unsigned int vertex) const
  {
    require_vertex(vertex);
    return "hold " + std::to_string(vertex) + " " + in_words(place_of(vertex));
  }


  std::string
  Session::take(const std::string &tool) const
  {
    if (hands.has_taken(tool))
      return "";
    if (const Contact *const contact = now().present().forces.contact())
      for (const Tool &known : contact->all_tools())
        if (known.parameters.name == tool)
          return "take " + tool + " " + in_words(known.pose(now().time()).place);
    throw InputError("there is no tool " + tool + " in this scene.");
  }
} // namespace Supple
