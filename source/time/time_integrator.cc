#include <supple/time/time_integrator.h>

#include <supple/forces/contact.h>

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
  TimeIntegrator::add_work_of_tools(StepReport &report, const double weight) const
  {
    if (!model.forces.contact())
      return;
    report.tool_works = model.forces.contact()->works(model.configuration, weight);
    for (const double work : report.tool_works)
      report.load_work += work;
    report.rubbed = model.forces.contact()->rubbed(model.configuration);
  }


  void
  TimeIntegrator::set_reactions(const Vector &force)
  {
    for (const unsigned int dof : model.constraints.owned())
      reaction.local_element(dof) = force.local_element(dof);
  }
} // namespace Supple
