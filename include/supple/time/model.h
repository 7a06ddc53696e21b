#ifndef supple_model_h
#define supple_model_h

#include <supple/solvers/implicit_operator.h>
#include <supple/solvers/linear_solver.h>
#include <supple/time/time_parameters.h>

namespace Supple
{
  /** What integrators work with. */
  struct Model
  {
    const Body &body;
    const Constraints &constraints;
    Forces &forces;
    Configuration &configuration;
    ImplicitOperator &implicit_operator;
    LinearSolver &solver;
    const TimeParameters &time;
    const DampingParameters &damping;
    const MaterialParameters &material;
    const ParameterFile &scene; ///< knows where the entries were set, for messages
    Effort &effort;
  };
} // namespace Supple

#endif
