#include <supple/solvers/iterative_solver.h>

#include <deal.II/base/mpi.h>

#include <sstream>

namespace Supple
{
  IterativeSolver::IterativeSolver(const ImplicitOperator &A,
                                   const SolverParameters &parameters,
                                   Effort &effort)
    : LinearSolver(A, parameters, effort)
    , preconditioning_matrix(A)
    , patch_system(make_patch_system(A))
  {
  }


  void
  IterativeSolver::update_matrices()
  {
    preconditioning_matrix.update();
    if (patch_system)
      patch_system->update(preconditioning_matrix.get());
  }


  void
  IterativeSolver::throw_not_converged(const unsigned int n_iterations,
                                       const double relative_residual) const
  {
    std::ostringstream text;
    text << "conjugate gradients (" << name() << ") did not reach the relative residual "
         << parameters.tolerance << " in " << n_iterations
         << " iterations (Solver/Iterations); they got to " << relative_residual;
    if (parameters.method != SolverMethod::automatic)
      {
        const bool alone = dealii::Utilities::MPI::n_mpi_processes(A.body.mesh.communicator) == 1;
        text << " (Solver/Method = auto has another solver take over; by name there "
             << (name() == "cg-ml" ? "is cg-amg" : "is cg-ml")
             << (alone ? ", or cholmod and ldlt)" : ", or cholmod and ldlt on one process)");
      }
    throw ComputationError(text.str());
  }


  std::array<double, 6>
  IterativeSolver::rigid_motions_at(const unsigned int dof, const Vector &displacement) const
  {
    const dealii::Point<3> center = A.body.mesh.bounding_box.center();
    const unsigned int node = dof / 3, i = dof % 3, i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    const auto x = [&](const unsigned int d) {
      return (A.body.positions[node][d] + displacement.local_element(3 * node + d) - center[d]) /
             A.body.mesh.diameter();
    };
    std::array<double, 6> motions{};
    motions[i]      = 1.;
    motions[3 + i1] = x(i2);
    motions[3 + i2] = -x(i1);
    return motions;
  }
} // namespace Supple
