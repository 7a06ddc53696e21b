#include <supple/run/summary.h>

#include <supple/observe/diagnostics.h>

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


    Summary::Size
    size_of(const Model &model)
    {
      const Mesh &mesh = model.body.mesh;
      Summary::Size size;
      size.cells     = mesh.n_cells;
      size.vertices  = mesh.n_vertices;
      size.dofs      = model.body.n_dofs();
      size.held      = model.constraints.n_held;
      size.ranks     = dealii::Utilities::MPI::n_mpi_processes(mesh.communicator);
      size.threads   = dealii::Utilities::MPI::max(model.body.n_threads, mesh.communicator);
      size.volume    = mesh.volume;
      size.cell_size = cell_size(mesh);
      size.diameter  = mesh.diameter();
      return size;
    }


    Summary::Spread
    spread_of(const Model &model)
    {
      const MPI_Comm communicator         = model.body.mesh.communicator;
      const std::vector<LocalCell> &cells = model.body.mesh.parts->cells;
      std::vector<double> values          = {
                 double(
          std::count_if(cells.begin(), cells.end(), [](const auto &cell) { return cell.owned; })),
                 double(model.body.n_local - model.body.n_owned)};
      values.insert(values.end(), model.effort.seconds.begin(), model.effort.seconds.end());
      const auto over_ranks = dealii::Utilities::MPI::min_max_avg(values, communicator);

      Summary::Spread spread;
      spread.cells          = over_ranks[0];
      spread.ghost_vertices = over_ranks[1];
      spread.seconds.assign(over_ranks.begin() + 2, over_ranks.end());
      for (const auto &level : model.solver.coarse_levels())
        spread.coarse_levels.emplace_back(level.n_nodes,
                                          dealii::Utilities::MPI::min_max_avg(double(level.n_owned),
                                                                              communicator));
      return spread;
    }


    Json
    what_was_built(const Summary &summary)
    {
      const Effort &effort = summary.effort;
      Json built           = {{"mass_matrix", summary.has_mass},
                              {"damping_matrix", summary.damped},
                              {"rotations_computed", effort.rotations_computed},
                              {"assemblies", effort.assemblies},
                              {"cells_warped", effort.cells_warped},
                              {"factorizations", effort.factorizations},
                              {"multigrid_hierarchies", effort.hierarchies},
                              {"parallel", summary.size.ranks > 1},
                              {"energies_measured", summary.observed},
                              {"history", summary.history},
                              {"probes", summary.probes},
                              {"frames", summary.frames}};
      if (summary.tools > 0)
        built["tools"] = summary.tools;
      return built;
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


    Json
    contact(const Summary &summary)
    {
      const Measurement::Contact &last = *summary.last.contact;
      const std::vector<double> &gaps  = summary.extremes.gaps;
      return {{"min_gap",
               gaps.empty() ? last.min_gap : *std::min_element(gaps.begin(), gaps.end())},
              {"energy", last.energy},
              {"rubbed", last.rubbed},
              {"creep", last.creep},
              {"releases", summary.extremes.releases}};
    }


    Json
    worst(const Extremes &extremes)
    {
      return {{"energy_rises", extremes.energy_rises},
              {"energy_risen", extremes.energy_risen},
              {"energy_gained", extremes.energy_gained},
              {"most_inverted", extremes.most_inverted},
              {"min_volume_ratio", extremes.min_volume_ratio},
              {"max_volume_ratio", extremes.max_volume_ratio},
              {"not_finite", extremes.not_finite}};
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
                   {"relative", relative(summary.error_estimate)},
                   {"energy_lost", summary.energy_lost_by_steps()}};
      if (const StepDoubling *const doubling = summary.step_doubling)
        {
          Json &second = json["step_doubling"];
          second = {{"second_run", doubling->steps_in_words()}, {"seconds", doubling->seconds()}};
          if (doubling->failure().empty())
            second.update({{"largest", doubling->best()},
                           {"at_the_end", doubling->last},
                           {"relative", relative(doubling->best())},
                           {"order_of_method", doubling->order}});
          else
            second["failed"] = doubling->failure();
          if (doubling->observed())
            {
              second["by_second_run"] = doubling->largest;
              second["at_least"]      = doubling->observed()->at_least;
              if (doubling->observed()->order)
                second["order"] = *doubling->observed()->order;
            }
          if (!doubling->third_failure().empty())
            second["third_failed"] = doubling->third_failure();
        }
      return json;
    }


    Json
    solutions(const Summary &summary)
    {
      const Summary::Solver &solver = summary.solver;
      const Effort &effort          = summary.effort;
      Json json                     = {{"name", solver.name},
                                       {"reason", solver.reason},
                                       {"tolerance", solver.tolerance},
                                       {"max_relative_residual", effort.max_relative_residual},
                                       {"solves", effort.solves},
                                       {"iterations", effort.linear_iterations},
                                       {"newton_iterations", effort.newton_iterations}};
      if (!solver.stand_in.empty())
        json["stand_in"] = {{"name", solver.stand_in}, {"solves", effort.stand_in_solves}};
      return json;
    }


    void
    add_spread(Json &json, const Summary::Spread &spread)
    {
      const auto range = [](const Summary::Spread::Range &number) -> Json {
        return {{"least", std::lround(number.min)}, {"most", std::lround(number.max)}};
      };
      json["partition"] = {{"cells", range(spread.cells)},
                           {"ghost_vertices", range(spread.ghost_vertices)}};
      for (const auto &[n_nodes, n_owned] : spread.coarse_levels)
        {
          Json share     = range(n_owned);
          share["nodes"] = n_nodes;
          json["partition"]["coarse_levels"].push_back(share);
        }
      for (unsigned int phase = 0; phase < phase_names.size(); ++phase)
        json["seconds_of_ranks"][phase_names[phase]] = {{"most", spread.seconds[phase].max},
                                                        {"mean", spread.seconds[phase].avg}};
    }


    /** Not a number becomes null. */
    Json
    refinement(const std::vector<RefinementParameters::Pilot> &pilots)
    {
      Json list;
      for (const RefinementParameters::Pilot &pilot : pilots)
        list.push_back({{"cells", pilot.cells},
                        {"dofs", pilot.dofs},
                        {"of", pilot.of},
                        {"error", pilot.error},
                        {"seconds", pilot.seconds}});
      return list;
    }


    void
    add_steps(Json &json, const Summary &summary)
    {
      json["steps"]          = summary.steps;
      json["rejected_steps"] = summary.effort.rejected_steps;
      json["failed_steps"]   = summary.effort.failed_steps;
      json["steps_per_second"] =
        summary.run_seconds > 0. ? summary.steps / summary.run_seconds : 0.;
      Json &seconds    = json["seconds"];
      seconds["setup"] = summary.setup_seconds;
      seconds["run"]   = summary.run_seconds;
      if (summary.space_errors)
        seconds["error_in_space"] = summary.estimate_seconds;
      for (unsigned int phase = 0; phase < phase_names.size(); ++phase)
        seconds[phase_names[phase]] = summary.effort.seconds[phase];
    }
  } // namespace


  Summary::Summary(const Parameters &parameters, const Model &model)
    : scene(parameters.scene_name)
    , size(size_of(model))
    , effort(model.effort)
    , has_mass(model.implicit_operator.has_mass())
    , tools(parameters.tools.size())
    , damped(model.damping.any())
    , pilots(parameters.mesh.refinement.pilots)
  {
    solver = {model.solver.name(),
              model.solver.reason,
              model.solver.stand_in_name(),
              model.solver.tolerance()};
    if (size.ranks > 1)
      spread = spread_of(model);
    const Vector &displacement = model.configuration.displacement();
    Vector rest;
    model.body.initialize(rest);
    distance_from_rest  = largest_vertex_distance(displacement, rest);
    distance_from_shape = Supple::distance_from_shape(model.body, displacement);
  }


  Json
  Summary::to_json() const
  {
    Json json;
    json["scene"]    = scene;
    json["status"]   = status;
    json["warnings"] = warnings;

    json["cells"]     = size.cells;
    json["vertices"]  = size.vertices;
    json["dofs"]      = size.dofs;
    json["volume"]    = size.volume;
    json["cell_size"] = size.cell_size;
    json["held"]      = size.held;
    json["ranks"]     = size.ranks;
    json["threads"]   = size.threads;
    json["method"]    = integrator;
    if (stable_step)
      json["stable_step"] = {{"step", stable_step->step},
                             {"frequency", stable_step->frequency},
                             {"limit", stable_step->limit}};
    json["solver"] = solutions(*this);

    add_steps(json, *this);
    if (spread)
      add_spread(json, *spread);
    if (!pilots.empty())
      json["pilot_runs"] = refinement(pilots);
    if (has_mass)
      json["error_estimate"] = errors(*this);
    if (space_errors)
      json["error_estimate"]["space"] = space_errors->to_json();
    if (second_mesh)
      json["error_estimate"]["second_mesh"] = second_mesh->to_json(cells_lock());
    if (observed)
      {
        json["last"]     = energies(last);
        json["extremes"] = worst(extremes);
      }
    json["distance_from_rest"]   = distance_from_rest;
    json["distance_from_shape"]  = distance_from_shape;
    json["relative_to_diameter"] = {{"distance_from_rest", distance_from_rest / size.diameter},
                                    {"distance_from_shape", distance_from_shape / size.diameter}};
    if (last.contact)
      json["contact"] = contact(*this);
    json["built"]    = what_was_built(*this);
    json["versions"] = {{"supple", SUPPLE_VERSION},
                        {"deal.II", DEAL_II_PACKAGE_VERSION},
                        {"SUNDIALS", SUNDIALS_VERSION}};
    return json;
  }


  std::map<std::string, double>
  Summary::numbers() const
  {
    std::map<std::string, double> all;
    const Json flat = to_json().flatten(); // "/solver/solves"
    for (const auto &[place, value] : flat.items())
      if (value.is_number())
        all[place.substr(1)] = value.get<double>();
    return all;
  }
} // namespace Supple
