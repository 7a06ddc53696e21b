#include <supple/run/cell_indicators.h>

#include <supple/base/error.h>
#include <supple/base/first_process.h>
#include <supple/base/text.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    const std::string energy = "energy";

    constexpr unsigned int looks = 20;        ///< over a dynamic run
    constexpr double bulk        = 0.5;       ///< part of the error that marked cells have together
    constexpr double like        = 1. - 1e-3; ///< as much as another one, but for round-off


    /** Those with the largest indicators that have the bulk of their sum. */
    std::vector<unsigned int>
    largest(const std::vector<double> &indicators)
    {
      std::vector<double> sorted = indicators;
      std::sort(sorted.begin(), sorted.end(), std::greater<>());
      const double enough = bulk * std::accumulate(sorted.begin(), sorted.end(), 0.);
      std::size_t n       = 0;
      for (double sum = 0.; sum < enough * like; ++n)
        sum += sorted[n];
      std::vector<unsigned int> cells;
      for (unsigned int c = 0; n > 0 && c < indicators.size(); ++c)
        if (indicators[c] >= like * sorted[n - 1])
          cells.push_back(c);
      return cells;
    }
  } // namespace


  CellIndicators::CellIndicators(Problem &problem,
                                 const TimeIntegrator &integrator,
                                 const Probes &probes,
                                 const std::string &quantity)
    : problem(problem)
    , integrator(integrator)
    , probes(probes)
    , quantity(quantity.empty() && probes.empty() ? energy : quantity)
    , indicators(problem.body.cell_nodes.size())
  {
    require_quantity();
  }


  void
  CellIndicators::require_quantity() const
  {
    const Parameters &scene  = problem.parameters;
    const bool by            = !scene.mesh.refinement.by.empty();
    const std::string origin = scene.origin(by ? "Mesh/Refine" : "Space/Aim");
    if (!problem.forces.have_energy())
      throw InputError(origin + ": the error in space is unknown, for the forces have no elastic " +
                       "energy; Corotation/Rotation must be none or polar.");
    if (quantity == energy || quantity.empty())
      return;
    std::vector<std::string> names;
    std::string list;
    for (const Probes::Component &component : probes.displacement_components())
      {
        names.push_back(component.name);
        list += (list.empty() ? "" : ", ") + component.name;
      }
    if (std::find(names.begin(), names.end(), quantity) == names.end())
      throw InputError(origin + ": no probe follows " + quantity + did_you_mean(quantity, names) +
                       (list.empty() ? " The scene has no probes (subsection Probes), and can be "
                                       "refined by energy."
                                     : " There are energy, " + list + "."));
    if (!problem.stationary)
      throw InputError(origin + ": where a dynamic scene needs finer cells for " + quantity +
                       " is not known, for that takes its motion backwards. It can be refined by "
                       "energy.");
  }


  bool
  CellIndicators::after_step(const Observation &now)
  {
    const double time = now.measurement.time;
    if (!now.last && (problem.stationary || time < next_time))
      return true;
    next_time = time + integrator.end / looks;
    look(now.last);
    return true;
  }


  void
  CellIndicators::look(const bool last)
  {
    if (!tools)
      tools = std::make_unique<SpaceErrorTools>(problem);
    const EnergyError error = tools->energy.estimate();
    if (error.is_unknown_by_locking())
      throw ComputationError(
        "the cells lock, so that their error is not known; "
        "Material/Volumetric locking cure = patches helps");
    if (error.inverted > 0)
      {
        if (last && problem.stationary)
          throw ComputationError("cells are inside out, so that their error is not known");
        return; // of a motion there are other states
      }
    if (quantity != energy)
      return look_at_probe();
    if (last && problem.stationary)
      look_at_energy(error);
    const std::vector<double> &squares = tools->energy.of_body_cells();
    for (std::size_t c = 0; c < squares.size(); ++c)
      indicators[c] = std::max(indicators[c], squares[c]);
  }


  void
  CellIndicators::look_at_energy(const EnergyError &error)
  {
    Vector loads;
    problem.body.initialize(loads);
    problem.forces.set_loads(loads, problem.configuration, 1.);
    if (tools->points.matter(integrator.reactions(), loads))
      return;
    relative_error = error.of_work();
    if (!problem.forces.change_operator() || loads.l2_norm() == 0.)
      return;
    relative_error = std::abs(tools->duals().find_of_work(loads).relative());
  }


  void
  CellIndicators::look_at_probe()
  {
    const Parameters &scene = problem.parameters;
    ProbeErrors duals       = tools->duals();
    if (quantity.empty())
      {
        const std::vector<ProbeError> all = duals.find(probes, tools->points);
        quantity                          = all.empty() ? energy : all.front().name;
        if (all.empty())
          return look(true);
      }
    const std::vector<ProbeError> found = duals.find(probes, tools->points, quantity);
    if (found.empty())
      throw InputError(
        scene.origin(scene.mesh.refinement.by.empty() ? "Space/Aim" : "Mesh/Refine") + ": " +
        quantity +
        " has no error to refine by: it is held, does not move, or "
        "a nodal force acts at the probe.");
    relative_error = std::abs(found.front().relative());
    indicators     = duals.of_body_cells();
  }


  std::vector<double>
  CellIndicators::gather() const
  {
    const Body &body = problem.body;
    std::vector<std::pair<unsigned int, double>> own;
    for (std::size_t c = 0; c < indicators.size(); ++c)
      if (body.cell_owned[c])
        own.emplace_back(body.serial_cell[c], indicators[c]);
    const auto of_processes = Utilities::MPI::gather(problem.mesh.communicator, own);
    std::vector<double> all(of_processes.empty() ? 0 : problem.mesh.n_cells);
    for (const auto &part : of_processes)
      for (const auto &[cell, value] : part)
        all[cell] = value;
    return all;
  }


  std::vector<unsigned int>
  CellIndicators::cells_to_cut() const
  {
    const std::vector<double> all         = gather();
    const std::vector<unsigned int> cells = largest(all);
    const MPI_Comm communicator           = problem.mesh.communicator;
    if (Utilities::MPI::broadcast(communicator, cells.size()) == 0)
      throw ComputationError(
        "no cell has an error that can be told: the body has no strain energy "
        "to speak of, too few cells, or cells that are inside out");
    return cells;
  }
} // namespace Supple
