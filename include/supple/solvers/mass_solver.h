#ifndef supple_mass_solver_h
#define supple_mass_solver_h

#include <supple/solvers/implicit_operator.h>

#include <Eigen/SparseCholesky>

#include <memory>
#include <vector>

namespace Supple
{
  /**
   * Solves M_ff x = b on the free degrees of freedom. The mass matrix never changes: on one process
   * its factor, one number for each pair of vertices, is computed when it is first needed; large
   * bodies and several processes take conjugate gradients, which need few iterations.
   */
  class MassSolver
  {
  public:
    explicit MassSolver(const ImplicitOperator &A);

    /** @param x starts as a guess. @throws ComputationError */
    void
    solve(Vector &x, const Vector &b);

  private:
    using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

    bool
    is_solved(const Vector &x, const Vector &b);

    void
    factorize(unsigned int direction);

    void
    solve_by_factor(Vector &x, const Vector &b);

    void
    solve_by_iteration(Vector &x, const Vector &b) const;

    const ImplicitOperator &A;
    const bool small;
    bool same_everywhere; ///< a vertex is held in all directions or in none
    std::array<std::unique_ptr<Factor>, 3>
      factors;                            ///< one for each direction, or the first for all
    std::vector<double> inverse_diagonal; ///< of each owned node
    Vector residual;
    Eigen::VectorXd right_hand_side;
  };
} // namespace Supple

#endif
