#include <supple/run/summary.h>

#include <deal.II/base/config.h>
#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <sundials/sundials_version.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    Json
    what_was_built(const Summary &summary, const Model &model)
    {
      const Effort &effort = model.effort;
      return {{"mass_matrix", model.implicit_operator.has_mass()},
              {"damping_matrix", model.damping.any()},
              {"rotations_computed", effort.rotations_computed},
              {"assemblies", effort.assemblies},
              {"cells_warped", effort.cells_warped},
              {"factorizations", effort.factorizations},
              {"multigrid_hierarchies", effort.hierarchies},
              {"parallel",
               dealii::Utilities::MPI::n_mpi_processes(model.body.mesh.communicator) > 1},
              {"energies_measured", summary.observed},
              {"history", summary.history},
              {"probes", summary.probes},
              {"frames", summary.frames}};
    }


    Json
    energies(const Measurement &last)
    {
      return {{"time", last.time},
              {"kinetic", last.kinetic},
              {"elastic", last.elastic},
              {"potential", last.potential},
              {"dissipated", last.dissipated},
              {"total", last.total},
              {"work", last.work},
              {"min_volume_ratio", last.min_volume_ratio},
              {"max_volume_ratio", last.max_volume_ratio},
              {"inverted", last.inverted}};
    }


    /** Not a number, where the method has no estimate, becomes null. */
    Json
    errors(const Summary &summary)
    {
      const auto relative = [&](const double error) {
        return summary.largest_motion > 0. ? error / summary.largest_motion : 0.;
      };
      Json json = {{"sum_of_local_errors", summary.error_estimate},
                   {"largest_motion", summary.largest_motion},
                   {"relative", relative(summary.error_estimate)}};
      if (const StepDoubling *const doubling = summary.step_doubling)
        {
          Json &second = json["step_doubling"];
          second       = {{"second_run", doubling->name}, {"seconds", doubling->seconds}};
          if (doubling->failure.empty())
            second.update({{"largest", doubling->largest},
                           {"at_the_end", doubling->last},
                           {"relative", relative(doubling->largest)}});
          else
            second["failed"] = doubling->failure;
        }
      return json;
    }


    Json
    solutions(const Model &model, const double tolerance)
    {
      const LinearSolver &solver = model.solver;
      const Effort &effort       = model.effort;
      Json json                  = {{"name", solver.name()},
                                    {"reason", solver.reason},
                                    {"tolerance", tolerance},
                                    {"max_relative_residual", effort.max_relative_residual},
                                    {"solves", effort.solves},
                                    {"iterations", effort.linear_iterations},
                                    {"newton_iterations", effort.newton_iterations}};
      if (!solver.stand_in_name().empty())
        json["stand_in"] = {{"name", solver.stand_in_name()}, {"solves", effort.stand_in_solves}};
      return json;
    }


    /** How evenly cells, ghosts and seconds are spread over the processes; collective. */
    void
    add_ranks(Json &json, const Model &model)
    {
      const Body &body                       = model.body;
      const std::vector<LocalCell> &cells    = body.mesh.parts->cells;
      constexpr unsigned int first_of_phases = 2;
      std::vector<double> values             = {
                    double(
          std::count_if(cells.begin(), cells.end(), [](const auto &cell) { return cell.owned; })),
                    double(body.n_local - body.n_owned)};
      values.insert(values.end(), model.effort.seconds.begin(), model.effort.seconds.end());
      const auto over_ranks = dealii::Utilities::MPI::min_max_avg(values, body.mesh.communicator);

      const auto range = [](const dealii::Utilities::MPI::MinMaxAvg &number) -> Json {
        return {{"least", std::lround(number.min)}, {"most", std::lround(number.max)}};
      };
      json["partition"] = {{"cells", range(over_ranks[0])},
                           {"ghost_vertices", range(over_ranks[1])}};
      for (const auto &level : model.solver.coarse_levels())
        {
          const double n_owned = level.n_owned;
          Json share = range(dealii::Utilities::MPI::min_max_avg(n_owned, body.mesh.communicator));
          share["nodes"] = level.n_nodes;
          json["partition"]["coarse_levels"].push_back(share);
        }
      for (unsigned int phase = 0; phase < phase_names.size(); ++phase)
        {
          const auto &seconds                          = over_ranks[first_of_phases + phase];
          json["seconds_of_ranks"][phase_names[phase]] = {{"most", seconds.max},
                                                          {"mean", seconds.avg}};
        }
    }


    /** Cube root of the volume per cell, or square root of the area per triangle [m]. */
    double
    cell_size(const Mesh &mesh)
    {
      const double volume = mesh.volume / mesh.n_cells;
      if (!mesh.section.plane())
        return std::cbrt(volume);
      const auto &[low, high] = mesh.bounding_box.get_boundary_points();
      return std::sqrt(volume / mesh.section.thickness_at(0.5 * (low[0] + high[0])));
    }
  } // namespace


  std::string
  Summary::to_json(const Parameters &parameters, const Model &model) const
  {
    const Effort &effort = model.effort;
    Json json;
    json["scene"]    = parameters.scene_name;
    json["status"]   = status;
    json["warnings"] = warnings;

    json["cells"]     = model.body.mesh.n_cells;
    json["vertices"]  = model.body.mesh.n_vertices;
    json["dofs"]      = model.body.n_dofs();
    json["volume"]    = model.body.mesh.volume;
    json["cell_size"] = cell_size(model.body.mesh);
    json["held"]      = model.constraints.n_held;
    json["ranks"]     = dealii::Utilities::MPI::n_mpi_processes(model.body.mesh.communicator);
    json["threads"] =
      dealii::Utilities::MPI::max(model.body.n_threads, model.body.mesh.communicator);
    json["method"] = integrator;
    if (stable_step)
      json["stable_step"] = {{"step", stable_step->step},
                             {"frequency", stable_step->frequency},
                             {"limit", stable_step->limit}};
    json["solver"] = solutions(model, parameters.solver.tolerance);

    json["steps"]            = steps;
    json["rejected_steps"]   = effort.rejected_steps;
    json["failed_steps"]     = effort.failed_steps;
    json["steps_per_second"] = run_seconds > 0. ? steps / run_seconds : 0.;
    Json &seconds            = json["seconds"];
    seconds["setup"]         = setup_seconds;
    seconds["run"]           = run_seconds;
    for (unsigned int phase = 0; phase < phase_names.size(); ++phase)
      seconds[phase_names[phase]] = effort.seconds[phase];

    if (dealii::Utilities::MPI::n_mpi_processes(model.body.mesh.communicator) > 1)
      add_ranks(json, model);

    if (model.implicit_operator.has_mass())
      json["error_estimate"] = errors(*this);
    if (observed)
      {
        json["last"]     = energies(last);
        json["extremes"] = {{"energy_rises", extremes.energy_rises},
                            {"energy_risen", extremes.energy_risen},
                            {"most_inverted", extremes.most_inverted},
                            {"min_volume_ratio", extremes.min_volume_ratio},
                            {"max_volume_ratio", extremes.max_volume_ratio},
                            {"not_finite", extremes.not_finite}};
      }
    json["distance_from_rest"]   = distance_from_rest;
    json["distance_from_shape"]  = distance_from_shape;
    json["relative_to_diameter"] = {
      {"distance_from_rest", distance_from_rest / model.body.mesh.diameter()},
      {"distance_from_shape", distance_from_shape / model.body.mesh.diameter()}};
    json["built"]    = what_was_built(*this, model);
    json["versions"] = {{"supple", SUPPLE_VERSION},
                        {"deal.II", DEAL_II_PACKAGE_VERSION},
                        {"SUNDIALS", SUNDIALS_VERSION}};
    return json.dump(2) + "\n";
  }
} // namespace Supple
