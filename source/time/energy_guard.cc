#include <supple/time/energy_guard.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  EnergyGuard::EnergyGuard(const Model &model)
    : model(model)
  {
  }


  void
  EnergyGuard::start(const State &state)
  {
    first   = energy(state);
    largest = std::max(largest, std::abs(first));
  }


  bool
  EnergyGuard::rises(const State &state, const double work)
  {
    last    = energy(state);
    largest = std::max({largest, std::abs(last), std::abs(work)});
    return !(last - first - work <= energy_accuracy * largest);
  }


  void
  EnergyGuard::accept()
  {
    first = last;
  }


  double
  EnergyGuard::energy(const State &state) const
  {
    const GhostValues displacement(state.block(0)), velocity(state.block(1));
    const CellSums sums = model.body.sums(displacement.data(), velocity.data());
    return dealii::Utilities::MPI::sum(sums.kinetic + sums.elastic, model.body.mesh.communicator) +
           model.loads.potential(state.block(0));
  }
} // namespace Supple
