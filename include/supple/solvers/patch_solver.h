#ifndef supple_patch_solver_h
#define supple_patch_solver_h

#include <supple/solvers/linear_solver.h>

#include <deal.II/lac/la_parallel_block_vector.h>
#include <deal.II/lac/vector_memory.h>

#include <functional>
#include <memory>

namespace Supple
{
  /** Displacements (block 0) and mean stresses of patches (block 1). */
  using BlockVector = dealii::LinearAlgebra::distributed::BlockVector<double>;


  /**
   * The linear system of a body whose patches resist to changes of volume, A = A_c + C D^-1 C^T
   * with one column of C for each patch, as the saddle point problem it stands for,
   *
   *   [ A_c   C ] [u]   [b]
   *   [ C^T  -D ] [p] = [0],   D_P = W_P / (g kappa),   g = ImplicitOperator::patch_factor(),
   *
   * with the mean stresses p. Preconditioned by the diagonal of B, an approximation of A that is
   * bounded however incompressible the material is, and of S = D + C^T diag(B)^-1 C, about the
   * Schur complement, it is as well conditioned at a Poisson ratio of 0.4999999 as at 0.4: minimal
   * residuals (Paige & Saunders 1975) need as many iterations (Silvester & Wathen 1994).
   */
  class PatchSystem
  {
  public:
    explicit PatchSystem(const ImplicitOperator &A);

    /** To be called when A has changed. @param B its bounded approximation */
    void
    update(const SymmetricBlockMatrix &B);

    /**
     * x = A^-1 b, residual = b - A x.
     * @param preconditioner has vmult(), about B^-1
     * @param name           of the solver, for messages
     * @return the number of iterations
     * @throws ComputationError if it does not converge
     */
    template <class Preconditioner>
    unsigned int
    solve(Vector &x,
          const Vector &b,
          Vector &residual,
          const Preconditioner &preconditioner,
          const SolverParameters &parameters,
          const std::string &name) const
    {
      Preconditioning both{[&](Vector &y, const Vector &z) { preconditioner.vmult(y, z); }, *this};
      return solve(x, b, residual, both, parameters, name);
    }

    /** y = (the matrix above) x */
    void
    vmult(BlockVector &y, const BlockVector &x) const;

  private:
    /** diag(B, S)^-1 */
    struct Preconditioning
    {
      void
      vmult(BlockVector &y, const BlockVector &x) const;

      const std::function<void(Vector &, const Vector &)> of_displacement;
      const PatchSystem &system;
    };

    unsigned int
    solve(Vector &x,
          const Vector &b,
          Vector &residual,
          const Preconditioning &preconditioning,
          const SolverParameters &parameters,
          const std::string &name) const;

    /** Nothing, of displacements and mean stresses. */
    BlockVector
    zero() const;

    /** How much larger the residual of A may be than that of the saddle point problem. */
    double
    amplification() const;

    const ImplicitOperator &A;
    const VolumetricPatches &patches;
    std::vector<double> schur; ///< S of own patches
    mutable Vector scratch;
    mutable dealii::GrowingVectorMemory<BlockVector> memory;
  };


  /**
   * Null where conjugate gradients on A itself need less time, preconditioned by B: without
   * patches, and while the bulk modulus is not much larger than that in B, for the condition of
   * B^-1 A is their ratio.
   */
  std::unique_ptr<PatchSystem>
  make_patch_system(const ImplicitOperator &A);
} // namespace Supple

#endif
