#include <supple/forces/loads.h>
#include <supple/mechanics/body.h>
#include <supple/time/arkode_integrator.h>
#include <supple/time/ida_integrator.h>
#include <supple/time/static_equilibrium.h>
#include <supple/time/time_integrator.h>

#include <nlohmann/json.hpp>

namespace Supple
{
  TimeIntegrator::TimeIntegrator(const Model &model, const double end)
    : end(end)
    , model(model)
  {
    model.body.initialize(reaction);
  }


  bool
  Model::forces_are_linear() const
  {
    return body.rotation == RotationMethod::none && !loads.follow();
  }


  std::unique_ptr<TimeIntegrator>
  TimeIntegrator::create(const Model &model, const Vector &displacement)
  {
    model.body.update_rotations(displacement, model.effort);
    if (model.time.problem == TimeParameters::Problem::stationary)
      return std::make_unique<StaticEquilibrium>(model);
    if (model.time.method == TimeMethod::ida)
      return std::make_unique<IdaIntegrator>(model);
    return std::make_unique<ArkodeIntegrator>(model);
  }


  nlohmann::json
  TimeIntegrator::save()
  {
    return {{"time", time}};
  }


  void
  TimeIntegrator::load(const nlohmann::json &saved)
  {
    time = saved.at("time");
  }


  void
  TimeIntegrator::set_reactions(const Vector &force)
  {
    for (const unsigned int dof : model.constraints.owned())
      reaction.local_element(dof) = force.local_element(dof);
  }
} // namespace Supple
