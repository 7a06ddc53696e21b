#ifndef supple_model_h
#define supple_model_h

#include <supple/forces/loads.h>
#include <supple/solvers/implicit_operator.h>
#include <supple/solvers/linear_solver.h>

namespace Supple
{
  /** What integrators work with. */
  struct Model
  {
    const Body &body;
    const Constraints &constraints;
    const Loads &loads;
    ImplicitOperator &implicit_operator;
    LinearSolver &solver;
    const Parameters &parameters;
    Effort &effort;

    /** Whether the operator stays and the loads follow no displacement. */
    bool
    forces_are_linear() const
    {
      return body.rotation == RotationMethod::none && !loads.follow();
    }
  };
} // namespace Supple

#endif
