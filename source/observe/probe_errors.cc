#include <supple/observe/probe_errors.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using namespace dealii;

  ProbeErrors::ProbeErrors(const SpaceError &space_error,
                           const Configuration &configuration,
                           Forces &forces,
                           ImplicitOperator &implicit_operator,
                           LinearSolver &solver,
                           Effort &effort)
    : space_error(space_error)
    , configuration(configuration)
    , implicit_operator(implicit_operator)
    , solver(solver)
    , effort(effort)
    , stress(recover(space_error.stresses().piola, {}))
  {
    configuration.body.initialize(load);
    configuration.body.initialize(dual);
    if (configuration.patches)
      {
        const GhostValues u(configuration.displacement());
        growth = configuration.patches->growth(u.data());
      }
    prepare(forces);
  }


  void
  ProbeErrors::prepare(Forces &forces)
  {
    const bool known = effort.assemblies > 0; // of the last load step
    if (known && !forces.change_operator())
      return;
    forces.update_tangent(Tangent::consistent, configuration, 1., effort);
    implicit_operator.assemble_stiffness();
    solver.prepare(configuration.displacement());
  }


  ProbeErrors::MatrixField
  ProbeErrors::recover(const std::vector<Matrix3<Pack>> &of_batches,
                       const std::vector<double> &more) const
  {
    const Cells &cells = *configuration.body.cells;
    std::array<std::vector<Octet>, 2> octets;
    for (std::vector<Octet> &half : octets)
      half.assign(cells.n_cells, Octet{});
    for (std::size_t b = 0; b < cells.n_batches(); ++b)
      cells.for_lanes(b, [&](const unsigned int lane, const std::size_t cell) {
        for (unsigned int k = 0; k < 8; ++k)
          octets[0][cell].lanes[k] = of_batches[b].entries[k][lane];
        octets[1][cell].lanes[0] = of_batches[b].entries[8][lane];
        if (!more.empty())
          octets[1][cell].lanes[1] = more[cell];
      });
    return {{space_error.recovery.recover(std::move(octets[0])),
             space_error.recovery.recover(std::move(octets[1]))}};
  }


  std::vector<std::pair<Probes::Component, double>>
  ProbeErrors::chosen(const Probes &probes, const PointForces &points) const
  {
    constexpr double least = 0.01; // of the probe's whole displacement

    const Vector &u                                 = configuration.displacement();
    const std::vector<Probes::Component> components = probes.displacement_components();
    std::vector<double> here(2 * components.size()), all(here.size()); // values, and what is held
    for (std::size_t k = 0; k < components.size(); ++k)
      for (const unsigned int dof : components[k].dofs)
        {
          here[2 * k] += components[k].weight * u.local_element(dof);
          here[2 * k + 1] += implicit_operator.constraints.holds(dof) || points.load(dof);
        }
    Utilities::MPI::sum(here, configuration.body.mesh.communicator, all);

    std::vector<std::pair<Probes::Component, double>> list;
    for (std::size_t k = 0; k < components.size(); ++k)
      {
        double square    = 0.;
        std::size_t main = k;
        for (std::size_t i = k / 3 * 3; i < k / 3 * 3 + 3; ++i)
          {
            square += all[2 * i] * all[2 * i];
            if (std::abs(all[2 * i]) > std::abs(all[2 * main]))
              main = i;
          }
        if (all[2 * main + 1] == 0. && all[2 * k + 1] == 0. && all[2 * k] != 0. &&
            std::abs(all[2 * k]) >= least * std::sqrt(square))
          list.emplace_back(components[k], all[2 * k]);
      }
    std::stable_sort(list.begin(), list.end(), [](const auto &a, const auto &b) {
      return std::abs(a.second) > std::abs(b.second);
    });
    return list;
  }


  void
  ProbeErrors::solve(const Probes::Component &component)
  {
    load = 0.;
    for (const unsigned int dof : component.dofs)
      load.local_element(dof) = component.weight;
    dual = 0.;
    solver.solve(dual, load);
  }


  std::vector<Matrix3<Pack>>
  ProbeErrors::dual_gradient(const double *z,
                             const std::vector<VolumetricPatches::Growth> &growth_of_dual) const
  {
    const Cells &cells = *configuration.body.cells;
    std::vector<Matrix3<Pack>> gradients(cells.n_batches());
    const GhostValues u(configuration.displacement());
    cells.for_batches([&](const std::size_t b) {
      gradients[b] = cells.gradient(b, Cells::gather(cells.batch(b), z));
      if (growth_of_dual.empty())
        return;
      Pack missing(0.); // of the change of volume
      cells.for_lanes(b, [&](const unsigned int lane, const std::size_t cell) {
        missing[lane] = growth_of_dual[cell].patch - growth_of_dual[cell].cell;
      });
      const Matrix3<Pack> H = volume_gradient(configuration.rotations.current,
                                              configuration.patches->measure,
                                              b,
                                              cells.deformation_gradient(b, u.data()));
      const Pack square     = norm_square(H);
      for (unsigned int k = 0; k < 9; ++k)
        gradients[b].entries[k] += missing / square * H.entries[k];
    });
    return gradients;
  }


  double
  ProbeErrors::weight(const MatrixField &gradient, const std::size_t cell) const
  {
    const auto square = [&](const MatrixField &x) {
      const Octet most = space_error.recovery.product(x[0], x[0], cell);
      double sum       = space_error.recovery.product(x[1], x[1], cell).lanes[0];
      for (unsigned int k = 0; k < 8; ++k)
        sum += most.lanes[k];
      return sum;
    };
    return std::sqrt(square(stress) * square(gradient));
  }


  double
  ProbeErrors::error_by_dual()
  {
    const Body &body         = configuration.body;
    const Recovery &recovery = space_error.recovery;
    const GhostValues z(dual);
    std::vector<VolumetricPatches::Growth> growth_of_dual;
    std::vector<double> mean_of_dual; // s_z [Pa]
    if (configuration.patches)
      growth_of_dual = configuration.patches->growth_by_change(z.data());
    for (std::size_t c = 0; c < growth_of_dual.size(); ++c)
      mean_of_dual.push_back(body.material(body.cell_material[c]).bulk() * growth_of_dual[c].patch);
    const MatrixField gradient = recover(dual_gradient(z.data(), growth_of_dual), mean_of_dual);

    weights.assign(body.cell_nodes.size(), 0.);
    double sum = 0.;
    for (std::size_t c = 0; c < body.cell_nodes.size(); ++c)
      {
        if (!body.cell_owned[c])
          continue;
        weights[c]       = weight(gradient, c);
        const Octet most = recovery.product(stress[0], gradient[0], c);
        for (unsigned int k = 0; k < 8; ++k)
          sum += most.lanes[k];
        sum += recovery.product(stress[1], gradient[1], c).lanes[0];
        if (growth.empty())
          continue;
        const double own     = recovery.mean_difference(space_error.recovered(), c).lanes[6];
        const double of_dual = recovery.mean_difference(gradient[1], c).lanes[1];
        sum -= recovery.volume(c) * (own * (growth_of_dual[c].cell - growth_of_dual[c].patch) +
                                     of_dual * (growth[c].cell - growth[c].patch));
      }
    return Utilities::MPI::sum(sum, body.mesh.communicator);
  }


  ProbeError
  ProbeErrors::find_of_work(const Vector &loads)
  {
    load = loads;
    for (const unsigned int dof : implicit_operator.constraints.owned())
      load.local_element(dof) = 0.;
    dual = 0.;
    solver.solve(dual, load);
    return {"the work of the loads", load * configuration.displacement(), error_by_dual()};
  }


  std::vector<ProbeError>
  ProbeErrors::find(const Probes &probes, const PointForces &points, const std::string &only)
  {
    std::vector<ProbeError> errors;
    std::vector<std::pair<Probes::Component, double>> solved; // with their errors
    const auto is_the_same = [this](const Probes::Component &a, const Probes::Component &b) {
      const bool here = a.dofs == b.dofs && a.weight == b.weight;
      return Utilities::MPI::min(here ? 1 : 0, configuration.body.mesh.communicator) == 1;
    };
    for (const auto &[component, value] : chosen(probes, points))
      {
        if (!only.empty() && component.name != only)
          continue;
        const auto same  = std::find_if(solved.begin(), solved.end(), [&](const auto &other) {
          return is_the_same(component, other.first);
        });
        const bool known = same != solved.end();
        if (!known)
          {
            solve(component);
            solved.emplace_back(component, error_by_dual());
          }
        errors.push_back({component.name, value, known ? same->second : solved.back().second});
      }
    return errors;
  }
} // namespace Supple
