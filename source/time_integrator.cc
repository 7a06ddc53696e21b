#include <supple/backward_euler.h>
#include <supple/static_equilibrium.h>
#include <supple/time_integrator.h>

namespace Supple
{
  TimeIntegrator::TimeIntegrator(const Model &model)
    : model(model)
  {
    model.body.initialize(reaction);
  }


  std::unique_ptr<TimeIntegrator>
  TimeIntegrator::create(const Model &model, const Vector &displacement)
  {
    model.body.update_rotations(displacement, model.effort);
    if (model.parameters.time.problem == TimeParameters::Problem::stationary)
      return std::make_unique<StaticEquilibrium>(model);
    return std::make_unique<BackwardEuler>(model);
  }


  void
  TimeIntegrator::set_reactions(const Vector &force)
  {
    for (const unsigned int dof : model.constraints.owned())
      reaction.local_element(dof) = force.local_element(dof);
  }
} // namespace Supple
