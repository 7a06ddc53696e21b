#ifndef supple_multigrid_h
#define supple_multigrid_h

#include <supple/multigrid/coarsening.h>
#include <supple/multigrid/cycle.h>

#include <Eigen/Dense>

#include <memory>

namespace Supple
{
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

    std::unique_ptr<Coarsening<3>> coarsening;
    std::vector<std::unique_ptr<Level>> levels;
  };
} // namespace Supple

#endif
