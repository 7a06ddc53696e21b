#ifndef supple_patch_solver_h
#define supple_patch_solver_h

#include <supple/linear_solver.h>

namespace Supple
{
  /**
   * The linear system of a body whose patches resist to changes of volume, A = A_c + C D^-1 C^T with
   * one column of C for each patch, as the saddle point problem it stands for,
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

    /** Displacements and mean stresses, of zero. */
    State
    vector() const;

    /** y = (the matrix above) x */
    void
    vmult(State &y, const State &x) const;

    /** Divides the stresses by S. */
    void
    precondition(Vector &y, const Vector &x) const;

  private:
    const ImplicitOperator &A;
    const VolumetricPatches &patches;
    std::vector<double> schur; ///< S of own patches
    mutable Vector scratch;
  };


  /** diag(B, S)^-1 */
  template <class Preconditioner>
  class PatchPreconditioner
  {
  public:
    PatchPreconditioner(const PatchSystem &system, const Preconditioner &preconditioner)
      : system(system)
      , preconditioner(preconditioner)
    {
    }

    void
    vmult(State &y, const State &x) const
    {
      preconditioner.vmult(y.block(0), x.block(0));
      system.precondition(y.block(1), x.block(1));
    }

  private:
    const PatchSystem &system;
    const Preconditioner &preconditioner;
  };
} // namespace Supple

#endif
