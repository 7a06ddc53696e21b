#include <supple/solvers/mass_solver.h>

#include <supple/base/error.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** What a residual may be beside the right hand side. */
    constexpr double tolerance = 1e-13;

    /** Smaller right hand sides are zero [N]: their squares are lost in conjugate gradients. */
    constexpr double nothing = 1e-100;

    struct MassProduct
    {
      const ImplicitOperator &A;

      void
      vmult(Vector &y, const Vector &x) const
      {
        A.mass_vmult(y, x);
      }
    };


    struct MassDiagonal
    {
      const std::vector<double> &inverse;

      void
      vmult(Vector &y, const Vector &x) const
      {
        for (std::size_t node = 0; node < inverse.size(); ++node)
          for (unsigned int i = 0; i < 3; ++i)
            y.local_element(3 * node + i) = inverse[node] * x.local_element(3 * node + i);
      }
    };
  } // namespace


  MassSolver::MassSolver(const ImplicitOperator &A)
    : A(A)
    , small(Utilities::MPI::n_mpi_processes(A.body.mesh.communicator) == 1 && A.body.n_owned < 1500)
    , same_everywhere(true)
  {
    A.body.initialize(residual);
    for (unsigned int node = 0; node < A.body.n_owned; ++node)
      {
        inverse_diagonal.push_back(1. / A.mass_matrix().diagonal[node]);
        for (unsigned int i = 1; i < 3; ++i)
          same_everywhere =
            same_everywhere && A.constraints.holds(3 * node + i) == A.constraints.holds(3 * node);
      }
  }


  void
  MassSolver::solve(Vector &x, const Vector &b)
  {
    if (b.l2_norm() < nothing)
      x = 0.;
    else if (is_solved(x, b))
      return;
    else if (small)
      solve_by_factor(x, b);
    else
      solve_by_iteration(x, b);
  }


  bool
  MassSolver::is_solved(const Vector &x, const Vector &b)
  {
    A.mass_vmult(residual, x);
    residual -= b;
    return residual.l2_norm() <= tolerance * b.l2_norm();
  }


  void
  MassSolver::factorize(const unsigned int direction)
  {
    const auto &pattern = A.mass_matrix().pattern;
    const auto holds    = [&](const unsigned int node) {
      return A.constraints.holds(3 * node + direction);
    };
    std::vector<Eigen::Triplet<double>> entries;
    for (unsigned int row = 0; row < pattern.n_owned; ++row)
      {
        entries.emplace_back(row, row, holds(row) ? 1. : A.mass_matrix().diagonal[row]);
        for (std::size_t k = pattern.row_start[row]; k < pattern.row_start[row + 1]; ++k)
          if (!holds(row) && !holds(pattern.column[k]))
            entries.emplace_back(row, pattern.column[k], A.mass_matrix().lower[k]);
      }
    Eigen::SparseMatrix<double> M(pattern.n_owned, pattern.n_owned);
    M.setFromTriplets(entries.begin(), entries.end());
    factors[direction] = std::make_unique<Factor>(M);
    right_hand_side.resize(pattern.n_owned);
  }


  void
  MassSolver::solve_by_factor(Vector &x, const Vector &b)
  {
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int direction = same_everywhere ? 0 : i;
        if (!factors[direction])
          factorize(direction);
        for (unsigned int node = 0; node < A.body.n_owned; ++node)
          right_hand_side[node] = b.local_element(3 * node + i);
        right_hand_side = factors[direction]->solve(right_hand_side);
        for (unsigned int node = 0; node < A.body.n_owned; ++node)
          x.local_element(3 * node + i) = right_hand_side[node];
      }
  }


  void
  MassSolver::solve_by_iteration(Vector &x, const Vector &b) const
  {
    SolverControl control(1000, tolerance * b.l2_norm());
    SolverCG<Vector> cg(control);
    try
      {
        cg.solve(MassProduct{A}, x, b, MassDiagonal{inverse_diagonal});
      }
    catch (const SolverControl::NoConvergence &)
      {
        x = 0.; // the next guess
        throw ComputationError("the system with the mass matrix was not solved");
      }
  }
} // namespace Supple
