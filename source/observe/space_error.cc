#include <supple/observe/space_error.h>

#include <supple/observe/stress_jumps.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

namespace Supple
{
  using namespace dealii;

  double
  EnergyError::relative_norm() const
  {
    return std::sqrt(square / (2. * strain_energy + square));
  }


  double
  EnergyError::of_energy() const
  {
    return std::max(0., square + of_patches);
  }


  double
  EnergyError::of_work() const
  {
    return of_energy() / (2. * strain_energy + of_energy());
  }


  double
  EnergyError::of_forces() const
  {
    return of_energy() < 2. * strain_energy ? of_energy() / (2. * strain_energy - of_energy())
                                            : std::numeric_limits<double>::infinity();
  }


  double
  EnergyError::of_frequency() const
  {
    return std::sqrt(1. + of_energy() / (2. * strain_energy)) - 1.;
  }


  bool
  EnergyError::locks() const
  {
    return lock_ratio.value_or(0.) > 2.;
  }


  bool
  EnergyError::is_unknown_by_locking() const
  {
    return lock_ratio.value_or(0.) > 5.;
  }


  SpaceError::SpaceError(const Configuration &configuration, const ElasticForce &elastic)
    : recovery(configuration.body)
    , configuration(configuration)
    , elastic(elastic)
  {
  }


  bool
  SpaceError::may_lock(const unsigned int material) const
  {
    constexpr double safe = 0.4; // Poisson's ratio
    return configuration.body.material(material).poisson() > safe &&
           configuration.body.mesh.section.geometry != Geometry::plane_stress;
  }


  std::optional<double>
  SpaceError::lock_ratio() const
  {
    const Body &body = configuration.body;
    if (!(error.square > 0.) || body.is_quadratic() ||
        std::none_of(body.mesh.materials.begin(),
                     body.mesh.materials.end(),
                     [&](const auto &material) { return may_lock(material.first); }))
      return {};
    double here = 0.;
    for (std::size_t c = 0; c < squares.size(); ++c)
      if (may_lock(body.cell_material[c]))
        here += squares[c];
    const double square = Utilities::MPI::sum(here, body.mesh.communicator);
    const double jumps  = jump_estimate(body, stress->piola, [this](const unsigned int material) {
      return may_lock(material);
    });
    // What has no part in the error does not lock.
    constexpr double little = 1e-6;
    if (!(square > little * error.square))
      return {};
    return std::sqrt(jumps / square);
  }


  const EnergyError &
  SpaceError::estimate()
  {
    const Body &body = configuration.body;
    stress.emplace(configuration, elastic.cell_law());
    field = recovery.recover(std::move(stress->turned));
    find_indicators();

    const Deformation deformation  = elastic.deformation(configuration);
    const std::vector<double> here = {std::accumulate(squares.begin(), squares.end(), 0.),
                                      part_of_patches(),
                                      deformation.elastic,
                                      double(deformation.inverted)};
    std::vector<double> sums(here.size());
    Utilities::MPI::sum(here, body.mesh.communicator, sums);
    error            = {sums[0], sums[1], sums[2], {}, static_cast<unsigned int>(sums[3])};
    error.lock_ratio = lock_ratio();
    error.rough      = recovery.is_rough();
    return error;
  }


  void
  SpaceError::find_indicators()
  {
    const Body &body = configuration.body;
    std::map<unsigned int, Octet> compliances; // by material id
    for (const auto &[id, n_cells] : body.mesh.materials)
      {
        const IsotropicMaterial &material = body.material(id);
        Octet &compliance                 = compliances[id];
        for (unsigned int k = 0; k < 8; ++k)
          compliance.lanes[k] = k < 6 ? 0.5 / material.mu : k == 6 ? 1. / material.bulk() : 0.;
      }
    squares.assign(body.cell_nodes.size(), 0.);
    auto compliance = compliances.begin(); // of the cell before
    for (std::size_t c = 0; c < squares.size(); ++c)
      {
        if (!body.cell_owned[c])
          continue;
        if (compliance->first != body.cell_material[c])
          compliance = compliances.find(body.cell_material[c]);
        Octet energy = recovery.product(field, field, c);
        energy.lanes *= compliance->second.lanes;
        for (unsigned int k = 0; k < 7; ++k)
          squares[c] += energy.lanes[k];
      }
  }


  double
  SpaceError::part_of_patches() const
  {
    if (!configuration.patches)
      return 0.;
    const Body &body = configuration.body;
    const GhostValues u(configuration.displacement());
    const auto growth           = configuration.patches->growth(u.data());
    double sum                  = 0.;
    const unsigned int n_points = body.cells->n_points();
    for (std::size_t c = 0; c < body.cell_nodes.size(); ++c)
      {
        const IsotropicMaterial &material = body.material(body.cell_material[c]);
        const double kept = body.is_quadratic() ? material.without_lambda().bulk() : 0.;
        const double part = 1. - kept / material.bulk(); // of the resistance is in the patches
        for (unsigned int q = 0; q < n_points && body.cell_owned[c]; ++q)
          {
            const auto &[of_cell, of_patch] = growth[n_points * c + q];
            const double missing            = of_patch - of_cell;
            sum += part * recovery.volume(c, q) * missing *
                   (2. * recovery.difference_at(field, c, q).lanes[6] - kept * missing);
          }
      }
    return sum;
  }


  std::vector<float>
  SpaceError::of_cells() const
  {
    const Body &body  = configuration.body;
    const double mean = (2. * error.strain_energy + error.square) / body.mesh.volume;
    std::vector<float> of_cells(body.mesh.parts->n_cells);
    for (std::size_t c = 0; c < squares.size(); ++c)
      of_cells[body.cell_index[c]] = std::sqrt(squares[c] / recovery.volume(c) / mean);
    return of_cells;
  }
} // namespace Supple
