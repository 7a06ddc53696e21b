#include <supple/error.h>
#include <supple/expression.h>
#include <supple/interrupt.h>
#include <supple/simulation.h>
#include <supple/summary.h>

#include <deal.II/base/mpi.h>
#include <deal.II/physics/transformations.h>

#include <cmath>
#include <filesystem>
#include <iostream>
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
    , writes(parameters.output.history ||
             parameters.output.frames != OutputParameters::Frames::none)
    , start(std::chrono::steady_clock::now())
    , mesh(parameters, communicator)
    , body(mesh, parameters)
    , constraints(body, parameters)
    , loads(body, parameters)
    , probes(body, parameters)
    , implicit_operator(body, constraints, parameters, effort)
    , solver(LinearSolver::create(implicit_operator, parameters, effort))
    , diagnostics(body, loads, stationary)
    , progress(talks, Utilities::MPI::n_mpi_processes(communicator) > 1)
  {
    if (stationary && constraints.n_pieces_free > 0 && constraints.n_held > 0)
      throw InputError(
        "A static scene needs a body that is held: " + std::to_string(constraints.n_pieces_free) +
        " of its " + std::to_string(mesh.report.n_pieces) +
        " pieces, which do not hang together, are not held anywhere.");
    if (stationary && constraints.n_free_rigid_motions > 0)
      throw InputError("A static scene needs a body that is held: " +
                       std::to_string(constraints.n_free_rigid_motions) +
                       " of its six rigid motions are free, so that the stiffness is singular. "
                       "Hold a boundary or a "
                       "region (subsection Constraints), or make the problem dynamic.");
    create_initial_state();
    integrator         = TimeIntegrator::create(model(), state.block(0));
    start_displacement = state.block(0);
    setup_seconds      = seconds_since_start();
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


  namespace
  {
    void
    line(const std::string &name, const std::string &value)
    {
      std::cout << "  " << name << std::string(name.size() < 12 ? 12 - name.size() : 1, ' ')
                << value << '\n';
    }


    /** "0 (32), 1 (16)" */
    std::string
    counts(const std::map<unsigned int, unsigned int> &number_of)
    {
      std::string text;
      for (const auto &[id, n] : number_of)
        text += (text.empty() ? "" : ", ") + std::to_string(id) + " (" + std::to_string(n) + ")";
      return text;
    }
  } // namespace


  void
  Simulation::print_mesh_details() const
  {
    const MeshReport &report = mesh.report;
    std::ostringstream worst;
    worst << report.worst_quality << ", cell " << report.worst_cell << " at ("
          << report.worst_position << "); 1 is regular, 0 is flat";
    line("boundaries", counts(mesh.boundaries) + "; id (number of faces)");
    line("materials", counts(mesh.materials) + "; id (number of cells)");
    line("pieces", std::to_string(report.n_pieces));
    line("worst cell", worst.str());
    line("repaired", std::to_string(report.repaired) + " inverted cells");
    line("vertices",
         std::to_string(report.unused_vertices) + " in no cell, " +
           std::to_string(report.double_vertices) + " at the place of another");
  }


  std::vector<std::string>
  Simulation::warnings() const
  {
    std::vector<std::string> list = mesh.report.warnings;
    if (constraints.n_pieces_free > 0 && constraints.n_held > 0)
      list.push_back(std::to_string(constraints.n_pieces_free) + " of the " +
                     std::to_string(mesh.report.n_pieces) + " pieces are not held anywhere.");
    if (body.rotation == RotationMethod::gram_schmidt)
      list.push_back(
        "Gram-Schmidt rotations have no elastic energy: 'elastic' is the energy of the same "
        "formula, and "
        "'dissipated' need not grow. They depend on the axes.");
    double poisson = 0.;
    for (const auto &[id, n_cells] : mesh.materials)
      poisson = std::max(poisson, body.material(id).poisson());
    if (poisson > 0.45)
      {
        std::ostringstream text;
        text << "Linear tetrahedra are too stiff (they lock) at a Poisson ratio above 0.45; it is "
             << poisson << ".";
        list.push_back(text.str());
      }
    if (!stationary && parameters.time.method == TimeParameters::Method::ida &&
        parameters.time.maximum_order > 2)
      list.push_back(
        "Backward differentiation of an order above 2 (Time/Maximum order) is not "
        "stable for oscillations that hardly decay: these may grow without bounds.");
    if (!energy_from_nowhere().empty())
      list.push_back(energy_from_nowhere());
    return list;
  }


  std::string
  Simulation::energy_from_nowhere() const
  {
    if (-now.dissipated <= 0.2 * largest_energy || body.rotation == RotationMethod::gram_schmidt)
      return "";
    std::ostringstream text;
    text << "The time stepping added " << -now.dissipated << " J to a motion of at most "
         << largest_energy
         << " J: it is not to be trusted. Take shorter steps, variable steps or another method.";
    return text.str();
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
  Simulation::print_description(const bool in_detail) const
  {
    if (!talks)
      return;
    std::ostringstream time;
    time << integrator->name() << ", ";
    if (stationary)
      time << parameters.time.n_steps << " load steps";
    else if (parameters.time.has_variable_steps())
      time << "up to " << integrator->end << " s, relative tolerance "
           << parameters.time.relative_tolerance;
    else
      time << parameters.time.n_steps << " steps of " << parameters.time.step << " s";
    const std::array<const char *, 3> rotations = {
      {"linear elasticity", "corotational, Gram-Schmidt", "corotational, polar"}};
    std::ostringstream volume;
    volume << mesh.volume;

    std::cout << "Supple " << SUPPLE_VERSION << ", scene " << parameters.scene_name << '\n';
    line("body",
         std::to_string(mesh.n_cells) + " tetrahedra, " + std::to_string(mesh.n_vertices) +
           " vertices in " + mesh.extent() + " m, " + volume.str() + " m^3");
    if (in_detail)
      print_mesh_details();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    line("unknowns",
         std::to_string(body.dof_handler.n_dofs()) + ", of which " +
           std::to_string(constraints.n_held) + " are held; " +
           (n_ranks == 1 ? "1 process" : std::to_string(n_ranks) + " processes"));
    line("model", rotations[static_cast<unsigned int>(body.rotation)]);
    line("time", time.str());
    if (const auto stable = integrator->stable_step())
      line("stable step", "up to " + stable->description());
    line("solver", solver->name() + " (" + solver->reason + ")");
    for (const std::string &text : probes.descriptions())
      line("probe", text);
    for (const std::string &text : warnings())
      line("warning", text);
    std::cout << std::flush;
  }


  void
  Simulation::open_output()
  {
    const bool root = Utilities::MPI::this_mpi_process(communicator) == 0;
    std::string problem;
    if (root)
      try
        {
          namespace fs = std::filesystem;
          fs::create_directories(fs::path(folder) / "solution");
          for (const char *name : {"solution.pvd", "history.csv", "probes.csv", "summary.json"})
            fs::remove(fs::path(folder) / name);
          for (const auto &entry : fs::directory_iterator(fs::path(folder) / "solution"))
            if (entry.path().filename().string().rfind("frame_", 0) == 0)
              fs::remove(entry.path()); // of an earlier run
          std::ostringstream used;
          parameters.print(used);
          write_whole_file(folder + "/parameters.prm", used.str());
          if (parameters.output.history)
            {
              history =
                std::make_unique<CsvFile>(folder + "/history.csv", Measurement::column_names());
              if (!probes.empty())
                probe_history =
                  std::make_unique<CsvFile>(folder + "/probes.csv", probes.column_names());
            }
        }
      catch (const std::exception &exception)
        {
          problem = "The output folder " + folder + " can't be written (" + exception.what() +
                    "). Name another one with --output.";
        }
    problem = Utilities::MPI::broadcast(communicator, problem);
    if (!problem.empty())
      throw InputError(problem);
    if (parameters.output.frames != OutputParameters::Frames::none)
      frames = std::make_unique<Frames>(body, parameters.output, folder);
  }


  void
  Simulation::run()
  {
    open_output();
    print_description(false);
    try
      {
        record(StepReport());
        time_loop();
      }
    catch (const InterruptedError &)
      {
        throw;
      }
    catch (const ComputationError &error)
      {
        progress.clear();
        const std::string time = stationary ? "load factor " : "time ";
        std::ostringstream text;
        text << "Step " << step + 1 << " (from " << time << now.time
             << " on) failed: " << error.what() << ". The results up to " << time << now.time
             << " are in " << folder << ".";
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
    while (!integrator->finished())
      {
        advance();
        progress.update(step, now.time / integrator->end);
        if (!integrator->finished() && interrupt.requested(communicator))
          {
            progress.clear();
            finish("interrupted");
            throw InterruptedError("Interrupted after step " + std::to_string(step) +
                                   "; the results so far are in " + folder + ".");
          }
      }
    progress.clear();
    finish("done");
  }


  void
  Simulation::advance()
  {
    const StepReport report = integrator->advance(state, writes);
    ++step;
    now.step = step;
    now.time = report.time;
    error_estimate += report.local_error;
    largest_motion =
      std::max(largest_motion, largest_vertex_distance(state.block(0), start_displacement));
    record(report);
  }


  void
  Simulation::record(const StepReport &report)
  {
    if (!writes)
      return;
    {
      const PhaseTimer timer(effort, Phase::diagnostics);
      now =
        diagnostics.measure(step, now.time, seconds_since_start() - setup_seconds, state, report);
      largest_energy = std::max(largest_energy, now.kinetic + now.elastic);
    }
    const PhaseTimer timer(effort, Phase::output);
    if (history)
      history->write_row(now.row());
    if (parameters.output.history && !probes.empty())
      {
        std::vector<double> row = {double(step), now.time};
        const auto values       = probes.values(state, integrator->reactions());
        row.insert(row.end(), values.begin(), values.end());
        if (probe_history)
          probe_history->write_row(row);
      }
    if (frames && frames->due(state, now))
      frames->write(state, now);
  }


  void
  Simulation::finish(const std::string &status)
  {
    if (frames)
      {
        const PhaseTimer timer(effort, Phase::output);
        frames->write(state, now);
      }
    Summary summary;
    summary.status         = status;
    summary.warnings       = warnings();
    summary.integrator     = integrator->name();
    summary.stable_step    = integrator->stable_step();
    summary.steps          = step;
    summary.setup_seconds  = setup_seconds;
    summary.run_seconds    = seconds_since_start() - setup_seconds;
    summary.error_estimate = error_estimate;
    summary.largest_motion = largest_motion;
    summary.frames         = frames ? frames->n_written() : 0;
    summary.history        = parameters.output.history;
    summary.probes         = parameters.output.history && !probes.empty();
    summary.observed       = writes;
    summary.last           = now;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      write_whole_file(folder + "/summary.json", summary.to_json(model()));

    if (talks && status == "done")
      {
        std::cout << "done: " << step << " steps in " << readable_duration(summary.run_seconds)
                  << ", " << std::lround(step / summary.run_seconds) << " steps/s";
        if (implicit_operator.has_mass() && std::isfinite(error_estimate))
          std::cout << "; sum of local errors " << error_estimate << " m beside a motion of "
                    << largest_motion << " m";
        std::cout << "; " << summary.frames << " frames in " << folder << std::endl;
        if (!energy_from_nowhere().empty())
          line("warning", energy_from_nowhere());
      }
  }
} // namespace Supple
