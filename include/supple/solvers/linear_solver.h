#ifndef supple_linear_solver_h
#define supple_linear_solver_h

#include <supple/solvers/implicit_operator.h>
#include <supple/solvers/matrix_use.h>
#include <supple/solvers/solver_parameters.h>

#include <memory>
#include <string>

namespace Supple
{
  /**
   * Solves A x = b for an ImplicitOperator A, symmetric and positive definite.
   *
   * What `auto` has chosen among the iterative solvers has a stand-in: when it fails, the stand-in
   * solves that system, and is counted in Effort. A solver that was asked for by name has none.
   */
  class LinearSolver
  {
  public:
    virtual ~LinearSolver() = default;

    /** Makes one kind of solver. */
    using Maker = std::unique_ptr<LinearSolver> (*)(const ImplicitOperator &,
                                                    const SolverParameters &,
                                                    Effort &);

    /** The solver a scene asks for; `auto` chooses by size, use and number of processes.
     * @throws InputError for a solver that works on one process, on several; @p scene knows where
     * the entries were set */
    static std::unique_ptr<LinearSolver>
    create(const ImplicitOperator &A,
           const SolverParameters &parameters,
           MatrixUse use,
           const ParameterFile &scene,
           Effort &effort);

    /**
     * To be called whenever A has changed.
     * @param displacement of the body now: multigrid takes its rigid motions from there [m]
     * @throws ComputationError if A is not positive definite
     */
    void
    prepare(const Vector &displacement);

    /**
     * x = A^-1 b. The true residual |b - A x| is computed and kept in Effort.
     * @return the number of iterations, 0 for a direct solver
     * @throws ComputationError if it does not converge or something is not a number
     */
    unsigned int
    solve(Vector &x, const Vector &b);

    virtual std::string
    name() const = 0;

    /** The name of the solver that takes over when this one fails; empty if there is none. */
    std::string
    stand_in_name() const;

    /** What a process has of a coarse level of multigrid. */
    struct LevelShare
    {
      unsigned int n_nodes; ///< of the level, on all processes
      unsigned int n_owned; ///< those of this process, or all if each process has the whole level
    };

    /** From the finest to the coarsest; none if this solver has none, or has not made them yet. */
    virtual std::vector<LevelShare>
    coarse_levels() const
    {
      return {};
    }

    /** Further solutions leave at most this part of the right hand side, instead of what the scene
     * asks for. */
    void
    set_tolerance(double tolerance);

    /** What the next solution leaves at most. */
    double
    tolerance() const
    {
      return parameters.tolerance;
    }

    std::string reason; ///< why this solver

  protected:
    LinearSolver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort);

    /** Sets residual = b - A x and gives its norm. @throws ComputationError if x is not finite */
    double
    set_residual(Vector &residual, const Vector &x, const Vector &b) const;

    const ImplicitOperator &A;
    SolverParameters parameters; ///< of the scene, but for the tolerance
    Effort &effort;

  private:
    class Renewed;

    /** As the maker does, for an operator whose pattern may change too. */
    static std::unique_ptr<LinearSolver>
    make(Maker maker,
         const ImplicitOperator &A,
         const SolverParameters &parameters,
         Effort &effort);

    static std::unique_ptr<LinearSolver>
    make_stand_in(SolverMethod method,
                  const ImplicitOperator &A,
                  const SolverParameters &parameters,
                  Effort &effort);

    virtual void
    do_prepare(const Vector &displacement) = 0;

    /** Sets x = A^-1 b and residual = b - A x; b is not zero. */
    virtual unsigned int
    do_solve(Vector &x, const Vector &b, Vector &residual) = 0;

    /** do_solve() and what iterative refinement can mend. @throws ComputationError */
    unsigned int
    solve_alone(Vector &x, const Vector &b);

    unsigned int
    solve_by_stand_in(Vector &x, const Vector &b);

    Vector residual, remainder, correction;
    std::unique_ptr<LinearSolver> stand_in;
    Vector prepared_at;             ///< displacement A is of [m], kept for the stand-in
    bool prepared          = false; ///< for A as it is
    bool stand_in_prepared = false;
  };


  /** What iterative solvers make their preconditioner of: the matrix of A or, where patches resist
   * to changes of volume, one with bounded bulk modulus. */
  class PreconditioningMatrix
  {
  public:
    explicit PreconditioningMatrix(const ImplicitOperator &A);

    /** To be called whenever A has changed. */
    void
    update();

    const SymmetricBlockMatrix &
    get() const
    {
      return bounded ? *bounded : A.matrix();
    }

  private:
    const ImplicitOperator &A;
    std::unique_ptr<SymmetricBlockMatrix> bounded;
  };


  /** BlockFactorization: one process, bodies that are small, or plane. */
  std::unique_ptr<LinearSolver>
  make_ldlt_solver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort);

  /** CHOLMOD's supernodal Cholesky factorization: one process, where factors are large. */
  std::unique_ptr<LinearSolver>
  make_cholmod_solver(const ImplicitOperator &A,
                      const SolverParameters &parameters,
                      Effort &effort);

  /** Conjugate gradients with Trilinos ML and the six rigid motions of the deformed body. */
  std::unique_ptr<LinearSolver>
  make_cg_ml_solver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort);

  /** Conjugate gradients with our own multigrid. */
  std::unique_ptr<LinearSolver>
  make_cg_amg_solver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort);

  /** Conjugate gradients with the inverted 3x3 diagonal blocks. */
  std::unique_ptr<LinearSolver>
  make_cg_jacobi_solver(const ImplicitOperator &A,
                        const SolverParameters &parameters,
                        Effort &effort);
} // namespace Supple

#endif
