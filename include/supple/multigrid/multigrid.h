#ifndef supple_multigrid_h
#define supple_multigrid_h

#include <supple/multigrid/coarsening.h>

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
  class Multigrid
  {
  public:
    /**
     * @param A    stays in use; its values may change, its pattern not
     * @param dofs three for each node, as A counts them
     */
    Multigrid(const SymmetricBlockMatrix &A,
              std::shared_ptr<const dealii::Utilities::MPI::Partitioner> dofs);

    /**
     * Chooses aggregates for the values A has now and computes all levels.
     * @param modes six rigid motions at owned nodes, three rows of six numbers for each node, zero
     * where the body is held
     * @throws ComputationError if A is not positive definite
     */
    void
    build(const std::vector<double> &modes);

    /** Computes all levels for the values A has now, with the aggregates of build(). */
    void
    refresh(const std::vector<double> &modes);

    /** Takes the values A has now for the finest level and keeps the coarser ones. */
    void
    refresh_finest();

    /** z = B r, about the inverse of scale() * A, and product = scale() * A z, which comes with it.
     * Ghost values don't matter. */
    void
    apply(NodeValues<3> *z, NodeValues<3> *product, const NodeValues<3> *r);

    /** One over the mean of the diagonal entries: keeps single precision within its range. */
    double
    scale() const
    {
      return factor;
    }

    /** By what factor the mean of the diagonal entries has changed since all levels were computed.
     */
    double
    change() const
    {
      return factor * mean_diagonal();
    }

    std::size_t
    n_coarse_levels() const
    {
      return levels.size();
    }

    const CoarseLevel &
    coarse_level(const std::size_t l) const
    {
      return levels[l]->coarse;
    }

    const Halo halo;

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

    MatrixView<3>
    view() const
    {
      return {A.pattern, A.lower.data(), A.diagonal.data()};
    }

    double
    mean_diagonal() const;

    void
    set_scale();

    /** Smoother and inverse of the coarse levels, and the levels themselves if they are new. */
    void
    refresh_coarse_levels(bool build);

    void
    invert(Level &level);

    void
    cycle(std::size_t level);

    const SymmetricBlockMatrix &A;
    double factor = 1.;
    BlockSmoother<3> finest;
    std::unique_ptr<Coarsening<3>> coarsening;
    std::vector<std::unique_ptr<Level>> levels;
    std::vector<NodeValues<3>> residual, difference; ///< on the finest level
  };
} // namespace Supple

#endif
