#include <supple/time/create_integrator.h>

#include <supple/time/arkode_integrator.h>
#include <supple/time/ida_integrator.h>
#include <supple/time/static_equilibrium.h>

namespace Supple
{
  std::unique_ptr<TimeIntegrator>
  create_integrator(const Model &model)
  {
    model.configuration.update_rotations(model.effort);
    if (model.time.problem == TimeParameters::Problem::stationary)
      return std::make_unique<StaticEquilibrium>(model);
    if (model.time.method == TimeMethod::ida)
      return std::make_unique<IdaIntegrator>(model);
    return std::make_unique<ArkodeIntegrator>(model);
  }
} // namespace Supple
