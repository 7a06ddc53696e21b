#ifndef supple_implicit_operator_h
#define supple_implicit_operator_h

#include <supple/body.h>
#include <supple/constraints.h>
#include <supple/effort.h>

#include <memory>

namespace Supple
{
  /**
   * The operator every implicit method leads to, A = M + g D + g^2 K' with D = a M + b K' + c I (or
   * K' alone for a static problem), on this process's rows.
   *
   * Held degrees of freedom have a diagonal entry alone; vectors are zero there, and so is then the
   * product.
   */
  class ImplicitOperator
  {
  public:
    ImplicitOperator(const Body &body,
                     const Constraints &constraints,
                     const Parameters &parameters,
                     Effort &effort);

    /** A = M + gamma D + gamma^2 K' with the rotations the body has now. */
    void
    assemble(double gamma);

    /** A = K' with the rotations the body has now. */
    void
    assemble_stiffness();

    /** y = A x */
    void
    vmult(Vector &y, const Vector &x) const;

    /** y = M x */
    void
    mass_vmult(Vector &y, const Vector &x) const;

    /** y = K' x, from the cells, with what rotations add. */
    void
    stiffness_vmult(Vector &y, const Vector &x) const;

    const SymmetricBlockMatrix &
    matrix() const
    {
      return A;
    }

    const SymmetricScalarMatrix &
    mass_matrix() const
    {
      return *M;
    }

    bool
    has_mass() const
    {
      return M != nullptr;
    }

    const Body &body;
    const Constraints &constraints;
    const DampingParameters &damping;

  private:
    void
    assemble(double mass_factor,
             double stiffness_factor,
             double rotation_factor,
             double diagonal_term);

    SymmetricPattern
    make_pattern() const;

    void
    find_masked_entries();

    Effort &effort;
    const SymmetricPattern pattern;
    SymmetricBlockMatrix A;
    std::unique_ptr<SymmetricScalarMatrix> M;
    std::vector<std::size_t> masked_lower;    ///< positions in A.lower
    std::vector<std::size_t> masked_diagonal; ///< positions in A.diagonal
  };
} // namespace Supple

#endif
