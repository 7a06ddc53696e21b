#include <supple/patch_solver.h>

namespace Supple
{
  PatchSystem::PatchSystem(const ImplicitOperator &A)
    : A(A)
    , patches(*A.body.patches)
  {
    A.body.initialize(scratch);
  }


  void
  PatchSystem::update(const SymmetricBlockMatrix &B)
  {
    // The neighbours' diagonals too: patches reach over to them.
    for (unsigned int node = 0; node < A.body.n_owned; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        scratch.local_element(3 * node + i) =
          A.constraints.holds(3 * node + i) ? 0. : 1. / B.diagonal[9 * node + 4 * i];
    const GhostValues inverse(scratch);
    schur.resize(patches.partitioner->locally_owned_size());
    for (unsigned int p = 0; p < schur.size(); ++p)
      {
        schur[p] = 1. / (A.patch_factor() * patches.stiffness(p));
        patches.for_each_node(p, [&](const unsigned int node, const std::array<double, 3> &c) {
          for (unsigned int i = 0; i < 3; ++i)
            schur[p] += c[i] * c[i] * inverse.data()[3 * static_cast<std::size_t>(node) + i];
        });
      }
  }


  State
  PatchSystem::vector() const
  {
    State state(2);
    A.body.initialize(state.block(0));
    state.block(1).reinit(patches.partitioner);
    state.collect_sizes();
    return state;
  }


  void
  PatchSystem::vmult(State &y, const State &x) const
  {
    const GhostValues u(x.block(0)), stress(x.block(1));
    A.matrix().vmult(y.block(0).begin(), u.data());
    patches.expand(y.block(0).begin(), stress.data());
    A.constraints.set_zero(y.block(0));
    patches.reduce(y.block(1), u.data());
    for (unsigned int p = 0; p < schur.size(); ++p)
      y.block(1).local_element(p) -=
        x.block(1).local_element(p) / (A.patch_factor() * patches.stiffness(p));
  }


  void
  PatchSystem::precondition(Vector &y, const Vector &x) const
  {
    for (unsigned int p = 0; p < schur.size(); ++p)
      y.local_element(p) = x.local_element(p) / schur[p];
  }
} // namespace Supple
