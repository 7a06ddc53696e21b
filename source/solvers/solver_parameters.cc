#include <supple/solvers/solver_parameters.h>

#include <supple/input/entries.h>

namespace Supple
{
  using dealii::ParameterHandler;
  using namespace Entries;

  void
  SolverParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Solver");
    add_choice(
      prm,
      "Method",
      method,
      {{"auto", SolverMethod::automatic},
       {"ldlt", SolverMethod::ldlt},
       {"cholmod", SolverMethod::cholmod},
       {"cg-amg", SolverMethod::cg_amg},
       {"cg-ml", SolverMethod::cg_ml},
       {"cg-jacobi", SolverMethod::cg_jacobi}},
      "Linear solver: LDL^T by 3x3 blocks (small or plane bodies), CHOLMOD's supernodal Cholesky, "
      "conjugate gradients with our own algebraic multigrid (large, or several processes), with "
      "Trilinos ML or with the inverted diagonal blocks. auto chooses by size and by how many "
      "systems have the same matrix.");
    add(
      prm,
      "Tolerance",
      tolerance,
      "none",
      Range::between(0, 1),
      "Conjugate gradients stop when the residual is below this fraction of the right hand side.");
    add(prm,
        "Iterations",
        iteration_limit,
        "none",
        Range::whole_number(1),
        "Conjugate gradients that need more for one solution have failed: then auto takes another "
        "solver, and one that was asked for by name ends the run.");
    add(prm,
        "Threads",
        threads,
        "none",
        Range::whole_number(1),
        "At most, of each process, for cells, matrices and the finest level of multigrid; "
        "summary.json says how many there were. Each has 8000 cells at least, so that small bodies "
        "stay on one. The result depends on their number as it does on that of processes, within "
        "the tolerance, and not on the time.");
    prm.leave_subsection();
  }
} // namespace Supple
