#include <supple/linear_algebra/previous_solutions.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace Supple
{
  namespace
  {
    // More bring little (benchmarks/theses).
    constexpr std::size_t n_kept = 4;

    // Keeps the coefficients bounded where the products depend on each other.
    constexpr double regularization = 1e-13;
  } // namespace


  PreviousSolutions::PreviousSolutions(
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &partitioner)
    : partitioner(partitioner)
    , matrix(n_kept, n_kept)
  {
    pairs.reserve(n_kept);
  }


  Eigen::VectorXd
  PreviousSolutions::products_with(const Vector &vector) const
  {
    using Map            = Eigen::Map<const Eigen::VectorXd>;
    const std::size_t n  = vector.locally_owned_size();
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i)
      sums[i] = Map(vector.begin(), n).dot(Map(pairs[i].product.begin(), n));
    const dealii::ArrayView<double> view(sums.data(), sums.size());
    dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(view),
                                partitioner->get_mpi_communicator(),
                                view);
    return sums;
  }


  bool
  PreviousSolutions::guess(Vector &x, const Vector &b) const
  {
    x            = 0.;
    const auto n = static_cast<Eigen::Index>(pairs.size());
    if (n == 0)
      return false;
    const Eigen::VectorXd inverse_norm = matrix.diagonal().head(n).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled =
      inverse_norm.asDiagonal() * matrix.topLeftCorner(n, n) * inverse_norm.asDiagonal() +
      regularization * Eigen::MatrixXd::Identity(n, n);
    const Eigen::VectorXd projection = inverse_norm.cwiseProduct(products_with(b));
    const Eigen::VectorXd c          = inverse_norm.cwiseProduct(scaled.ldlt().solve(projection));
    if (!c.allFinite())
      return false;
    for (Eigen::Index i = 0; i < n; ++i)
      x.add(c[i], pairs[i].solution);
    return true;
  }


  void
  PreviousSolutions::add(const Vector &x, const Vector &b, const Vector &residual)
  {
    if (pairs.size() < n_kept)
      {
        next = pairs.size();
        pairs.emplace_back();
        pairs[next].solution.reinit(partitioner);
        pairs[next].product.reinit(partitioner);
      }
    Pair &pair    = pairs[next];
    pair.solution = x;
    pair.product  = b;
    pair.product -= residual;
    const Eigen::VectorXd products = products_with(pair.product);
    const auto n                   = products.size();
    matrix.row(next).head(n)       = products.transpose();
    matrix.col(next).head(n)       = products;
    next                           = (next + 1) % n_kept;
  }
} // namespace Supple
