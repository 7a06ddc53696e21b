#ifndef supple_multigrid_h
#define supple_multigrid_h

#include <supple/multigrid/coarsening.h>
#include <supple/multigrid/cycle.h>

#include <Eigen/Dense>

#include <memory>

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


  /**
   * An approximate inverse of a SymmetricBlockMatrix by algebraic multigrid: smoothed aggregation
   * with the six rigid motions of the body (Coarsening), one sweep of Gauss-Seidel before and one
   * after each coarser level (BlockSmoother), a V-cycle in single precision, and an inverse matrix
   * on the coarsest level. It is symmetric and positive definite.
   *
   * The finest level is distributed over processes as the matrix is, and so are the coarser ones,
   * by a factor of fifteen to twenty smaller each, as long as they are large enough to pay for
   * their messages. What is smaller every process computes for itself.
   */
  class Multigrid : public Cycle
  {
  public:
    /**
     * @param A    stays in use; its values may change, its pattern not
     * @param dofs three for each node, as A counts them
     */
    Multigrid(const SymmetricBlockMatrix &A,
              std::shared_ptr<const dealii::Utilities::MPI::Partitioner> dofs);

    /** Chooses aggregates. */
    void
    build(const std::vector<double> &modes) override;

    void
    refresh(const std::vector<double> &modes) override;

    void
    refresh_finest() override;

    void
    apply(NodeValues<3> *z, NodeValues<3> *product, const NodeValues<3> *r) override;

    double
    scale() const override
    {
      return finest.scale();
    }

    double
    change() const override
    {
      return finest.change();
    }

    std::size_t
    n_coarse_levels() const override
    {
      return levels.size();
    }

    const CoarseLevel &
    coarse_level(const std::size_t l) const override
    {
      return levels[l]->coarse;
    }

  private:
    /** A coarse level; the last one has an inverse or, if there are no couplings any more, only its
     * smoother. */
    struct Level
    {
      explicit Level(const CoarseLevel &level);

      const CoarseLevel &coarse;
      BlockSmoother<6> smoother;
      std::unique_ptr<Coarsening<6>> coarsening;
      Eigen::MatrixXf inverse;
      Eigen::VectorXf right_hand_side, solution; ///< of the inverse
      std::vector<NodeValues<6>> x, b, residual;
    };

    /** Smoother and inverse of the coarse levels, and the levels themselves if they are new. */
    void
    refresh_coarse_levels(bool build);

    void
    invert(Level &level);

    void
    cycle(std::size_t level);

    FinestLevel finest;
    std::unique_ptr<Coarsening<3>> coarsening;
    std::vector<std::unique_ptr<Level>> levels;
  };
} // namespace Supple

#endif
