// What a simulation says on the screen, and of itself in its summary.

#include <supple/base/text.h>
#include <supple/run/simulation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <sstream>

namespace Supple
{
  using namespace dealii;

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


  std::string
  Simulation::free_rigid_motions() const
  {
    if (constraints.n_rigid_motions == 1)
      return "its one rigid motion, along its axis, is free";
    return std::to_string(constraints.n_free_rigid_motions) + " of its " +
           (constraints.n_rigid_motions == 6 ? "six" : "three") + " rigid motions are free";
  }


  std::string
  Simulation::section_in_words() const
  {
    std::ostringstream thickness;
    thickness << mesh.section.thickness << " m thick, ";
    switch (mesh.section.geometry)
      {
        case Geometry::plane_strain:
          return "plane strain, " + thickness.str();
        case Geometry::plane_stress:
          return "plane stress, " + thickness.str();
        case Geometry::axisymmetric:
          return "axisymmetric, ";
        default:
          return "";
      }
  }


  void
  Simulation::print_mesh_details() const
  {
    const MeshReport &report = mesh.report;
    std::ostringstream worst;
    worst << report.worst_quality << ", cell " << report.worst_cell << " at ("
          << report.worst_position << "); 1 is regular, 0 is flat";
    line("boundaries", counts(mesh.boundaries) + "; id (number of faces)");
    line("materials", counts(mesh.materials) + "; id (number of cells)");
    line("pieces", std::to_string(report.pieces.size()));
    line("worst cell", worst.str());
    line("repaired", std::to_string(report.repaired) + " inverted cells");
    line("vertices",
         std::to_string(report.unused_vertices) + " in no cell, " +
           std::to_string(report.double_vertices) + " at the place of another");
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
         std::to_string(mesh.n_cells) + " " + mesh.cell_name() + ", " +
           std::to_string(mesh.n_vertices) + " vertices in " + mesh.extent() + " m, " +
           volume.str() + " m^3");
    if (in_detail)
      print_mesh_details();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);
    line("unknowns",
         std::to_string(body.n_dofs()) + ", of which " + std::to_string(constraints.n_held) +
           " are held; " + (n_ranks == 1 ? "1 process" : std::to_string(n_ranks) + " processes"));
    line("model", section_in_words() + rotations[static_cast<unsigned int>(body.rotation)]);
    line("time", time.str());
    if (const auto stable = integrator->stable_step())
      line("stable step", "up to " + stable->description());
    if (stationary || !parameters.time.is_explicit())
      line("solver", solver->name() + " (" + solver->reason + ")");
    for (const std::string &text : probes.descriptions())
      line("probe", text);
    if (resumed)
      line("resumed", "goes on from " + checkpoint.origin());
    for (const std::string &text : warnings())
      line("warning", text);
    std::cout << std::flush;
  }


  std::vector<std::string>
  Simulation::warnings() const
  {
    std::vector<std::string> list = mesh.report.warnings;
    if (checkpoint.was_damaged())
      list.push_back("Goes on from " + checkpoint.origin() + "; checkpoint.cbor is damaged.");
    if (resumed && step == steps_before && finished())
      list.push_back("Nothing was left to do: step " + std::to_string(step) +
                     " of the run to go on from is at or beyond the end that is asked for "
                     "(subsection Time).");
    if (!constraints.free_pieces_in_words().empty())
      list.push_back(constraints.free_pieces_in_words());
    list.insert(list.end(), probes.warnings().begin(), probes.warnings().end());
    if (body.rotation == RotationMethod::gram_schmidt)
      list.push_back(
        "Gram-Schmidt rotations have no elastic energy: 'elastic' is the energy of the same "
        "formula, and "
        "'dissipated' need not grow. They depend on the axes.");
    const double poisson = body.largest_poisson();
    if (poisson > 0.45 && !body.patches && mesh.section.geometry != Geometry::plane_stress)
      {
        std::ostringstream text;
        text << "Linear " << mesh.cell_name()
             << " are too stiff (they lock) at a Poisson ratio above 0.45; it is " << poisson
             << ". Material/Volumetric locking cure = patches helps.";
        list.push_back(text.str());
      }
    if (!stationary && parameters.time.method == TimeMethod::ida &&
        parameters.time.maximum_order > 2)
      list.push_back(
        "Backward differentiation of an order above 2 (Time/Maximum order) is not "
        "stable for oscillations that hardly decay: these may grow without bounds.");
    const std::vector<std::string> more = warnings_of_motion();
    list.insert(list.end(), more.begin(), more.end());
    return list;
  }


  std::vector<std::string>
  Simulation::warnings_of_motion() const
  {
    std::vector<std::string> list;
    if (diagnostics.extremes().energy_rises > 0 &&
        parameters.time.energy_guard != TimeParameters::EnergyGuard::off)
      {
        const unsigned int n = diagnostics.extremes().energy_rises;
        list.push_back("In " + std::to_string(n) + (n == 1 ? " step" : " steps") +
                       " the total energy rose by more than the work that was done.");
      }
    if (!energy_from_nowhere().empty())
      list.push_back(energy_from_nowhere());
    if (diagnostics.extremes().most_inverted > 0)
      list.push_back("Up to " + std::to_string(diagnostics.extremes().most_inverted) +
                     " cells at once were inside out, with a volume ratio down to " +
                     digits(diagnostics.extremes().min_volume_ratio, 3) +
                     " (history.csv): stress and strain there mean nothing.");
    if (!strains_too_large().empty())
      list.push_back(strains_too_large());
    if (effort.jumps > 0)
      list.push_back("In " + std::to_string(effort.jumps) +
                     " steps a prescribed motion jumps, or swings to and fro: what it does to the "
                     "body depends on the step and the mesh. Move it over some steps, such as by "
                     "min(t/0.1, 1), or take shorter ones.");
    if (effort.stand_in_solves > 0)
      list.push_back(solver->name() + " failed in " + std::to_string(effort.stand_in_solves) +
                     " of " + std::to_string(effort.solves) + " systems, which " +
                     solver->stand_in_name() + " solved in its stead.");
    // Each solver has met its own criterion, and what was left over was solved for three times.
    const double tolerance = parameters.solver.tolerance;
    if (effort.max_relative_residual > 2. * tolerance)
      list.push_back("The worst linear solve left a relative residual of " +
                     digits(effort.max_relative_residual, 2) + " where " + digits(tolerance, 2) +
                     " was asked for (Solver/Tolerance): round-off of a badly conditioned matrix.");
    return list;
  }


  std::string
  Simulation::strains_too_large() const
  {
    const Extremes &worst = diagnostics.extremes();
    std::string text;
    if (worst.min_volume_ratio < 0.5 && worst.most_inverted == 0) // inverted cells are told anyway
      text = "squeezed to " + digits(worst.min_volume_ratio, 3);
    if (worst.max_volume_ratio > 2.)
      text += std::string(text.empty() ? "" : " and ") + "swollen to " +
              digits(worst.max_volume_ratio, 3);
    return text.empty() ? ""
                        : "Cells were " + text +
                            " times their volume at rest (history.csv): elasticity of small "
                            "strains means little there.";
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


  std::string
  Simulation::where_results_are(const std::string &which) const
  {
    return folder.empty() ? "" : " The results " + which + " are in " + folder + ".";
  }


  void
  Simulation::print_result() const
  {
    std::cout << "done: " << step << " steps in " << readable_duration(run_seconds) << ", "
              << std::lround(step / run_seconds) << " steps/s";
    if (implicit_operator.has_mass())
      std::cout << "; motion " << largest_motion << " m";
    if (implicit_operator.has_mass() && std::isfinite(error_estimate))
      std::cout << ", sum of local errors " << error_estimate << " m";
    std::cout << "; " << (frames ? frames->n_written() : 0) << " frames in " << folder << std::endl;
    for (const std::string &text : warnings())
      if (std::find(warnings_told.begin(), warnings_told.end(), text) == warnings_told.end())
        line("warning", text);
    if (writes_report)
      line("report", folder + "/report.html");
    if (!step_doubling)
      return;
    if (step_doubling->failure.empty() && largest_motion > 0.)
      std::cout << "error: " << step_doubling->largest << " m ("
                << 100. * step_doubling->largest / largest_motion << " % of the motion), "
                << step_doubling->last << " m at the end, by a second run with "
                << step_doubling->name << " in " << readable_duration(step_doubling->seconds)
                << std::endl;
    else if (!step_doubling->failure.empty())
      std::cout << "error: unknown, for the second run failed: " << step_doubling->failure
                << std::endl;
  }
} // namespace Supple
