#ifndef supple_implicit_operator_h
#define supple_implicit_operator_h

#include <supple/base/effort.h>
#include <supple/forces/forces.h>
#include <supple/mechanics/constraints.h>

#include <nlohmann/json_fwd.hpp>

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
                     Forces &forces,
                     Configuration &configuration,
                     const DampingParameters &damping,
                     const CorotationParameters &corotation,
                     bool dynamic,
                     Effort &effort);

    /** A = M + gamma D + gamma^2 K' with the rotations of the configuration, or those that cells
     * had less than the warp tolerance ago, which the configuration keeps. Collective.
     * @return whether A has changed */
    bool
    assemble(double gamma);

    /** A keeps the rotations of now, whatever gamma is, until called again. */
    void
    keep_rotations();

    /** Whether a cell, on any process, has turned by more than this angle [rad] since
     * keep_rotations(). Collective. */
    bool
    cells_have_turned(double angle) const;

    /** What a checkpoint keeps beside the configuration: of what A with kept rotations is made. */
    nlohmann::json
    save() const;

    /** The next A is made with the rotations that the configuration keeps. */
    void
    load(const nlohmann::json &saved);

    /** A = K' with the rotations of the configuration. */
    void
    assemble_stiffness();

    /** y = A x */
    void
    vmult(Vector &y, const Vector &x) const;

    /** y = M x */
    void
    mass_vmult(Vector &y, const Vector &x) const;

    /** y = K' x, with x = 0 where the body is held: taken out of A where A has K' alone beside the
     * mass, otherwise computed from the forces. */
    void
    stiffness_vmult(Vector &y, const Vector &x) const;

    /** y = K' (u + b v) with the stiffness damping b, zero where the body is held; there u and v
     * are what they are. */
    void
    elastic_vmult(Vector &y, const Vector &u, const Vector &v) const;

    /** Sets a matrix to the last A without patches, but with cells that resist to a change of
     * volume about as much as to shear: to precondition with. */
    void
    assemble_bounded(SymmetricBlockMatrix &matrix) const;

    /** Sets a matrix on the vertices to what the last A is for displacements that are linear in
     * quadratic cells, P^T A P, without other forces than that of the cells: to precondition with.
     * @param slots of the corners in it */
    void
    assemble_on_vertices(const CellSlots &slots, SymmetricBlockMatrix &matrix) const;

    /** What the tangent of patches is to be multiplied with. */
    double
    patch_factor() const
    {
      return forces.elastic().stiffness_factor(factors);
    }

    const SymmetricBlockMatrix &
    matrix() const
    {
      return A;
    }

    /** How often the pattern of the matrices has become another one: what was made for the last one
     * is of no use. */
    unsigned int
    n_patterns() const
    {
      return patterns;
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
    Forces &forces;
    const DampingParameters &damping;

    /** What resists to a change of volume in place of the cells; null if they do it themselves. */
    const VolumetricPatches *
    patches() const
    {
      return configuration.patches.get();
    }

  private:
    /** Sets a matrix to A. @param added_bulk as of Forces::add_tangent() */
    void
    set_matrix(SymmetricBlockMatrix &matrix, double added_bulk) const;

    /** Assembles A, with another pattern if the forces need one. */
    void
    make();

    /** What bounded matrices have added, in shear moduli. */
    double
    bounded_bulk() const;

    /** Whether A is made of this already. */
    bool
    is_made_of(const TangentFactors &wanted, double wanted_diagonal) const;

    /** With the rotations of now, which are kept if A is renewable. */
    void
    assemble_all();

    /** Brings the cells that have turned up to date. @return whether any has */
    bool
    renew();

    /** A with the rotations that are kept. @return whether it has changed */
    bool
    assemble_kept(const TangentFactors &wanted, double wanted_diagonal);

    void
    mask(SymmetricBlockMatrix &matrix) const;

    SymmetricPattern
    make_pattern() const;

    void
    find_masked_entries();

    /** Makes matrices of a pattern with what the forces couple now. */
    void
    renew_pattern();

    void
    make_mass();

    Configuration &configuration; ///< of which the kept rotations change here
    Effort &effort;
    const double warp_tolerance; ///< [rad]
    SymmetricPattern pattern;
    unsigned int patterns = 0;
    SymmetricBlockMatrix A;
    TangentFactors factors;
    double diagonal = 0.;    ///< beside them
    bool renewable  = false; ///< A has kept rotations, and renews those of cells that have turned
    bool lags       = false; ///< A has those of the last keep_rotations()
    bool made       = true;  ///< false where A must be assembled from them
    std::unique_ptr<SymmetricScalarMatrix> M;
    std::vector<std::size_t> masked_lower;    ///< positions in A.lower
    std::vector<std::size_t> masked_diagonal; ///< positions in A.diagonal
  };
} // namespace Supple

#endif
