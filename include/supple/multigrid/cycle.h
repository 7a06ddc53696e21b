#ifndef supple_cycle_h
#define supple_cycle_h

#include <supple/multigrid/coarse_level.h>
#include <supple/multigrid/finest_level.h>

#include <vector>

namespace Supple
{
  /** An approximate inverse B of a SymmetricBlockMatrix by multigrid, in single precision,
   * symmetric and positive definite. */
  class Cycle
  {
  public:
    /**
     * @param A    stays in use; its values may change, its pattern not
     * @param dofs three for each node, as A counts them
     */
    Cycle(const SymmetricBlockMatrix &A,
          std::shared_ptr<const dealii::Utilities::MPI::Partitioner> dofs)
      : halo(std::move(dofs), 3)
      , finest(A, halo)
    {
    }

    virtual ~Cycle() = default;

    /**
     * Chooses coarse levels for the values that the matrix has now and computes them all.
     * @param modes six rigid motions at owned nodes, three rows of six numbers for each node, zero
     * where the body is held
     * @throws ComputationError if the matrix is not positive definite
     */
    virtual void
    build(const std::vector<double> &modes) = 0;

    /** Computes all levels for the values of now, chosen as by build(). */
    virtual void
    refresh(const std::vector<double> &modes) = 0;

    /** Takes the values of now for the finest level and keeps the coarser ones. */
    virtual void
    refresh_finest() = 0;

    /** z = B r, about the inverse of scale() * A, and product = scale() * A z, which comes with it.
     * Ghost values don't matter. */
    virtual void
    apply(NodeValues<3> *z, NodeValues<3> *product, const NodeValues<3> *r) = 0;

    /** One over the mean of the diagonal entries: keeps single precision within its range. */
    double
    scale() const
    {
      return finest.scale();
    }

    /** By what factor the mean of the diagonal entries has changed since all levels were computed.
     */
    double
    change() const
    {
      return finest.change();
    }

    /** Levels of aggregates. */
    virtual std::size_t
    n_coarse_levels() const = 0;

    virtual const CoarseLevel &
    coarse_level(std::size_t l) const = 0;

    const Halo halo;

  protected:
    FinestLevel finest;
  };
} // namespace Supple

#endif
