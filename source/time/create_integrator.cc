#include <supple/time/create_integrator.h>

#include <supple/time/arkode_integrator.h>
#include <supple/time/ida_integrator.h>
#include <supple/time/static_equilibrium.h>

namespace Supple
{
  std::unique_ptr<TimeIntegrator>
  create_integrator(const Model &model, const Vector &displacement)
  {
    model.body.update_rotations(displacement, model.effort);
    if (model.parameters.time.problem == TimeParameters::Problem::stationary)
      return std::make_unique<StaticEquilibrium>(model);
    if (model.parameters.time.method == TimeParameters::Method::ida)
      return std::make_unique<IdaIntegrator>(model);
    return std::make_unique<ArkodeIntegrator>(model);
  }
} // namespace Supple
