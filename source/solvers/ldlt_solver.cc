#include <supple/base/error.h>
#include <supple/linear_algebra/block_factorization.h>
#include <supple/solvers/linear_solver.h>
#include <supple/solvers/patched_matrix.h>

namespace Supple
{
  namespace
  {
    /** The factorization of the operator on one process. */
    class LdltSolver : public LinearSolver
    {
    public:
      LdltSolver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort)
        : LinearSolver(A, parameters, effort)
        , matrix(A)
        , factorization(matrix.get().pattern)
      {
      }

      std::string
      name() const override
      {
        return "ldlt";
      }

    private:
      void
      do_prepare(const Vector &) override
      {
        matrix.update();
        const bool definite = factorization.factorize(matrix.get());
        ++effort.factorizations;
        if (!definite)
          throw ComputationError(
            "the matrix is not positive definite, or too badly conditioned to tell (ldlt)");
      }

      unsigned int
      do_solve(Vector &x, const Vector &b, Vector &residual) override
      {
        factorization.solve(x.begin(), b.begin());
        set_residual(residual, x, b);
        return 0;
      }

      PatchedMatrix matrix;
      BlockFactorization factorization;
    };
  } // namespace


  std::unique_ptr<LinearSolver>
  make_ldlt_solver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort)
  {
    return std::make_unique<LdltSolver>(A, parameters, effort);
  }
} // namespace Supple
