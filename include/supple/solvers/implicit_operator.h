#ifndef supple_implicit_operator_h
#define supple_implicit_operator_h

#include <supple/base/effort.h>
#include <supple/mechanics/body.h>
#include <supple/mechanics/constraints.h>

#include <memory>

namespace Supple
{
  /**
   * The operator every implicit method leads to, A = M + g D + g^2 K' with D = a M + b K' + c I (or
   * K' alone for a static problem), on this process's rows.
   *
   * Where patches resist to changes of volume, matrix() is what the cells do alone, and the rest of
   * A is patch_factor() times the tangent of VolumetricPatches, kept as one vector a patch.
   *
   * Held degrees of freedom have a diagonal entry alone; vectors are zero there, and so is then the
   * product.
   */
  class ImplicitOperator
  {
  public:
    /** @param dynamic the problem has masses */
    ImplicitOperator(const Body &body,
                     const Constraints &constraints,
                     const DampingParameters &damping,
                     const CorotationParameters &corotation,
                     bool dynamic,
                     Effort &effort);

    /** A = M + gamma D + gamma^2 K' with the rotations the body has now, or had less than the warp
     * tolerance ago. Collective.
     * @return whether A has changed */
    bool
    assemble(double gamma);

    /** The next A has the rotations of its moment. */
    void
    forget();

    /** A = K' with the rotations the body has now. */
    void
    assemble_stiffness();

    /** y = A x */
    void
    vmult(Vector &y, const Vector &x) const;

    /** y = M x */
    void
    mass_vmult(Vector &y, const Vector &x) const;

    /** y = K' x with what rotations add: that of A if it can be taken from there, with x = 0 where
     * the body is held; otherwise from the cells. */
    void
    stiffness_vmult(Vector &y, const Vector &x) const;

    /** Sets a matrix to the last A without patches, but with cells that resist to a change of
     * volume about as much as to shear: to precondition with. */
    void
    assemble_bounded(SymmetricBlockMatrix &matrix) const;

    /** What the tangent of patches is to be multiplied with. */
    double
    patch_factor() const
    {
      return factors.stiffness;
    }

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
    /** What A is made of. */
    struct Factors
    {
      double mass = 0., stiffness = 0., rotation = 0., diagonal = 0.;
    };

    void
    assemble(SymmetricBlockMatrix &matrix, double added_bulk) const;

    void
    assemble_all();

    /** Brings the cells that have turned up to date. @return whether any has */
    bool
    renew();

    void
    mask(SymmetricBlockMatrix &matrix) const;

    SymmetricPattern
    make_pattern() const;

    void
    find_masked_entries();

    Effort &effort;
    const double warp_tolerance; ///< [rad]
    const SymmetricPattern pattern;
    SymmetricBlockMatrix A;
    Factors factors;
    bool renewable = false; ///< A has kept rotations
    std::unique_ptr<SymmetricScalarMatrix> M;
    std::vector<std::size_t> masked_lower;    ///< positions in A.lower
    std::vector<std::size_t> masked_diagonal; ///< positions in A.diagonal
  };
} // namespace Supple

#endif
