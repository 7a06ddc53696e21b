#include <supple/solvers/linear_solver.h>

#include <supple/base/error.h>

#include <deal.II/base/mpi.h>

#include <map>
#include <sstream>

namespace Supple
{
  using Method = SolverMethod;

  namespace
  {
    // Beyond, CHOLMOD would take gigabytes as a stand-in.
    constexpr unsigned int largest_stand_in_factor = 300000;

    /** Up to how many unknowns a factorization is quicker than multigrid, and why it is as many. */
    struct Limit
    {
      unsigned int n_unknowns;
      const char *reason;
    };

    /** Measured on the bar (doc/performance.md). What counts is for how many solutions one factor
     * serves; in the plane factors stay thin: of 151762 unknowns one takes 0.5 s. */
    Limit
    limit_of(const ImplicitOperator &A, const MatrixUse use)
    {
      if (A.body.mesh.section.plane())
        return {300000, "in the plane"};
      if (!A.forces.change_operator() && A.has_mass())
        return {25000, "the operator never changes"};
      switch (use)
        {
          case MatrixUse::one_system:
            return {1000, "a matrix for each solution"};
          case MatrixUse::some_systems:
            return {1500, "some solutions with each matrix"};
          default:
            return {8000, "many solutions with each matrix"};
        }
    }

    /** Our multigrid knows the six rigid motions of a body in space alone. */
    Method
    multigrid(const ImplicitOperator &A)
    {
      return A.body.mesh.section.plane() ? Method::cg_ml : Method::cg_amg;
    }

    /** ML fails where a process has no rows. */
    bool
    all_own(const ImplicitOperator &A)
    {
      return dealii::Utilities::MPI::min(A.body.n_owned, A.body.mesh.communicator) > 0;
    }

    Method
    choose(const ImplicitOperator &A, const MatrixUse use, std::string &reason)
    {
      const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(A.body.mesh.communicator);
      if (n_ranks > 1)
        {
          const bool ml_fails = multigrid(A) == Method::cg_ml && !all_own(A);
          reason              = std::to_string(n_ranks) + " processes" +
                   (ml_fails ? ", some of which own no vertex" : "");
          return ml_fails ? Method::cg_jacobi : multigrid(A);
        }
      const Limit limit         = limit_of(A, use);
      const unsigned int n_dofs = A.body.n_dofs();
      const bool factorizes     = n_dofs <= limit.n_unknowns;
      reason = std::to_string(n_dofs) + " unknowns, " + (factorizes ? "at most " : "more than ") +
               std::to_string(limit.n_unknowns) + ", " + limit.reason;
      return factorizes ? Method::ldlt : multigrid(A);
    }

    const std::map<Method, LinearSolver::Maker> makers = {{Method::ldlt, make_ldlt_solver},
                                                          {Method::cholmod, make_cholmod_solver},
                                                          {Method::cg_amg, make_cg_amg_solver},
                                                          {Method::cg_ml, make_cg_ml_solver},
                                                          {Method::cg_jacobi,
                                                           make_cg_jacobi_solver}};
  } // namespace


  PreconditioningMatrix::PreconditioningMatrix(const ImplicitOperator &A)
    : A(A)
  {
    if (A.patches())
      bounded = std::make_unique<SymmetricBlockMatrix>(A.matrix().pattern);
  }


  void
  PreconditioningMatrix::update()
  {
    if (bounded)
      A.assemble_bounded(*bounded);
  }


  LinearSolver::LinearSolver(const ImplicitOperator &A,
                             const SolverParameters &parameters,
                             Effort &effort)
    : A(A)
    , parameters(parameters)
    , effort(effort)
  {
    A.body.initialize(residual);
    A.body.initialize(remainder);
    A.body.initialize(correction);
  }


  /** A solver that is made anew where the pattern of A has become another one. */
  class LinearSolver::Renewed : public LinearSolver
  {
  public:
    Renewed(const ImplicitOperator &A,
            const SolverParameters &parameters,
            Effort &effort,
            const Maker maker)
      : LinearSolver(A, parameters, effort)
      , maker(maker)
      , solver(maker(A, parameters, effort))
      , pattern(A.n_patterns())
    {
    }

    std::string
    name() const override
    {
      return solver->name();
    }

    std::vector<LevelShare>
    coarse_levels() const override
    {
      return solver->coarse_levels();
    }

  private:
    void
    do_prepare(const Vector &displacement) override
    {
      if (pattern != A.n_patterns())
        solver = maker(A, parameters, effort);
      pattern = A.n_patterns();
      solver->do_prepare(displacement);
    }

    unsigned int
    do_solve(Vector &x, const Vector &b, Vector &residual) override
    {
      solver->parameters.tolerance = parameters.tolerance;
      return solver->do_solve(x, b, residual);
    }

    const Maker maker;
    std::unique_ptr<LinearSolver> solver;
    unsigned int pattern; ///< of which it is
  };


  std::unique_ptr<LinearSolver>
  LinearSolver::make(const Maker maker,
                     const ImplicitOperator &A,
                     const SolverParameters &parameters,
                     Effort &effort)
  {
    if (A.forces.couplings_come_and_go())
      return std::make_unique<Renewed>(A, parameters, effort, maker);
    return maker(A, parameters, effort);
  }


