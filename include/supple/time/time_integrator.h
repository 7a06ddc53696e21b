#ifndef supple_time_integrator_h
#define supple_time_integrator_h

#include <supple/forces/loads.h>
#include <supple/solvers/implicit_operator.h>
#include <supple/solvers/linear_solver.h>
#include <supple/time/stable_step.h>
#include <supple/time/time_parameters.h>

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <optional>
#include <string>

namespace Supple
{
  /** What a step has to tell. */
  struct StepReport
  {
    double time                    = 0.; ///< at the end of the step [s]; the load factor if static
    double dt                      = 0.; ///< [s]
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;
    double load_work               = 0.; ///< by all loads but gravity, and by moved vertices [J]

    /** Estimate, largest over all vertices [m]; where a method has none, not a number. */
    double local_error = 0.;

    /**
     * Energy the step took out of the motion or put into the springs [J]: what the elastic energy
     * did not get of it is dissipated. Where a method does not know it, what is missing in the
     * balance of energies is taken for dissipated.
     */
    std::optional<double> expended;
  };


  /** What integrators work with. */
  struct Model
  {
    const Body &body;
    const Constraints &constraints;
    const Loads &loads;
    ImplicitOperator &implicit_operator;
    LinearSolver &solver;
    const TimeParameters &time;
    const DampingParameters &damping;
    const MaterialParameters &material;
    const ParameterFile &scene; ///< knows where the entries were set, for messages
    Effort &effort;

    /** Whether the operator stays and the loads follow no displacement. */
    bool
    forces_are_linear() const;
  };


  /** Takes the body from one accepted state to the next. */
  class TimeIntegrator
  {
  public:
    virtual ~TimeIntegrator() = default;

    /** The method a scene asks for; the rotations become those of the displacement. */
    static std::unique_ptr<TimeIntegrator>
    create(const Model &model, const Vector &displacement);

    /**
     * One step.
     * @param state    displacement and, if the problem is dynamic, velocity; as before if the step
     * fails
     * @param observed whether anybody asks for energies and reactions
     * @throws ComputationError
     */
    virtual StepReport
    advance(State &state, bool observed) = 0;

    /** What a checkpoint has to keep of it beside the state; and what the steps that follow depend
     * on else is forgotten, so that they are the same as those of a run that goes on from there. */
    virtual nlohmann::json
    save();

    virtual void
    load(const nlohmann::json &saved);

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

    const Model model;
    double time = 0.; ///< [s]; the load factor of a static problem

  private:
    Vector reaction;
  };
} // namespace Supple

#endif
