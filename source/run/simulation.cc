#include <supple/base/error.h>
#include <supple/base/expression.h>
#include <supple/base/files.h>
#include <supple/base/interrupt.h>
#include <supple/report/report.h>
#include <supple/run/simulation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/physics/transformations.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <sstream>

namespace Supple
{
  using namespace dealii;

  Simulation::Simulation(const Parameters &scene,
                         const std::string &folder,
                         const bool quiet,
                         const MPI_Comm communicator)
    : parameters(scene)
    , folder(folder)
    , communicator(communicator)
    , stationary(parameters.time.problem == TimeParameters::Problem::stationary)
    , talks(!quiet && Utilities::MPI::this_mpi_process(communicator) == 0)
    , writes_history(!folder.empty() && parameters.output.history)
    , writes_frames(!folder.empty() && parameters.output.frames != OutputParameters::Frames::none)
    , writes_report(parameters.output.report && (writes_history || writes_frames))
    , start(std::chrono::steady_clock::now())
    , mesh(parameters, communicator)
    , body(mesh, parameters)
    , constraints(body, parameters)
    , loads(body, parameters)
    , probes(body, parameters)
    , profiles(body, parameters)
    , implicit_operator(body, constraints, parameters, effort)
    , solver(LinearSolver::create(implicit_operator, parameters, effort))
    , diagnostics(body, loads, stationary)
    , progress(talks, Utilities::MPI::n_mpi_processes(communicator) > 1)
    , checkpoint(body, parameters, folder)
  {
    const std::string free_pieces = constraints.free_pieces_in_words();
    if (stationary && !free_pieces.empty())
      throw InputError("A static scene needs a body that is held: " + free_pieces);
    if (stationary && constraints.n_free_rigid_motions > 0)
      throw InputError("A static scene needs a body that is held: " + free_rigid_motions() +
                       ", so that the stiffness is singular. Hold a boundary or a region "
                       "(subsection Constraints), or make the problem dynamic.");
    create_initial_state();
    integrator         = create_integrator(model(), state.block(0));
    start_displacement = state.block(0);
    if (parameters.time.estimate_error)
      create_step_doubling();
    setup_seconds = seconds_since_start();
  }


  void
  Simulation::create_step_doubling()
  {
    const auto second =
      std::make_shared<Simulation>(StepDoubling::second_scene(parameters), "", true, communicator);
    step_doubling = std::make_unique<StepDoubling>(parameters.time, [second](const double time) {
      while (second->time() < time * (1. - 1e-12) && !second->finished())
        second->advance();
      return StepDoubling::Arrival{second->time(), second->current_state()};
    });
  }


  Model
  Simulation::model()
  {
    return {body, constraints, loads, implicit_operator, *solver, parameters, effort};
  }


