#ifndef supple_iterative_solver_h
#define supple_iterative_solver_h

#include <supple/base/error.h>
#include <supple/solvers/patch_solver.h>

#include <deal.II/lac/solver_cg.h>

#include <array>

namespace Supple
{
  /** What solvers by conjugate gradients share: the matrix to precondition with, the system of
   * patches, the iterations and the body's rigid motions. */
  class IterativeSolver : public LinearSolver
  {
  protected:
    IterativeSolver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort);

    /** Whatever depends on the matrix A alone; to be called when it has changed. */
    void
    update_matrices();

    /** x = A^-1 b, residual = b - A x, by the system of patches if there is one.
     * @param preconditioner has vmult()
     * @return the number of iterations
     * @throws ComputationError if it does not converge */
    template <class Preconditioner>
    unsigned int
    solve_from_zero(Vector &x,
                    const Vector &b,
                    Vector &residual,
                    const Preconditioner &preconditioner)
    {
      if (patch_system)
        return patch_system->solve(x, b, residual, preconditioner, parameters, name());
      x = 0.;
      return iterate(x, b, residual, preconditioner);
    }

    /** The same without patches, on from the x given.
     * @param n_before iterations done for that x; they count
     * @return the number of further iterations */
    template <class Preconditioner>
    unsigned int
    iterate(Vector &x,
            const Vector &b,
            Vector &residual,
            const Preconditioner &preconditioner,
            const unsigned int n_before = 0)
    {
      using namespace dealii;
      const double size = b.l2_norm();
      SolverControl control(parameters.iteration_limit - n_before, parameters.tolerance * size);
      try
        {
          SolverCG<Vector>(control, memory).solve(A, x, b, preconditioner);
        }
      catch (const SolverControl::NoConvergence &)
        {
          throw_not_converged(n_before + control.last_step(), control.last_value() / size);
        }
      set_residual(residual, x, b);
      return control.last_step();
    }

    /** @throws ComputationError: conjugate gradients have not converged, and what may help
     * @param relative_residual that they got to */
    [[noreturn]] void
    throw_not_converged(unsigned int n_iterations, double relative_residual) const;

    /** What three translations and three rotations of the deformed body, in diameters about its
     * centre, move at a degree of freedom. */
    std::array<double, 6>
    rigid_motions_at(unsigned int dof, const Vector &displacement) const;

    PreconditioningMatrix preconditioning_matrix;
    std::unique_ptr<PatchSystem> patch_system; ///< null where A itself is solved

  private:
    dealii::GrowingVectorMemory<Vector> memory;
  };
} // namespace Supple

#endif
