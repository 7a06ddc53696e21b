#include <supple/run/description.h>

#include <supple/base/progress.h>
#include <supple/base/text.h>
#include <supple/forces/contact.h>
#include <supple/scene/idle_entries.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <map>
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


  Description::Description(const Problem &problem,
                           const TimeIntegrator &integrator,
                           const Probes &probes,
                           const Diagnostics &diagnostics,
                           const Course &course,
                           const SkippedPulses &pulses)
    : problem(problem)
    , integrator(integrator)
    , probes(probes)
    , diagnostics(diagnostics)
    , course(course)
    , pulses(pulses)
  {
  }


  std::string
  Description::section_in_words() const
  {
    std::ostringstream thickness;
    thickness << problem.mesh.section.thickness << " m thick, ";
    switch (problem.mesh.section.geometry)
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
  Description::print_mesh_details() const
  {
    const MeshReport &report = problem.mesh.report;
    std::ostringstream worst;
    worst << report.worst_quality << ", cell " << report.worst_cell << " at ("
          << report.worst_position << "); 1 is regular, 0 is flat";
    line("boundaries", counts(problem.mesh.boundaries) + "; id (number of faces)");
    line("materials", counts(problem.mesh.materials) + "; id (number of cells)");
    std::string names;
    for (const auto &[kind, groups] : {std::make_pair("material", problem.mesh.material_names),
                                       std::make_pair("boundary", problem.mesh.boundary_names)})
      for (const auto &[name, id] : groups)
        names += (names.empty() ? "" : ", ") + name + " (" + kind + " " + std::to_string(id) + ")";
    if (!names.empty())
      line("groups", names);
    line("pieces", std::to_string(report.pieces.size()));
    line("worst cell", worst.str());
    line("repaired", std::to_string(report.repaired) + " inverted cells");
    line("vertices",
         std::to_string(report.unused_vertices) + " in no cell, " +
           std::to_string(report.double_vertices) + " at the place of another");
  }


  std::string
  Description::time_in_words() const
  {
    const TimeParameters &time = problem.parameters.time;
    std::ostringstream text;
    text << integrator.name() << ", ";
    if (problem.stationary)
      text << time.n_steps << " load steps";
    else if (time.has_variable_steps())
      text << "up to " << integrator.end << " s, relative tolerance " << time.relative_tolerance;
    else
      text << time.n_steps << " steps of " << time.step << " s";
    return text.str();
  }


  std::string
  Description::errors_in_words() const
  {
    using Estimate = SpaceParameters::Estimate;
    std::string text;
    if (problem.parameters.time.estimate_error)
      text = "in time by a second run, ";
    else if (!problem.stationary)
      text = "in time estimated step by step (Time/Estimate error), ";
    if (problem.parameters.space.second_mesh != SpaceParameters::SecondMesh::none)
      text += "in space by a run on another mesh, ";
    switch (problem.parameters.space.estimate)
      {
        case Estimate::end:
          return text + "in space estimated at the end";
        case Estimate::frames:
          return text + "in space estimated at each frame and at the end";
        default:
          return text + "in space not estimated (Space/Estimate error)";
      }
  }


  void
  Description::print(const bool in_detail) const
  {
    const Mesh &mesh                            = problem.mesh;
    const MaterialParameters &material          = problem.parameters.material;
    const std::array<const char *, 3> rotations = {
      {"linear elasticity", "corotational, Gram-Schmidt", "corotational, polar"}};
    std::ostringstream volume;
    volume << mesh.volume;

    std::cout << "Supple " << SUPPLE_VERSION << ", scene " << problem.parameters.scene_name << '\n';
    line("body",
         std::to_string(mesh.n_cells) + " " + mesh.cell_name() + ", " +
           std::to_string(mesh.n_vertices) + " vertices " +
           (mesh.is_quadratic() ? "and " + std::to_string(mesh.n_middles) + " middles of edges "
                                : "") +
           "in " + mesh.extent() + " m, " + volume.str() + " m^3");
    if (in_detail)
      print_mesh_details();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(mesh.communicator);
    line("unknowns",
         std::to_string(problem.body.n_dofs()) + ", of which " +
           std::to_string(problem.constraints.n_held) + " are held; " +
           (n_ranks == 1 ? "1 process" : std::to_string(n_ranks) + " processes"));
    line("model",
         section_in_words() +
           (material.law_choice().is_hyperelastic()
              ? material.law
              : rotations[static_cast<unsigned int>(problem.parameters.corotation.rotation)]));
    line("time", time_in_words());
    if (const auto stable = integrator.stable_step())
      line("stable step", "up to " + stable->description());
    if (problem.stationary || !problem.parameters.time.is_explicit())
      line("solver", problem.solver->name() + " (" + problem.solver->reason + ")");
    for (const std::string &text : probes.descriptions())
      line("probe", text);
    if (in_detail)
      line("error", errors_in_words());
    if (in_detail && !problem.parameters.mesh.refinement.by.empty())
      line("refinement",
           "a run refines the mesh " + problem.parameters.mesh.refinement.by + " before");
    if (course.resumed())
      line("resumed", "goes on from " + course.origin);
    for (const std::string &text : warnings())
      line("warning", text);
    std::cout << std::flush;
  }


  std::vector<std::string>
  Description::warnings() const
  {
    const Body &body              = problem.body;
    std::vector<std::string> list = problem.mesh.report.warnings;
    if (course.origin_is_second_choice)
      list.push_back("Goes on from " + course.origin + "; checkpoint.cbor is damaged.");
    if (course.resumed() && course.now.step == course.steps_before && integrator.finished())
      list.push_back("Nothing was left to do: step " + std::to_string(course.now.step) +
                     " of the run to go on from is at or beyond the end that is asked for "
                     "(subsection Time).");
    list.insert(list.end(), problem.warnings.begin(), problem.warnings.end());
    if (!problem.constraints.free_pieces_in_words().empty())
      list.push_back(problem.constraints.free_pieces_in_words());
    if (problem.constraints.n_held == body.n_dofs())
      list.push_back("All vertices of the body are held or moved: nothing is left to be found.");
    list.insert(list.end(), probes.warnings().begin(), probes.warnings().end());
    const std::vector<std::string> idle = idle_entries(problem.parameters);
    list.insert(list.end(), idle.begin(), idle.end());
    if (problem.parameters.corotation.rotation == RotationMethod::gram_schmidt)
      list.push_back(
        "Gram-Schmidt rotations have no elastic energy: 'elastic' is the energy of the same "
        "formula, and "
        "'dissipated' need not grow. They depend on the axes.");
    if (problem.parameters.material.law == "st venant-kirchhoff")
      list.push_back(
        "St. Venant-Kirchhoff's law offers less and less resistance to cells that are "
        "crushed, so that they collapse (Material/Law); neo-hookean does not.");
    const double poisson = body.largest_poisson();
    if (poisson > 0.45 && !body.has_patches() &&
        problem.mesh.section.geometry != Geometry::plane_stress)
      {
        std::ostringstream text;
        if (body.is_quadratic())
          text << "Quadratic tetrahedra are somewhat too stiff at a Poisson ratio above 0.45, and "
                  "their pressure goes up and down from cell to cell; it is ";
        else
          text << "Linear " << problem.mesh.cell_name()
               << " are too stiff (they lock) at a Poisson ratio above 0.45; it is ";
        text << (poisson < 0.4999 ? digits(poisson, 6) : "0.5 - " + digits(0.5 - poisson, 2))
             << ". Material/Volumetric locking cure = patches helps.";
        list.push_back(text.str());
      }
    if (!problem.stationary && problem.parameters.time.method == TimeMethod::ida &&
        problem.parameters.time.maximum_order > 2)
      list.push_back(
        "Backward differentiation of an order above 2 (Time/Maximum order) is not "
        "stable for oscillations that hardly decay: these may grow without bounds.");
    for (const auto &more : {warnings_of_motion(), warnings_of_contact(), warnings_of_solver()})
      list.insert(list.end(), more.begin(), more.end());
    return list;
  }


  std::vector<std::string>
  Description::warnings_of_motion() const
  {
    std::vector<std::string> list;
    if (diagnostics.extremes().energy_rises > 0 &&
        problem.parameters.time.energy_guard != TimeParameters::EnergyGuard::off)
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
    if (problem.effort.jumps > 0)
      list.push_back("In " + std::to_string(problem.effort.jumps) +
                     " steps a prescribed motion jumps, or swings to and fro: what it does to the "
                     "body depends on the step and the mesh. Move it over some steps, such as by "
                     "min(t/0.1, 1), or take shorter ones.");
    const std::vector<std::string> skipped = pulses.warnings();
    list.insert(list.end(), skipped.begin(), skipped.end());
    return list;
  }


  std::vector<std::string>
  Description::warnings_of_contact() const
  {
    const Contact *const contact = problem.forces.contact();
    const Extremes &worst        = diagnostics.extremes();
    std::vector<std::string> list;
    if (!contact)
      return list;
    for (std::size_t t = 0; t < worst.gaps.size() && integrator.finished(); ++t)
      {
        const Tool &tool = contact->all_tools()[t];
        if (worst.gaps[t] >= tool.reach)
          list.push_back("The tool " + tool.parameters.name +
                         " never touched the body: it came no nearer than " +
                         digits(worst.gaps[t] - tool.reach, 3) + " m.");
      }
    constexpr double degrees = 180. / M_PI, many = 5.;
    const auto touched = [&](const std::size_t t) {
      return t < worst.gaps.size() && worst.gaps[t] < contact->all_tools()[t].reach;
    };
    const auto matters = [&](const std::size_t t) {
      const ToolParameters &tool = contact->all_tools()[t].parameters;
      return tool.friction > 0. || tool.shape != ToolParameters::Shape::sphere;
    };
    for (std::size_t t = 0; t < contact->all_tools().size(); ++t)
      if (const double turn = degrees * contact->turns_within_steps()[t];
          turn > many && touched(t) && matters(t))
        list.push_back("The tool " + contact->all_tools()[t].parameters.name + " turned by " +
                       digits(turn, 3) +
                       " degrees within a step: friction and work see the straight way between "
                       "both ends alone. Take steps with less than " +
                       digits(many, 1) + " degrees.");
    if (!trouble_of_friction(*contact).empty())
      list.push_back(trouble_of_friction(*contact));
    const TimeMethod method = problem.parameters.time.method;
    const bool is_free =
      problem.constraints.n_held == 0 || !problem.constraints.free_pieces.empty();
    if (worst.releases > 0 && is_free && !problem.stationary &&
        (method == TimeMethod::backward_euler || method == TimeMethod::implicit_backward_euler))
      list.push_back(
        "The body left what it had touched: how fast it rebounds depends on "
        "the step, for backward Euler damps what is faster. Halve Time/Step, or take "
        "Time/Method = trbdf2.");
    return list;
  }


  /** Whether Newton's method finds a step or just not is a matter of round-off, and what sticks and
   * what slips then is another state of another step. */
  std::string
  Description::trouble_of_friction(const Contact &contact) const
  {
    constexpr double fine = 100.; // times the slip resolution

    const Contact::Trouble &trouble = contact.trouble();
    const unsigned int limit        = problem.parameters.time.newton_limit;
    if (trouble.n_failed == 0 && trouble.most_corrections <= limit / 2)
      return {};
    std::string words = "Friction makes steps hard to find: ";
    if (trouble.n_failed > 0)
      words += std::to_string(trouble.n_failed) +
               (trouble.n_failed == 1 ? " was not found" : " were not found") +
               " and had to be done in shorter ones";
    else
      words += "one took " + std::to_string(trouble.most_corrections) + " of Newton's " +
               std::to_string(limit) + " iterations";
    words +=
      ". Another number of processes, which rounds in another way, may give another motion "
      "from there on. ";
    if (trouble.fastest_slip > fine * contact.slip_resolution())
      words += "Surfaces slide with up to " + digits(trouble.fastest_slip, 2) +
               " m/s, and Contact/Slip resolution is " + digits(contact.slip_resolution(), 2) +
               " m/s: a hundredth of the speed will do, " + digits(trouble.fastest_slip / fine, 2) +
               " m/s; or take shorter steps.";
    else
      words += "Take shorter steps, or a larger Contact/Slip resolution than " +
               digits(contact.slip_resolution(), 2) + " m/s.";
    return words;
  }


  std::vector<std::string>
  Description::warnings_of_solver() const
  {
    const Effort &effort = problem.effort;
    std::vector<std::string> list;
    if (effort.stand_in_solves > 0)
      list.push_back(problem.solver->name() + " failed in " +
                     std::to_string(effort.stand_in_solves) + " of " +
                     std::to_string(effort.solves) + " systems, which " +
                     problem.solver->stand_in_name() + " solved in its stead.");
    // Each solver has met its own criterion, and what was left over was solved for three times.
    const double tolerance = problem.solver->tolerance();
    if (effort.max_relative_residual > 2. * tolerance)
      list.push_back("The worst linear solve left a relative residual of " +
                     digits(effort.max_relative_residual, 2) + " where " + digits(tolerance, 2) +
                     " was asked for (Solver/Tolerance): round-off of a badly conditioned matrix.");
    return list;
  }


  std::string
  Description::strains_too_large() const
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
  Description::energy_from_nowhere() const
  {
    const double gained = diagnostics.extremes().energy_gained;
    const double motion = diagnostics.extremes().motion_energy;
    if (gained <= 0.01 * motion || !problem.forces.have_energy())
      return "";
    std::ostringstream text;
    text << "The time stepping added " << gained << " J to a motion of at most " << motion << " J"
         << (gained > 0.2 * motion ? ": it is not to be trusted." : ".")
         << " Take shorter steps, variable steps or another method.";
    return text.str();
  }


  namespace
  {
    /** "", "about ", "more than " */
    std::string
    how_sure(const StepDoubling &second)
    {
      if (second.observed())
        return second.observed()->at_least ? "more than " : "about ";
      return second.third_failure().empty() ? "" : "more than ";
    }


    /** ", order 0.9", ", order 0.2 where it should be 1" */
    std::string
    order_of(const StepDoubling &second)
    {
      if (!second.observed() || !second.observed()->order)
        return "";
      return ", order " + digits(*second.observed()->order, 2) +
             (second.observed()->at_least ? " where it should be " + std::to_string(second.order)
                                          : "");
    }


    /**
     * The least error of an undamped motion whose steps have taken a part of its energy, as a part
     * of the motion: its swings have shrunk to the root of what is left, and are half of the motion
     * where it began at one end. Steps that are longer than the swings take all at once, so that
     * runs with half the step are as wrong. 0 where less than most of it is lost: waves that do not
     * move the body far may have as much.
     */
    double
    least_error_by_energy(const double lost)
    {
      constexpr double most = 0.8;
      return lost > most ? 0.5 * (1. - std::sqrt(std::max(0., 1. - lost))) : 0.;
    }


    /** By the second run, or else by the local errors; empty if nothing is known, or moves. */
    std::string
    error_in_time(const Summary &summary)
    {
      const StepDoubling *const second = summary.step_doubling;
      if (second && !second->failure().empty())
        return "in time unknown, for the second run failed: " + second->failure();
      if (!summary.has_mass || summary.largest_motion == 0.)
        return "";
      const double by_energy = least_error_by_energy(summary.energy_lost_by_steps());
      if (by_energy > 0. && !(second && second->best() > by_energy * summary.largest_motion) &&
          !(summary.error_estimate > by_energy * summary.largest_motion && !second))
        return "in time more than " + digits(100. * by_energy, 2) +
               " % of the motion (the steps take " +
               std::to_string(std::lround(100. * std::min(1., summary.energy_lost_by_steps()))) +
               " % of its energy; the estimate by " +
               (second ? second->steps_in_words() : std::string("local errors")) + " is too small)";
      const auto of_motion = [&](const double error) {
        const double percent = 100. * error / summary.largest_motion;
        return (percent < 99.5 ? digits(percent, 2) : std::to_string(std::lround(percent))) +
               " % of the motion (";
      };
      if (second)
        return "in time " + how_sure(*second) + of_motion(second->best()) +
               second->steps_in_words() + order_of(*second) + ")";
      if (!summary.local_errors_add_up || !std::isfinite(summary.error_estimate))
        return "";
      const bool large = summary.error_estimate > 0.5 * summary.largest_motion;
      return "in time " +
             (large ? "perhaps more than " + of_motion(0.5 * summary.largest_motion)
                    : "about " + of_motion(summary.error_estimate)) +
             "sum of local errors)";
    }
  } // namespace


  void
  print_result(const Summary &summary,
               const std::string &folder,
               const std::string &report,
               const std::vector<std::string> &told)
  {
    std::cout << "done: " << summary.steps << " steps in " << readable_duration(summary.run_seconds)
              << ", " << std::lround(summary.steps / summary.run_seconds) << " steps/s";
    if (summary.has_mass)
      std::cout << "; motion " << summary.largest_motion << " m";
    if (summary.has_mass && summary.local_errors_add_up && std::isfinite(summary.error_estimate))
      std::cout << ", sum of local errors " << summary.error_estimate << " m";
    std::cout << "; " << summary.frames << " frames in " << folder;
    if (!summary.observed)
      std::cout << "; energies and volumes were not measured (Output/History, Output/Frames)";
    std::cout << std::endl;
    for (const std::string &text : summary.warnings)
      if (std::find(told.begin(), told.end(), text) == told.end())
        line("warning", text);
    if (!report.empty())
      line("report", report);
    std::string errors = error_in_time(summary);
    const auto add     = [&](const std::string &text) {
      errors += (errors.empty() || text.empty() ? "" : ", ") + text;
    };
    if (summary.space_errors)
      add(summary.space_errors->in_words());
    if (summary.second_mesh)
      add(summary.second_mesh->in_words(summary.cells_lock()));
    if (!errors.empty())
      std::cout << "error: " << errors << std::endl;
  }
} // namespace Supple