  double
  Simulation::seconds_since_start() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }


  double
  Simulation::seconds_of_run() const
  {
    return seconds_before + seconds_since_start() - setup_seconds;
  }


  void
  Simulation::turn(Vector &displacement) const
  {
    const double degrees = parameters.start.rotation.norm();
    if (degrees == 0.)
      return;
    const auto R =
      Physics::Transformations::Rotations::rotation_matrix_3d(parameters.start.rotation / degrees,
                                                              degrees * numbers::PI / 180.);
    for (unsigned int node = 0; node < body.n_owned; ++node)
      {
        const Tensor<1, 3> arm = body.position(node) - parameters.start.rotation_center;
        const Tensor<1, 3> u   = R * arm - arm;
        for (unsigned int i = 0; i < 3; ++i)
          displacement.local_element(3 * node + i) = u[i];
      }
  }


  /** A static problem has no velocity, so its state has one block only. */
  void
  Simulation::create_initial_state()
  {
    state.reinit(stationary ? 1 : 2);
    for (unsigned int b = 0; b < state.n_blocks(); ++b)
      body.initialize(state.block(b));
    state.collect_sizes();

    const std::array<std::pair<const char *, std::string>, 2> starts = {
      {{"Start/Displacement", parameters.start.displacement},
       {"Start/Velocity", parameters.start.velocity}}};
    turn(state.block(0));
    for (unsigned int b = 0; b < state.n_blocks(); ++b)
      {
        const Expression expression(starts[b].second, 3, parameters.origin(starts[b].first));
        for (unsigned int node = 0; node < body.n_owned && !expression.is_zero(); ++node)
          for (unsigned int i = 0; i < 3; ++i)
            state.block(b).local_element(3 * node + i) +=
              expression.value(body.position(node), 0., i);
        constraints.set_zero(state.block(b));
        if (!all_finite(state.block(b)))
          throw InputError(parameters.origin(starts[b].first) +
                           ": it is not a finite number at every vertex.");
      }
    if (constraints.move())
      {
        constraints.set_displacement(state.block(0), 0.);
        if (!stationary)
          constraints.set_velocity(state.block(1), 0., parameters.time.derivative_interval());
        for (unsigned int b = 0; b < state.n_blocks(); ++b)
          if (!all_finite(state.block(b)))
            throw InputError(std::string("A displacement of subsection Motion ") +
                             (b == 0 ? "is not a finite number" : "has no finite derivative") +
                             " at time 0.");
      }
  }


  void
  Simulation::open_output()
  {
    if (folder.empty())
      return;
    prepare_output_folder(folder, communicator, [&] {
      std::filesystem::create_directories(folder + (writes_frames ? "/solution" : ""));
      if (!resumed)
        clear_results();
      if (!resumed || (frames && frames->n_written() == 0))
        clear_frames();
      std::ostringstream used;
      parameters.print(used);
      write_whole_file(folder + "/parameters.prm", used.str());
      if (writes_history)
        open_tables();
    });
  }


  void
  Simulation::clear_results() const
  {
    namespace fs = std::filesystem;
    for (const char *name : {"history.csv",
                             "probes.csv",
                             "error.csv",
                             "summary.json",
                             "report.html",
                             "checkpoint.cbor",
                             "checkpoint.previous.cbor"})
      fs::remove(fs::path(folder) / name);
    for (const auto &entry : fs::directory_iterator(folder))
      if (entry.path().filename().string().rfind("profile_", 0) == 0 &&
          entry.path().extension() == ".csv")
        fs::remove(entry.path());
  }


  void
  Simulation::clear_frames() const
  {
    namespace fs = std::filesystem;
    for (const char *name : {"solution.pvd", "report.frames"})
      fs::remove(fs::path(folder) / name);
    if (fs::is_directory(fs::path(folder) / "solution"))
      for (const auto &entry : fs::directory_iterator(fs::path(folder) / "solution"))
        if (entry.path().filename().string().rfind("frame_", 0) == 0)
          fs::remove(entry.path()); // of an earlier run
  }


  void
  Simulation::open_tables()
  {
    const auto open = [&](const std::string &name, const std::vector<std::string> &columns) {
      const std::string file = folder + "/" + name;
      return resumed ? std::make_unique<CsvFile>(file, step + 1)
                     : std::make_unique<CsvFile>(file, columns);
    };
    profiles.open(folder, resumed);
    history = open("history.csv", Measurement::column_names());
    if (!probes.empty())
      probe_history = open("probes.csv", probes.column_names());
    if (step_doubling)
      error_history = std::make_unique<CsvFile>(folder + "/error.csv",
                                                std::vector<std::string>{"step", "time", "error"});
  }


  std::vector<Vector *>
  Simulation::kept_vectors()
  {
    std::vector<Vector *> vectors;
    for (unsigned int b = 0; b < state.n_blocks(); ++b)
      vectors.push_back(&state.block(b));
    if (frames)
      vectors.push_back(&frames->displacement_of_last());
    return vectors;
  }


  void
  Simulation::resume()
  {
    if (!parameters.checkpoint.resume || folder.empty())
      return;
    const auto saved = checkpoint.read(kept_vectors(), state.n_blocks());
    if (!saved)
      return;
    try
      {
        load(*saved);
      }
    catch (const nlohmann::json::exception &)
      {
        checkpoint.refuse_content();
      }
    resumed      = true;
    steps_before = step;
    body.update_rotations(state.block(0), effort);
  }


  void
  Simulation::load(const nlohmann::json &saved)
  {
    step     = saved.at("step");
    now.step = step;
    now.time = saved.at("time");
    // What is no number is written as null.
    const auto &local_errors = saved.at("error_estimate");
    error_estimate           = local_errors.is_null() ? NAN : local_errors.get<double>();
    largest_motion           = saved.at("largest_motion");
    seconds_before           = saved.at("seconds");
    integrator->load(saved.at("integrator"));
    if (observed && !saved.contains("diagnostics"))
      throw InputError(parameters.origin("Output/History") +
                       ": the run to go on from measured no energies, for it wrote neither a "
                       "history nor frames. Set Output/History = false and Output/Frames = none "
                       "as there, or Checkpoint/Resume = never to begin anew.");
    if (observed)
      diagnostics.load(saved.at("diagnostics"));
    if (frames && saved.contains("frames"))
      frames->load(saved.at("frames"));
    else if (saved.contains("frames"))
      earlier_frames = saved.at("frames").dump();
    profiles.load(saved.at("profiles"));
  }


  void
  Simulation::write_checkpoint()
  {
    const PhaseTimer timer(effort, Phase::output);
    nlohmann::json rest = {{"step", step},
                           {"time", now.time},
                           {"error_estimate", error_estimate},
                           {"largest_motion", largest_motion},
                           {"seconds", seconds_of_run()},
                           {"integrator", integrator->save()},
                           {"profiles", profiles.save()}};
    if (observed)
      rest["diagnostics"] = diagnostics.save();
    if (frames)
      rest["frames"] = frames->save();
    else if (!earlier_frames.empty())
      rest["frames"] = nlohmann::json::parse(earlier_frames);
    implicit_operator.forget(); // as a run that goes on from here
    solver->forget();
    const auto vectors = kept_vectors();
    checkpoint.write(step, {vectors.begin(), vectors.end()}, rest);
  }


  void
  Simulation::run(const Observer &watching)
  {
    observer = watching;
    observed = writes_history || writes_frames || observer;
    if (!folder.empty() && writes_frames)
      frames = std::make_unique<Frames>(body, parameters.output, folder);
    resume();
    if (!resumed)
      measure(0, StepReport());
    open_output();
    warnings_told = warnings();
    print_description(false);
    try
      {
        if (!resumed)
          record();
        else if (frames && frames->n_written() == 0 && frames->can_hold(state))
          frames->write(state, now);
        time_loop();
      }
    catch (const InterruptedError &)
      {
        throw;
      }
    catch (const ComputationError &error)
      {
        progress.clear();
        const std::string axis = stationary ? "load factor " : "time ";
        std::ostringstream time, text;
        time << axis << now.time;
        text << "Step " << step + 1 << " (from " << time.str() << " on) failed: " << error.what()
             << "." << where_results_are("up to " + time.str());
        finish("failed: " + text.str());
        throw ComputationError(text.str());
      }
    catch (const WriteError &error)
      {
        throw WriteError("After step " + std::to_string(step) + ": " + error.what());
      }
  }


  void
  Simulation::time_loop()
  {
    const InterruptGuard interrupt;
    while (!finished())
      {
        advance();
        progress.update(step, now.time / integrator->end);
        if (parameters.checkpoint.wanted() && !folder.empty() && checkpoint.due(step))
          write_checkpoint();
        if (!finished() && interrupt.requested(communicator))
          {
            progress.clear();
            // The operator forgets at a checkpoint. Where its cells keep their warp and checkpoints
            // are due after steps, only at these an uninterrupted run forgets too.
            const bool repeats =
              parameters.corotation.warp_tolerance > 0. && parameters.checkpoint.minutes == 0.;
            if (parameters.checkpoint.wanted() && !folder.empty() && !repeats)
              write_checkpoint();
            finish("interrupted");
            throw InterruptedError("Interrupted after step " + std::to_string(step) + "." +
                                   where_results_are("so far"));
          }
      }
    progress.clear();
    finish("done");
  }


  bool
  Simulation::finished() const
  {
    return integrator->finished();
  }


  void
  Simulation::advance()
  {
    if (observed)
      before = state;
    const StepReport report = integrator->advance(state, observed);
    measure(step + 1, report);
    error_estimate += report.local_error;
    largest_motion =
      std::max(largest_motion, largest_vertex_distance(state.block(0), start_displacement));
    record();
    if (step_doubling)
      estimate_error();
  }


  std::vector<double>
  Simulation::probe_values(const Measurement &measurement) const
  {
    std::vector<double> row = {double(measurement.step), measurement.time};
    if (!probes.empty() && (writes_history || observer))
      {
        const auto values = probes.values(state, integrator->reactions());
        row.insert(row.end(), values.begin(), values.end());
      }
    return row;
  }


  void
  Simulation::measure(const unsigned int after_step, const StepReport &report)
  {
    const double time = after_step == 0 ? 0. : report.time;
    if (observed)
      {
        const PhaseTimer timer(effort, Phase::diagnostics);
        const double seconds    = seconds_of_run() - (step_doubling ? step_doubling->seconds : 0.);
        const Measurement next  = diagnostics.measure(after_step, time, seconds, state, report);
        probes_now              = probe_values(next);
        const std::string wrong = what_is_not_finite(next);
        if (!wrong.empty())
          refuse(wrong, next);
        now            = next;
        largest_energy = std::max(largest_energy, now.kinetic + now.elastic);
      }
    now.step = step = after_step;
    now.time        = time;
  }


  std::string
  Simulation::what_is_not_finite(const Measurement &next) const
  {
    const std::string columns = next.not_finite();
    if (!columns.empty())
      return "energies are no finite numbers any more (in history.csv: " + columns + ")";
    const bool here = std::all_of(probes_now.begin(), probes_now.end(), [](const double value) {
      return std::isfinite(value);
    });
    if (Utilities::MPI::min(here ? 1 : 0, communicator) == 0)
      return "the values of the probes are no finite numbers any more";
    if (frames && (frames->due(state, next) || finished()) && !frames->can_hold(state))
      return "the motion or its stress is larger than a frame can hold (3.4e38)";
    return "";
  }


  void
  Simulation::refuse(const std::string &what, const Measurement &next)
  {
    if (next.step > 0)
      {
        state = before;
        body.update_rotations(state.block(0), effort);
        throw ComputationError(what);
      }
    const bool by_velocity  = std::isfinite(next.elastic) && !(next.kinetic <= next.elastic);
    const std::string entry = by_velocity ? "Start/Velocity" : "Start/Displacement";
    const std::string value =
      by_velocity ? parameters.start.velocity : parameters.start.displacement;
    const bool moved =
      constraints.move() && Expression(value, 3, parameters.origin(entry)).is_zero();
    throw InputError(
      (moved ? "A displacement of subsection Motion at time 0" : parameters.origin(entry)) +
      ": it is too large: at the start " + what + ". The body is of " + mesh.extent() + " m.");
  }


  void
  Simulation::record()
  {
    if (!observed)
      return;
    {
      const PhaseTimer timer(effort, Phase::output);
      if (history)
        history->write_row(now.row());
      if (probe_history)
        probe_history->write_row(probes_now);
      if (writes_history)
        profiles.write(step, now.time, state.block(0), false);
      if (frames && frames->due(state, now))
        frames->write(state, now);
    }
    if (observer)
      observer({now, probes_now, state});
  }


  void
  Simulation::estimate_error()
  {
    const std::optional<double> error = step_doubling->follow(now.time, state);
    if (error && error_history)
      error_history->write_row({double(step), now.time, *error});
  }


  void
  Simulation::finish(const std::string &status)
  {
    if (writes_history)
      profiles.write(step, now.time, state.block(0), true);
    if (frames && frames->can_hold(state))
      {
        const PhaseTimer timer(effort, Phase::output);
        frames->write(state, now);
      }
    run_seconds = seconds_of_run();
    if (step_doubling)
      run_seconds -= step_doubling->seconds;
    last_summary.emplace(summarize(status));
    if (!folder.empty() && Utilities::MPI::this_mpi_process(communicator) == 0)
      {
        const nlohmann::ordered_json json = last_summary->to_json();
        write_whole_file(folder + "/summary.json", json.dump(2) + "\n");
        if (writes_report)
          write_page(json);
      }
    if (talks && status == "done")
      print_result();
  }


  void
  Simulation::write_page(const nlohmann::ordered_json &summary) const
  {
    const Film *const film = frames ? frames->surface_film() : nullptr;
    write_report(folder, parameters, summary, film);
    if (film && !parameters.checkpoint.wanted())
      film->remove(); // no run will go on from here
  }


  Summary
  Simulation::summarize(const std::string &status)
  {
    Summary summary(model(), state.block(0));
    summary.status         = status;
    summary.warnings       = warnings();
    summary.integrator     = integrator->name();
    summary.stable_step    = integrator->stable_step();
    summary.steps          = step;
    summary.setup_seconds  = setup_seconds;
    summary.run_seconds    = run_seconds;
    summary.error_estimate = error_estimate;
    summary.largest_motion = largest_motion;
    summary.step_doubling  = step_doubling.get();
    summary.frames         = frames ? frames->n_written() : 0;
    summary.history        = writes_history;
    summary.probes         = writes_history && !probes.empty();
    summary.observed       = observed;
    summary.last           = now;
    summary.extremes       = diagnostics.extremes();
    return summary;
  }
} // namespace Supple
