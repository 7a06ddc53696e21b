#include <supple/run/simulation.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>
#include <supple/base/text.h>
#include <supple/run/chosen_vertices.h>
#include <supple/time/create_integrator.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** That the mesh was refined as often as was allowed, and not often enough; or empty. */
    std::string
    missed_aim(const Parameters &scene, const std::optional<SpaceErrors> &errors)
    {
      const auto &pilots = scene.mesh.refinement.pilots;
      if (scene.space.aim == 0. || pilots.empty() || pilots.back().error <= scene.space.aim ||
          !errors)
        return "";
      double error = errors->of_work();
      for (const ProbeError &probe : errors->probes)
        if (probe.name == pilots.back().of)
          error = std::abs(probe.relative());
      if (error <= scene.space.aim)
        return "";
      return scene.origin("Space/Aim") + ": after " + std::to_string(pilots.size()) +
             " refinements the error of " + pilots.back().of + " is still about " +
             digits(100. * error, 2) + " %; " +
             (scene.mesh.refinement.end_of_pilots.empty()
                ? "Mesh/Refine allows no more of them."
                : "there can be no more of them. " + scene.mesh.refinement.end_of_pilots);
    }
  } // namespace


  Simulation::Simulation(const Parameters &scene,
                         const std::string &folder,
                         const bool quiet,
                         const MPI_Comm communicator)
    : Simulation(std::make_shared<Problem>(scene, communicator), folder, quiet)
  {
  }


  Simulation::Simulation(const Parameters &scene,
                         const std::shared_ptr<const Mesh> &mesh,
                         const std::string &folder,
                         const bool quiet)
    : Simulation(std::make_shared<Problem>(scene, mesh), folder, quiet)
  {
  }


  Simulation::Simulation(std::shared_ptr<Problem> of_scene,
                         const std::string &folder,
                         const bool quiet)
    : talks(!quiet && Utilities::MPI::this_mpi_process(of_scene->mesh.communicator) == 0)
    , own_problem(std::move(of_scene))
    , problem(*own_problem)
    , probes(problem.body,
             problem.parameters.probes,
             problem.parameters.motions,
             problem.parameters.file)
    , profiles(problem.body, problem.parameters.probes, problem.parameters.file)
    , integrator(create_integrator(problem.model()))
    , diagnostics(problem.configuration, problem.forces, problem.stationary)
    , second_run(make_second_run())
    , second_mesh(make_second_mesh())
    , pulses(problem.parameters, problem.time, problem.mesh.bounding_box)
    , start_displacement(problem.configuration.displacement())
    , results(folder, problem.parameters, problem.mesh.communicator)
    , interruption(problem.mesh.communicator)
    , progress(talks, Utilities::MPI::n_mpi_processes(problem.mesh.communicator) > 1)
  {
    course.setup_seconds = course.seconds_since_start();
  }


  std::unique_ptr<StepDoubling>
  Simulation::make_second_run()
  {
    if (!problem.parameters.time.estimate_error)
      return nullptr;
    const Parameters scene = StepDoubling::second_scene(problem.parameters);
    const auto third_run   = [this, scene, run = Companion::Run()](const double time) mutable {
      if (!run)
        run = other_run(StepDoubling::second_scene(scene), [this] {
          if (!interruption.after_step(observation()))
            throw ComputationError("it was interrupted");
        });
      return run(time);
    };
    return std::make_unique<StepDoubling>(problem.parameters.time,
                                          other_run(scene, [] {}),
                                          third_run,
                                          course.largest_motion);
  }


  std::unique_ptr<SecondMesh>
  Simulation::make_second_mesh()
  {
    const SecondMesh::Kind kind = problem.parameters.space.second_mesh;
    if (kind == SecondMesh::Kind::none)
      return nullptr;
    const std::string origin = problem.parameters.origin("Space/Second mesh");
    const auto run_of        = [this, &origin](const Parameters &scene) {
      try
        {
          return other_run(scene, [] {});
        }
      catch (const InputError &error)
        {
          throw InputError(origin + ": on the other mesh the scene is refused. " + error.what());
        }
    };
    const Parameters first  = with_chosen_vertices(problem.parameters);
    const Parameters second = SecondMesh::on_other_mesh(first, kind, origin);
    std::optional<SecondMesh::OtherRun> third;
    if (kind == SecondMesh::Kind::coarser)
      try
        {
          third = {run_of(SecondMesh::on_other_mesh(second, kind, origin)),
                   SecondMesh::shared_vertices(second, kind, problem.body)};
        }
      catch (const InputError &)
        {
          // then there are two meshes, and the order is assumed
        }
    const SecondMesh::OtherRun second_run{run_of(second),
                                          SecondMesh::shared_vertices(first, kind, problem.body)};
    return std::make_unique<SecondMesh>(
      problem.body, probes, kind, second_run, third, course.largest_motion);
  }


  Companion::Run
  Simulation::other_run(const Parameters &scene, const std::function<void()> &after_step) const
  {
    const auto other = std::make_shared<Simulation>(scene, "", true, problem.mesh.communicator);
    return [other, after_step](const double time) {
      while (other->time() < time * (1. - 1e-12) && !other->finished())
        {
          other->advance();
          after_step();
        }
      return Companion::Arrival{other->time(),
                                other->problem.body,
                                other->current_state().displacement};
    };
  }


  std::unique_ptr<SpaceEstimate>
  Simulation::make_space_estimate()
  {
    if (!observed || problem.parameters.space.estimate == SpaceParameters::Estimate::never)
      return nullptr;
    return std::make_unique<SpaceEstimate>(problem,
                                           *integrator,
                                           probes,
                                           [this](const Measurement &now) {
                                             return frames && frames->written().due(now);
                                           });
  }


  std::unique_ptr<CellIndicators>
  Simulation::make_indicators(const std::string &quantity)
  {
    return std::make_unique<CellIndicators>(problem, *integrator, probes, quantity);
  }


  Parameters
  Simulation::with_chosen_vertices(const Parameters &scene) const
  {
    return Supple::with_chosen_vertices(scene, problem.body);
  }


  void
  Simulation::check()
  {
    observe(0, StepReport());
    if (talks)
      description().print(true);
  }


  void
  Simulation::add_listeners(Listener *const guest)
  {
    const Parameters &parameters = problem.parameters;
    Effort &effort               = problem.effort;
    const bool history           = results.writes_history;
    observed                     = history || results.writes_frames || guest;
    probed                       = !probes.empty() && (history || guest);
    Diagnostics *const asked     = observed ? &diagnostics : nullptr;
    space                        = make_space_estimate();

    const bool of_frames = space && parameters.space.estimate == SpaceParameters::Estimate::frames;
    const SpaceEstimate *const space_of_frames = of_frames ? space.get() : nullptr;

    listeners.add(space.get());
    listeners.add(results.add<ProfileTables>(
      history && !profiles.empty(), effort, profiles, parameters.probes.profile_every));
    listeners.add(
      results.add<HistoryTable>(history, effort, parameters.has_contact(), space_of_frames));
    listeners.add(
      results.add<ToolTables>(history && !parameters.tools.empty(), effort, parameters.tools));
    listeners.add(results.add<ProbeTable>(history && !probes.empty(), effort, probes));
    listeners.add(frames = results.add<FrameWriter>(results.writes_frames,
                                                    effort,
                                                    problem.configuration,
                                                    problem.forces,
                                                    parameters.output,
                                                    space ? &space->of_cells() : nullptr,
                                                    of_frames));
    listeners.add(&pulses);
    listeners.add(guest);
    listeners.add(second_run.get());
    listeners.add(second_mesh.get());
    listeners.add(results.add<ErrorTable>(
      history && (second_run || second_mesh), effort, second_run.get(), second_mesh.get()));
    listeners.add(
      checkpoints =
        results.add<Checkpoints>(results.writes, problem, *integrator, asked, course, listeners));
    listeners.add(&interruption);
  }


  void
  Simulation::run(Listener *const guest)
  {
    begin(guest);
    while (!finished())
      {
        const bool goes_on = step();
        progress.update(course.now.step, course.now.time / integrator->end);
        if (!goes_on && !finished())
          interrupt();
      }
    end();
  }


  void
  Simulation::begin(Listener *const guest)
  {
    add_listeners(guest);
    results.lock_folder();
    if (checkpoints)
      checkpoints->resume();
    if (!course.resumed())
      measure(0, StepReport());
    open();
  }


  void
  Simulation::open()
  {
    results.open(course.resumed(), course.now.step);
    warnings_told = description().warnings();
    if (talks)
      description().print(false);
    tell_failures([this] {
      listeners.begin(observation(), course.resumed());
      return true;
    });
  }


  bool
  Simulation::step()
  {
    return tell_failures([this] { return advance(); });
  }


  void
  Simulation::end()
  {
    tell_failures([this] {
      finish("done");
      return true;
    });
  }


  bool
  Simulation::tell_failures(const std::function<bool()> &action)
  {
    try
      {
        return action();
      }
    catch (const InterruptedError &)
      {
        throw;
      }
    catch (const ComputationError &error)
      {
        fail(error.what());
      }
    catch (const WriteError &error)
      {
        throw WriteError("After step " + std::to_string(course.now.step) + ": " + error.what());
      }
  }


  Simulation::Legacy
  Simulation::leave()
  {
    if (refused)
      diagnostics.forget_last_step();
    nlohmann::json kept = nlohmann::json::object();
    listeners.save(kept);
    nlohmann::json rest = {{"course", course.save()},
                           {"cells", problem.configuration.save_cells()},
                           {"listeners", kept}};
    if (observed)
      rest["diagnostics"] = diagnostics.save();
    std::string packed;
    nlohmann::json::to_cbor(rest, packed);
    std::vector<Vector> vectors;
    for (const Vector *const vector : listeners.kept_vectors())
      vectors.push_back(*vector);
    // of the cells the first process alone knows all
    return {problem.shared_mesh,
            problem.configuration.state,
            course.now.time,
            problem.effort,
            integrator->reactions(),
            vectors,
            Utilities::MPI::broadcast(problem.mesh.communicator, packed)};
  }


  void
  Simulation::go_on_from(const Legacy &legacy, Listener *const guest)
  {
    const nlohmann::json rest = nlohmann::json::from_cbor(legacy.rest);
    add_listeners(guest);
    results.lock_folder();
    course.load(rest.at("course"));
    course.origin               = "step " + std::to_string(course.now.step);
    problem.effort              = legacy.effort;
    problem.configuration.state = legacy.state;
    try
      {
        problem.configuration.load_cells(rest.at("cells"), problem.effort);
      }
    catch (const std::out_of_range &)
      {
        throw InputError("the cells remember other things than this scene asks for");
      }
    integrator->begin_at(legacy.time);
    integrator->recall_reactions(legacy.reactions);
    listeners.load(rest.at("listeners"));
    const std::vector<Vector *> kept = listeners.kept_vectors();
    for (std::size_t k = 0; k < kept.size(); ++k)
      *kept[k] = legacy.kept[k];
    if (observed)
      {
        diagnostics.load(rest.at("diagnostics"));
        diagnostics.book_change(legacy.time);
      }
    open();
  }


  bool
  Simulation::advance()
  {
    const StepReport report = integrator->advance(observed);
    measure(course.now.step + 1, report);
    course.error_estimate += report.local_error;
    course.largest_motion =
      std::max(course.largest_motion,
               largest_vertex_distance(problem.configuration.displacement(), start_displacement));
    return listeners.after_step(observation());
  }


  bool
  Simulation::finished() const
  {
    return integrator->finished();
  }


  std::vector<std::vector<double>>
  Simulation::profile(const std::string &name) const
  {
    return profiles.rows(profiles.number(name),
                         course.now.step,
                         course.now.time,
                         problem.configuration.displacement());
  }


  Observation
  Simulation::observation() const
  {
    return {course.now, probes_now, problem.configuration.state, finished()};
  }


  Description
  Simulation::description() const
  {
    return {problem, *integrator, probes, diagnostics, course, pulses};
  }


  void
  Simulation::measure(const unsigned int after_step, const StepReport &report)
  {
    if (observed)
      observe(after_step, report);
    problem.configuration.accept();
    course.now.step = after_step;
    course.now.time = report.time;
  }


  void
  Simulation::observe(const unsigned int after_step, const StepReport &report)
  {
    const PhaseTimer timer(problem.effort, Phase::diagnostics);
    const Measurement next  = diagnostics.measure(after_step, report.time, own_seconds(), report);
    probes_now              = probe_values(next);
    const std::string wrong = objection(next);
    if (!wrong.empty())
      refuse(wrong, next);
    course.now = next;
  }


  double
  Simulation::own_seconds() const
  {
    return course.seconds() - (second_run ? second_run->seconds() : 0.) -
           (second_mesh ? second_mesh->seconds() : 0.) - (space ? space->seconds : 0.);
  }


  std::vector<double>
  Simulation::probe_values(const Measurement &next) const
  {
    std::vector<double> row = {double(next.step), next.time};
    if (probed)
      {
        const auto values = probes.values(problem.configuration.state, integrator->reactions());
        row.insert(row.end(), values.begin(), values.end());
      }
    return row;
  }


  std::string
  Simulation::objection(const Measurement &next) const
  {
    const std::string columns = next.not_finite();
    if (!columns.empty())
      return "energies are no finite numbers any more (in history.csv: " + columns + ")";
    const bool here = std::all_of(probes_now.begin(), probes_now.end(), [](const double value) {
      return std::isfinite(value);
    });
    if (Utilities::MPI::min(here ? 1 : 0, problem.mesh.communicator) == 0)
      return "the values of the probes are no finite numbers any more";
    return listeners.objection({next, probes_now, problem.configuration.state, finished()});
  }


  void
  Simulation::refuse(const std::string &what, const Measurement &next)
  {
    if (next.step > 0)
      {
        problem.configuration.reject(problem.effort);
        refused = true;
        throw ComputationError(what);
      }
    const Parameters &parameters = problem.parameters;
    const bool by_velocity       = std::isfinite(next.elastic) && !(next.kinetic <= next.elastic);
    const std::string entry      = by_velocity ? "Start/Velocity" : "Start/Displacement";
    const std::string value =
      by_velocity ? parameters.start.velocity : parameters.start.displacement;
    const bool moved =
      problem.constraints.move() && Expression(value, 3, parameters.origin(entry)).is_zero();
    throw InputError(
      (moved ? "A displacement of subsection Motion at time 0" : parameters.origin(entry)) +
      ": it is too large: at the start " + what + ". The body is of " + problem.mesh.extent() +
      " m.");
  }


  void
  Simulation::interrupt()
  {
    listeners.interrupted(observation());
    finish("interrupted");
    throw InterruptedError("Interrupted after step " + std::to_string(course.now.step) + "." +
                           results.whereabouts("so far"));
  }


  void
  Simulation::fail(const std::string &why)
  {
    std::ostringstream time, text;
    time << (problem.stationary ? "load factor " : "time ") << course.now.time;
    text << "Step " << course.now.step + 1 << " (from " << time.str() << " on) failed: " << why
         << "." << results.whereabouts("up to " + time.str());
    finish("failed: " + text.str());
    throw ComputationError(text.str());
  }


  void
  Simulation::finish(const std::string &status)
  {
    progress.clear();
    listeners.end(observation());
    last_summary.emplace(summarize(status));
    results.write_end(*last_summary, frames ? frames->written().surface_film() : nullptr, problem);
    if (talks && status == "done")
      print_result(*last_summary, results.folder, results.report_file(), warnings_told);
  }


  Summary
  Simulation::summarize(const std::string &status)
  {
    const double seconds = own_seconds();
    Summary summary(problem.parameters, problem.model());
    summary.status           = status;
    summary.warnings         = description().warnings();
    summary.integrator       = integrator->name();
    summary.stable_step      = integrator->stable_step();
    summary.steps            = course.now.step;
    summary.setup_seconds    = course.setup_seconds;
    summary.run_seconds      = seconds;
    summary.estimate_seconds = space ? space->seconds : 0.;
    summary.error_estimate   = course.error_estimate;
    // Formulas of first order are embedded in these: their errors say nothing of the run's.
    const TimeMethod method     = problem.parameters.time.method;
    summary.local_errors_add_up = method != TimeMethod::sdirk2 && method != TimeMethod::explicit2;
    summary.largest_motion      = course.largest_motion;
    summary.step_doubling       = second_run.get();
    summary.second_mesh         = second_mesh.get();
    if (space)
      summary.space_errors = space->at_the_end();
    if (summary.space_errors)
      for (const std::string &text : summary.space_errors->warnings())
        summary.warnings.push_back(text);
    const std::string missed = missed_aim(problem.parameters, summary.space_errors);
    if (!missed.empty())
      summary.warnings.push_back(missed);
    summary.frames     = frames ? frames->written().n_written() : 0;
    summary.history    = results.writes_history;
    summary.probes     = results.writes_history && !probes.empty();
    summary.observed   = observed;
    summary.has_energy = problem.forces.have_energy();
    summary.last       = course.now;
    summary.extremes   = diagnostics.extremes();
    return summary;
  }
} // namespace Supple
