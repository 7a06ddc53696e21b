#ifndef supple_solver_parameters_h
#define supple_solver_parameters_h

#include <deal.II/base/parameter_handler.h>

namespace Supple
{
  /** How linear systems are solved. */
  enum class SolverMethod
  {
    automatic,
    ldlt,
    cholmod,
    cg_amg,
    cg_ml,
    cg_jacobi
  };


  /** Subsection Solver. */
  struct SolverParameters
  {
    SolverMethod method          = SolverMethod::automatic;
    double tolerance             = 1e-8;
    unsigned int iteration_limit = 5000;
    unsigned int threads         = 1;

    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Supple

#endif
