#include <supple/iterative_solver.h>

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
