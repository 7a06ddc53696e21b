#ifndef supple_time_integrator_h
#define supple_time_integrator_h

#include <supple/time/model.h>
#include <supple/time/stable_step.h>
#include <supple/time/step_report.h>

#include <nlohmann/json_fwd.hpp>

#include <limits>
#include <optional>
#include <string>

namespace Supple
{
  /** Takes the configuration of the body from one accepted state to the next. */
  class TimeIntegrator
  {
  public:
    virtual ~TimeIntegrator() = default;

    /**
     * One step from the configuration as it is, which then waits to be accepted or rejected.
     * @param observed whether anybody asks for energies and reactions
     * @throws ComputationError with the configuration as it was
     */
    virtual StepReport
    advance(bool observed) = 0;

    /** To be called before the first step, or load(), if save() will be. */
    virtual void
    keep_past()
    {
    }

    /** What a run that goes on needs beyond the configuration: it changes nothing here. Collective,
     * counts on the first process. */
    virtual nlohmann::json
    save();

    /** The same taken back, when the configuration and the operator have theirs. Collective.
     * @throws nlohmann::json::exception, std::out_of_range if @p saved is something else */
    virtual void
    load(const nlohmann::json &saved);

    /** Has the first step begin at a time [s], with the configuration as it is then and without a
     * past. */
    virtual void
    begin_at(const double start)
    {
      time = start;
    }

    /** Takes the reactions over from an integrator before this one [N]. */
    void
    recall_reactions(const Vector &before)
    {
      set_reactions(before);
    }

    /** Has variable steps end at a time [s] at the latest. */
    void
    stop_at(const double at)
    {
      stop = at;
    }

    bool
    finished() const
    {
      return time >= end * (1. - 1e-12);
    }

    const double end; ///< [s]; the load factor of a static problem

    virtual std::string
    name() const = 0;

    /** Of an explicit method. */
    virtual std::optional<StableStep>
    stable_step() const
    {
      return {};
    }

    /** Forces of the clamps on the body at the end of an observed step [N]; zero where it is free.
     */
    const Vector &
    reactions() const
    {
      return reaction;
    }

  protected:
    TimeIntegrator(const Model &model, double end);

    /** Keeps the held entries of a force and sets all others to zero. */
    void
    set_reactions(const Vector &force);

    /** Adds what rigid tools do on their way, with their forces at the start of the step taken by a
     * weight and those at the end by the rest. Collective. */
    void
    add_work_of_tools(StepReport &report, double weight) const;

    const Model model;
    double time = 0.;                                 ///< [s]; the load factor of a static problem
    double stop = std::numeric_limits<double>::max(); ///< of variable steps [s]

  private:
    Vector reaction;
  };
} // namespace Supple

#endif
