#include <supple/run/space_estimate.h>

#include <supple/base/error.h>
#include <supple/base/stopwatch.h>
#include <supple/base/text.h>
#include <supple/run/error_words.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace Supple
{
  namespace
  {
    const std::string cure = "Material/Volumetric locking cure = patches";
  } // namespace


  std::string
  SpaceErrors::of_energy_in_words() const
  {
    const bool at_least = energy.locks() || energy.rough;
    switch (of)
      {
        case Of::work:
          return part_of(of_work(), at_least, "the work of the loads");
        case Of::forces:
          return part_of(energy.of_forces(), at_least, "the forces that move it");
        case Of::stress:
          return part_of(energy.relative_norm(), at_least, "the stress");
        default:
          if (over_run.of_work() > largest_told_error)
            return part_of(over_run.of_work(), at_least, "the elastic energy");
          return "a swing too quick by " + std::string(at_least ? "more than " : "") +
                 percent_of(over_run.of_frequency());
      }
  }


  std::string
  SpaceErrors::in_words() const
  {
    const std::string mesh = energy.locks() ? " (mesh; cells lock)"
                             : energy.rough ? " (mesh; too few cells through the body)"
                                            : " (mesh)";
    if (!probes.empty() && of != Of::forces)
      return "in space " +
             part_of(std::abs(probes.front().relative()),
                     energy.locks() || energy.rough,
                     probes.front().name) +
             (of == Of::stress ? ", " + of_energy_in_words() : "") + mesh;
    if (!unknown.empty())
      return "in space unknown, for " + unknown;
    return "in space " + of_energy_in_words() + mesh;
  }


  std::vector<std::string>
  SpaceErrors::warnings() const
  {
    if (!energy.locks())
      return {};
    return {
      "The cells lock: stress goes up and down from cell to cell, " +
      digits(*energy.lock_ratio, 2) +
      " times as much as its recovery explains (about 1 is right, doc/error.md). The error in "
      "space is " +
      (energy.is_unknown_by_locking() ? "unknown and large" : "more than the estimate") + "; " +
      cure + " helps."};
  }


  nlohmann::ordered_json
  SpaceErrors::to_json() const
  {
    const std::array<const char *, 4> kinds = {{"work", "forces", "stress", "swing"}};
    nlohmann::ordered_json json = {{"time", time}, {"of", kinds[static_cast<unsigned int>(of)]}};
    if (!unknown.empty())
      json["unknown"] = unknown;
    else if (of_work() > largest_told_error)
      json["more_than"] = largest_told_error;
    else
      json.update({{"energy", energy.relative_norm()},
                   {"work", of_work()},
                   {"frequency", over_run.of_frequency()}});
    if (json.contains("work") && of == Of::stress)
      json.erase("work");
    if (json.contains("work") && of == Of::forces && energy.of_forces() <= largest_told_error)
      json["forces"] = -energy.of_forces();
    if (energy.rough)
      json["rough"] = true;
    if (energy.lock_ratio)
      json["lock_ratio"] = *energy.lock_ratio;
    for (const ProbeError &probe : probes)
      if (std::abs(probe.relative()) <= largest_told_error)
        json["probes"][probe.name] = probe.relative();
      else
        json["probes"][probe.name] = nullptr;
    if (!probes_unknown.empty())
      json["probes_unknown"] = probes_unknown;
    return json;
  }


  SpaceEstimate::SpaceEstimate(Problem &problem,
                               const TimeIntegrator &integrator,
                               const Probes &probes,
                               const std::function<bool(const Measurement &)> &frame_due)
    : problem(problem)
    , integrator(integrator)
    , probes(probes)
    , frame_due(frame_due)
  {
  }


  void
  SpaceEstimate::begin(const Observation &now, const bool resumed)
  {
    if (!resumed || now.last)
      after_step(now);
  }


  bool
  SpaceEstimate::is_time_to_look(const Measurement &now)
  {
    constexpr unsigned int looks = 8, least_steps = 50;
    if (problem.stationary || now.time < next_look || now.step < step_of_look + least_steps)
      return false;
    next_look    = now.time + integrator.end / looks;
    step_of_look = now.step;
    return true;
  }


  bool
  SpaceEstimate::after_step(const Observation &now)
  {
    most_kinetic     = std::max(most_kinetic, now.measurement.kinetic);
    most_elastic     = std::max(most_elastic, now.measurement.elastic);
    const bool each  = problem.parameters.space.estimate == SpaceParameters::Estimate::frames;
    const bool shown = now.last || (each && frame_due(now.measurement));
    if (!shown && !is_time_to_look(now.measurement))
      return true;
    const PhaseTimer timer(problem.effort, Phase::diagnostics);
    const Stopwatch stopwatch;
    const Effort of_run      = problem.effort;
    const SpaceErrors errors = estimate(now);
    problem.effort           = of_run; // dual solutions are no part of it
    const bool known         = errors.unknown.empty();
    if (known)
      {
        over_run.square += errors.energy.square;
        over_run.of_patches += errors.energy.of_patches;
        over_run.strain_energy += errors.energy.strain_energy;
      }
    seconds += stopwatch.seconds();
    if (!shown)
      return true;
    cell_errors.step     = now.measurement.step;
    cell_errors.of_cells = known ? tools->energy.of_cells() : std::vector<float>();
    of_work = known ? errors.energy.of_work() : std::numeric_limits<double>::quiet_NaN();
    if (now.last)
      {
        last           = errors;
        last->over_run = over_run;
      }
    return true;
  }


  double
  SpaceEstimate::of_work_after(const unsigned int step) const
  {
    return cell_errors.step == step ? of_work : std::numeric_limits<double>::quiet_NaN();
  }


  SpaceErrors
  SpaceEstimate::estimate(const Observation &now)
  {
    const Configuration &configuration = problem.configuration;
    SpaceErrors errors;
    errors.time = now.measurement.time;
    if (!problem.forces.have_energy())
      {
        errors.unknown = "the forces have no elastic energy";
        return errors;
      }
    if (!tools)
      {
        tools = std::make_unique<SpaceErrorTools>(problem);
        problem.body.initialize(loads);
      }
    problem.forces.set_loads(loads, configuration, problem.stationary ? 1. : errors.time);
    if (problem.stationary)
      loads *= errors.time;
    errors.energy  = tools->energy.estimate();
    errors.unknown = obstacle(errors.energy, now.measurement.kinetic);
    errors.of      = kind_of_error();
    if (now.last && problem.stationary && errors.unknown.empty())
      add_probes(errors);
    if (errors.unknown.empty() && tools->points.matter(integrator.reactions(), loads))
      errors.unknown =
        "a force acts at a point or along a line, where the exact strain energy is "
        "infinite";
    return errors;
  }


  SpaceErrors::Of
  SpaceEstimate::kind_of_error() const
  {
    constexpr double slow = 1e-3; // kinetic energy, as a part of the elastic one
    using Of              = SpaceErrors::Of;
    if (!problem.stationary && most_kinetic > slow * most_elastic)
      return Of::swing;
    const bool moved = body_is_moved(), loaded = loads.l2_norm() > 0.;
    if (moved != loaded)
      return moved ? Of::forces : Of::work;
    return Of::stress;
  }


  bool
  SpaceEstimate::body_is_moved() const
  {
    const Vector &u                       = problem.configuration.displacement();
    const std::vector<unsigned int> &held = problem.constraints.owned();
    const bool here = std::any_of(held.begin(), held.end(), [&](const unsigned int dof) {
      return u.local_element(dof) != 0.;
    });
    return dealii::Utilities::MPI::max(here ? 1 : 0, problem.mesh.communicator) > 0;
  }


  std::string
  SpaceEstimate::obstacle(const EnergyError &energy, const double kinetic) const
  {
    constexpr double round_off = 1e-12; // of strains
    constexpr double little    = 1e-9;  // of the kinetic energy

    if (energy.inverted > 0)
      return std::to_string(energy.inverted) + (energy.inverted == 1 ? " cell is" : " cells are") +
             " inside out";
    double stiffness = 0.;
    for (const auto &[id, n_cells] : problem.mesh.materials)
      stiffness = std::max(stiffness, problem.body.material(id).mu);
    const double least = round_off * round_off * stiffness * problem.mesh.volume;
    if (!(energy.strain_energy > std::max(least, little * kinetic)))
      return "the body has no strain energy to speak of";
    if (!tools->energy.recovery.is_everywhere())
      return "the body has too few cells for an estimate";
    if (energy.is_unknown_by_locking())
      return "the cells lock; " + cure + " helps";
    return "";
  }


  void
  SpaceEstimate::add_probes(SpaceErrors &errors)
  {
    if (probes.empty() && !(errors.of == SpaceErrors::Of::work && problem.forces.change_operator()))
      return;
    try
      {
        ProbeErrors duals = tools->duals();
        errors.probes     = duals.find(probes, tools->points);
        if (errors.of == SpaceErrors::Of::work && problem.forces.change_operator())
          errors.work = duals.find_of_work(loads);
        const auto &pilots = problem.parameters.mesh.refinement.pilots;
        if (!pilots.empty()) // what the mesh was refined for comes first
          std::stable_partition(errors.probes.begin(), errors.probes.end(), [&](const auto &probe) {
            return probe.name == pilots.back().of;
          });
      }
    catch (const ComputationError &error)
      {
        errors.probes_unknown = error.what();
      }
  }
} // namespace Supple
