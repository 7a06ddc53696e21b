#ifndef supple_space_error_tools_h
#define supple_space_error_tools_h

#include <supple/observe/probe_errors.h>
#include <supple/run/problem.h>

namespace Supple
{
  /** By what the errors in space of a problem's states are estimated; collective. */
  class SpaceErrorTools
  {
  public:
    explicit SpaceErrorTools(Problem &problem)
      : energy(problem.configuration, problem.forces.elastic())
      , points(problem.body, problem.constraints, problem.parameters.loads, problem.parameters.file)
      , problem(problem)
    {
    }

    /** Of the state that `energy` was estimated of last, in equilibrium. @throws ComputationError
     */
    ProbeErrors
    duals()
    {
      return {energy,
              problem.configuration,
              problem.forces,
              problem.implicit_operator,
              *problem.solver,
              problem.effort};
    }

    SpaceError energy;
    const PointForces points;

  private:
    Problem &problem;
  };
} // namespace Supple

#endif
