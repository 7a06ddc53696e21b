#ifndef supple_finest_level_h
#define supple_finest_level_h

#include <supple/linear_algebra/halo.h>
#include <supple/multigrid/block_smoother.h>

#include <vector>

namespace Supple
{
  /** The finest level of a multigrid method: a SymmetricBlockMatrix in single precision and its
   * smoother. */
  class FinestLevel
  {
  public:
    /** @param A stays in use; its values may change, its pattern not
     * @param halo of its nodes, as well */
    FinestLevel(const SymmetricBlockMatrix &A, const Halo &halo);

    /** One over the mean of the diagonal entries when it was last set. */
    double
    scale() const
    {
      return factor;
    }

    /** By what factor the mean of the diagonal entries has changed since. */
    double
    change() const
    {
      return factor * mean_diagonal();
    }

    /** @throws ComputationError if the mean is not positive */
    void
    set_scale();

    /** Takes the values that A has now. @throws ComputationError if a block on the diagonal is not
     * positive definite */
    void
    refresh();

    /** The first half of a cycle: x = (D + L)^-1 r, with ghosts, and residual() = r - A x. */
    void
    descend(NodeValues<3> *x, const NodeValues<3> *r);

    std::vector<NodeValues<3>> &
    residual()
    {
      return rest;
    }

    /** The second half: x has a correction, at ghosts too, and is swept backwards; product = A x.
     */
    void
    ascend(NodeValues<3> *x, NodeValues<3> *product, const NodeValues<3> *r);

    MatrixView<3>
    view() const
    {
      return {A.pattern, A.lower.data(), A.diagonal.data()};
    }

    const BlockSmoother<3> &
    smoother() const
    {
      return sweeps;
    }

  private:
    double
    mean_diagonal() const;

    const SymmetricBlockMatrix &A;
    const Halo &halo;
    double factor = 1.;
    BlockSmoother<3> sweeps;
    std::vector<NodeValues<3>> rest, difference;
  };


  /** @throws ComputationError on all processes if a matrix is not positive definite on one */
  void
  require_positive(bool positive, const Halo &halo);
} // namespace Supple

#endif
