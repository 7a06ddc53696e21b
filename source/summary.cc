#include <supple/summary.h>

#include <deal.II/base/config.h>
#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <sundials/sundials_version.h>

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
              {"damping_matrix", model.parameters.damping.any()},
              {"rotations_computed", effort.rotations_computed},
              {"assemblies", effort.assemblies},
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
  } // namespace


  std::string
  Summary::to_json(const Model &model) const
  {
    const Effort &effort = model.effort;
    Json json;
    json["scene"]    = model.parameters.scene_name;
    json["status"]   = status;
    json["warnings"] = warnings;

    json["cells"]    = model.body.mesh.n_cells;
    json["vertices"] = model.body.mesh.n_vertices;
    json["dofs"]     = model.body.dof_handler.n_dofs();
    json["held"]     = model.constraints.n_held;
    json["ranks"]    = dealii::Utilities::MPI::n_mpi_processes(model.body.mesh.communicator);
    json["method"]   = integrator;
    if (stable_step)
      json["stable_step"] = {{"step", stable_step->step},
                             {"frequency", stable_step->frequency},
                             {"limit", stable_step->limit}};
    json["solver"] = {{"name", model.solver.name()},
                      {"reason", model.solver.reason},
                      {"tolerance", model.parameters.solver.tolerance},
                      {"max_relative_residual", effort.max_relative_residual},
                      {"solves", effort.solves},
                      {"iterations", effort.linear_iterations},
                      {"newton_iterations", effort.newton_iterations}};

    json["steps"]            = steps;
    json["rejected_steps"]   = effort.rejected_steps;
    json["steps_per_second"] = run_seconds > 0. ? steps / run_seconds : 0.;
    Json &seconds            = json["seconds"];
    seconds["setup"]         = setup_seconds;
    seconds["run"]           = run_seconds;
    for (unsigned int phase = 0; phase < phase_names.size(); ++phase)
      seconds[phase_names[phase]] = effort.seconds[phase];

    if (model.implicit_operator.has_mass())
      {
        // Not a number, where the method has no estimate, becomes null.
        json["error_estimate"] = {{"sum_of_local_errors", error_estimate},
                                  {"largest_motion", largest_motion},
                                  {"relative",
                                   largest_motion > 0. ? error_estimate / largest_motion : 0.}};
      }
    if (observed)
      json["last"] = energies(last);
    json["built"]    = what_was_built(*this, model);
    json["versions"] = {{"supple", SUPPLE_VERSION},
                        {"deal.II", DEAL_II_PACKAGE_VERSION},
                        {"SUNDIALS", SUNDIALS_VERSION}};
    return json.dump(2) + "\n";
  }
} // namespace Supple
