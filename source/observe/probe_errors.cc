#include <supple/observe/probe_errors.h>

#include <supple/mechanics/quadratic_cells.h>

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
  ProbeErrors::recover(const std::vector<Matrix3<Pack>> &of_points,
                       const std::vector<double> &more) const
  {
    const Cells &cells          = *configuration.body.cells;
    const unsigned int n_points = cells.n_points();
    std::array<std::vector<Octet>, 2> octets;
    for (std::vector<Octet> &half : octets)
      half.assign(n_points * cells.n_cells, Octet{});
    for (std::size_t place = 0; place < of_points.size(); ++place)
      cells.for_lanes(place / n_points, [&](const unsigned int lane, const std::size_t cell) {
        const std::size_t point = n_points * cell + place % n_points;
        for (unsigned int k = 0; k < 8; ++k)
          octets[0][point].lanes[k] = of_points[place].entries[k][lane];
        octets[1][point].lanes[0] = of_points[place].entries[8][lane];
        if (!more.empty())
          octets[1][point].lanes[1] = more[point];
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
    const Cells &cells          = *configuration.body.cells;
    const unsigned int n_points = cells.n_points();
    std::vector<Matrix3<Pack>> all(n_points * cells.n_batches());
    const GhostValues u(configuration.displacement());
    cells.for_batches([&](const std::size_t b) {
      const auto of_batch = gradients_at_points(cells, b, z);
      std::copy(of_batch.begin(), of_batch.end(), all.begin() + n_points * b);
      if (growth_of_dual.empty())
        return;
      const auto F = deformation_gradients_at_points(cells, b, u.data());
      for (unsigned int q = 0; q < n_points; ++q)
        {
          const std::size_t place = n_points * b + q;
          Pack missing(0.); // of the change of volume
          cells.for_lanes(b, [&](const unsigned int lane, const std::size_t cell) {
            const VolumetricPatches::Growth &of_point = growth_of_dual[n_points * cell + q];
            missing[lane]                             = of_point.patch - of_point.cell;
          });
          const Matrix3<Pack> H = volume_gradient(configuration.rotations.current,
                                                  configuration.patches->measure,
                                                  place,
                                                  F[q]);
          const Pack square     = norm_square(H);
          for (unsigned int k = 0; k < 9; ++k)
            all[place].entries[k] += missing / square * H.entries[k];
        }
    });
    return all;
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
    const unsigned int n_points = body.cells->n_points();
    for (std::size_t point = 0; point < growth_of_dual.size(); ++point)
      {
        const IsotropicMaterial &material = body.material(body.cell_material[point / n_points]);
        mean_of_dual.push_back((body.is_quadratic() ? material.lambda : material.bulk()) *
                               growth_of_dual[point].patch);
      }
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
        for (unsigned int q = 0; q < n_points; ++q)
          {
            const auto &of_dual   = growth_of_dual[n_points * c + q],
                       &of_body   = growth[n_points * c + q];
            const double own      = recovery.difference_at(space_error.recovered(), c, q).lanes[6];
            const double dual_own = recovery.difference_at(gradient[1], c, q).lanes[1];
            sum -= recovery.volume(c, q) * (own * (of_dual.cell - of_dual.patch) +
                                            dual_own * (of_body.cell - of_body.patch));
          }
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
