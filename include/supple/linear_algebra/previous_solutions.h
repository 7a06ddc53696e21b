#ifndef supple_previous_solutions_h
#define supple_previous_solutions_h

#include <supple/linear_algebra/vector.h>

#include <deal.II/base/partitioner.h>

#include <Eigen/Dense>

#include <memory>
#include <vector>

namespace Supple
{
  /**
   * A first guess for A x = b from the last few systems of a motion, whose matrices were nearly the
   * same (after Fischer 1998, without products with the new matrix): the combination
   * x = sum_i c_i x_i for which sum_i c_i A_i x_i is nearest to b.
   */
  class PreviousSolutions
  {
  public:
    /** @param partitioner of the unknowns */
    explicit PreviousSolutions(
      const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &partitioner);

    /** @return whether there is a guess; x is zero otherwise */
    bool
    guess(Vector &x, const Vector &b) const;

    /** Keeps a solution and the product of its matrix with it, b - residual, in place of the
     * oldest ones. */
    void
    add(const Vector &x, const Vector &b, const Vector &residual);

  private:
    struct Pair
    {
      Vector solution, product;
    };

    /** Products of one vector with all kept ones, summed over processes. */
    Eigen::VectorXd
    products_with(const Vector &vector) const;

    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    std::vector<Pair> pairs;
    std::size_t next = 0;   ///< the place of the oldest pair, once all are taken
    Eigen::MatrixXd matrix; ///< scalar products of the kept products
  };
} // namespace Supple

#endif
