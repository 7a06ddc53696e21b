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
  EnergyGuard::start(const double time)
  {
    first   = energy(time);
    largest = std::max(largest, std::abs(first));
  }


  bool
  EnergyGuard::rises(const double time, const double work)
  {
    last    = energy(time);
    largest = std::max({largest, std::abs(last), std::abs(work)});
    return !(last - first - work <= energy_accuracy * largest);
  }


  void
  EnergyGuard::accept()
  {
    first = last;
  }


  double
  EnergyGuard::energy(const double time) const
  {
    const Configuration &configuration = model.configuration;
    Deformation deformation;
    const Energies energies = model.forces.energies(configuration, time, 1., deformation);
    const GhostValues displacement(configuration.displacement()),
      velocity(configuration.velocity());
    const MotionSums motion = model.body.cells->motion(displacement.data(), velocity.data());
    return dealii::Utilities::MPI::sum(motion.kinetic, model.body.mesh.communicator) +
           energies.elastic + energies.potential;
  }
} // namespace Supple
