#include <supple/multigrid/finest_level.h>

#include <supple/base/error.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Supple
{
  void
  require_positive(const bool positive, const Halo &halo)
  {
    if (dealii::Utilities::MPI::min(positive ? 1 : 0, halo.communicator()) == 0)
      throw ComputationError("the matrix is not positive definite (cg-amg)");
  }


  FinestLevel::FinestLevel(const SymmetricBlockMatrix &A, const Halo &halo)
    : A(A)
    , halo(halo)
    , sweeps(A.pattern)
    , rest(A.pattern.n_local)
    , difference(A.pattern.n_local)
  {
  }


  double
  FinestLevel::mean_diagonal() const
  {
    double sum = 0.;
    for (std::size_t node = 0; node < A.pattern.n_owned; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        sum += A.diagonal[9 * node + 4 * i];
    const double n = 3. * A.pattern.n_owned;
    return dealii::Utilities::MPI::sum(sum, halo.communicator()) /
           dealii::Utilities::MPI::sum(n, halo.communicator());
  }


  void
  FinestLevel::set_scale()
  {
    factor = 1. / mean_diagonal();
    require_positive(factor > 0., halo);
  }


  void
  FinestLevel::refresh()
  {
    require_positive(sweeps.set(view(), factor), halo);
  }


  void
  FinestLevel::descend(NodeValues<3> *x, const NodeValues<3> *r)
  {
    sweeps.forward(x, rest.data(), r);
    halo.update(x);
    sweeps.subtract_remote(rest.data(), x);
  }


  void
  FinestLevel::ascend(NodeValues<3> *x, NodeValues<3> *product, const NodeValues<3> *r)
  {
    A.pattern.for_pieces([&](const SymmetricPattern::Piece &piece) {
      std::copy(r + piece.begin, r + piece.end, rest.begin() + piece.begin);
    });
    sweeps.subtract_remote(rest.data(), x);
    sweeps.backward(x, rest.data(), r, difference.data(), product);
    halo.update(difference.data());
    sweeps.subtract_remote(product, difference.data());
  }
} // namespace Supple
