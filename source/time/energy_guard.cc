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
  EnergyGuard::start(const double time, const Vector &momentum)
  {
    first   = energy(time, momentum);
    largest = std::max(largest, std::abs(first));
  }


  bool
  EnergyGuard::rises(const StepReport &report)
  {
    last    = energy(report.time, *report.momentum);
    largest = std::max({largest, std::abs(last), std::abs(report.load_work)});
    return !(last - first - report.load_work <= energy_accuracy * largest);
  }


  void
  EnergyGuard::accept()
  {
    first = last;
  }


  double
  EnergyGuard::energy(const double time, const Vector &momentum) const
  {
    const Configuration &configuration = model.configuration;
    Deformation deformation;
    const Energies energies = model.forces.energies(configuration, time, 1., deformation);
    const MotionSums motion = model.body.cells->motion(configuration.displacement().begin(),
                                                       configuration.velocity().begin(),
                                                       momentum.begin());
    return dealii::Utilities::MPI::sum(motion.kinetic, model.body.mesh.communicator) +
           energies.elastic + energies.potential + energies.contact;
  }
} // namespace Supple