  /** The solver that takes over when the chosen one fails; none for direct solvers, whose failure
   * means that A is not positive definite. */
  std::unique_ptr<LinearSolver>
  LinearSolver::make_stand_in(const SolverMethod method,
                              const ImplicitOperator &A,
                              const SolverParameters &parameters,
                              Effort &effort)
  {
    if (method == Method::ldlt || method == Method::cholmod)
      return nullptr;
    const bool one_process = dealii::Utilities::MPI::n_mpi_processes(A.body.mesh.communicator) == 1;
    if (one_process && A.body.n_dofs() <= largest_stand_in_factor)
      return make(make_cholmod_solver, A, parameters, effort);
    if (method == Method::cg_amg && all_own(A))
      return make(make_cg_ml_solver, A, parameters, effort);
    return nullptr;
  }


  std::unique_ptr<LinearSolver>
  LinearSolver::create(const ImplicitOperator &A,
                       const SolverParameters &parameters,
                       const MatrixUse use,
                       const ParameterFile &scene,
                       Effort &effort)
  {
    std::string reason = "asked for";
    Method method      = parameters.method;
    if (method == Method::automatic)
      method = choose(A, use, reason);

    const bool direct = method == Method::ldlt || method == Method::cholmod;
    if (direct && dealii::Utilities::MPI::n_mpi_processes(A.body.mesh.communicator) > 1)
      throw InputError(scene.origin("Solver/Method") +
                       ": ldlt and cholmod work on one process; on several take cg-amg or auto.");

    std::unique_ptr<LinearSolver> solver = make(makers.at(method), A, parameters, effort);
    solver->reason                       = reason;
    if (parameters.method == Method::automatic)
      solver->stand_in = make_stand_in(method, A, parameters, effort);
    if (solver->stand_in)
      A.body.initialize(solver->prepared_at);
    return solver;
  }


  void
  LinearSolver::set_tolerance(const double tolerance)
  {
    parameters.tolerance = tolerance;
    if (stand_in)
      stand_in->set_tolerance(tolerance);
  }


  std::string
  LinearSolver::stand_in_name() const
  {
    return stand_in ? stand_in->name() : "";
  }


  void
  LinearSolver::prepare(const Vector &displacement)
  {
    const PhaseTimer timer(effort, Phase::solver_setup);
    prepared = stand_in_prepared = false;
    if (stand_in)
      prepared_at = displacement;
    try
      {
        do_prepare(displacement);
        prepared = true;
      }
    catch (const ComputationError &)
      {
        if (!stand_in)
          throw;
      }
  }


  unsigned int
  LinearSolver::solve(Vector &x, const Vector &b)
  {
    const PhaseTimer timer(effort, Phase::solve);

    if (!all_finite(b))
      throw ComputationError("the forces are not finite numbers");
    if (b.l2_norm() < 1e-100) // squares of smaller numbers are lost in conjugate gradients
      {
        x = 0.;
        return 0;
      }

    unsigned int n_iterations = 0;
    try
      {
        n_iterations = prepared ? solve_alone(x, b) : solve_by_stand_in(x, b);
      }
    catch (const ComputationError &)
      {
        if (!stand_in || !prepared)
          throw;
        n_iterations = solve_by_stand_in(x, b);
      }
    ++effort.solves;
    effort.linear_iterations += n_iterations;
    return n_iterations;
  }


  unsigned int
  LinearSolver::solve_by_stand_in(Vector &x, const Vector &b)
  {
    if (!stand_in_prepared)
      {
        stand_in->do_prepare(prepared_at);
        stand_in_prepared = true;
      }
    ++effort.stand_in_solves;
    return stand_in->solve_alone(x, b);
  }


  unsigned int
  LinearSolver::solve_alone(Vector &x, const Vector &b)
  {
    const double size         = b.l2_norm();
    unsigned int n_iterations = do_solve(x, b, residual);
    double relative           = residual.l2_norm() / size;

    // Round-off in large or badly conditioned systems: solve for what is left over.
    for (unsigned int n = 0; n < 3 && relative > 2. * parameters.tolerance; ++n)
      {
        remainder = residual;
        n_iterations += do_solve(correction, remainder, residual);
        x += correction;
        relative = set_residual(residual, x, b) / size;
      }
    if (relative > std::max(1e-6, 10. * parameters.tolerance))
      {
        std::ostringstream text;
        text << "the linear system is too badly conditioned: " << name()
             << " left a relative residual of " << relative
             << ". Are cells extremely thin, or the body almost incompressible";
        throw ComputationError(text.str());
      }
    effort.max_relative_residual = std::max(effort.max_relative_residual, relative);
    return n_iterations;
  }


  double
  LinearSolver::set_residual(Vector &residual, const Vector &x, const Vector &b) const
  {
    if (!all_finite(x))
      throw ComputationError("the linear solver " + name() + " gave no finite numbers");
    A.vmult(residual, x);
    residual.sadd(-1., 1., b);
    return residual.l2_norm();
  }
} // namespace Supple
