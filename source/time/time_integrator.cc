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
