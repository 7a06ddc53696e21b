#ifndef supple_law_h
#define supple_law_h

#include <supple/mechanics/cells.h>
#include <supple/mechanics/tangent.h>

#include <string>
#include <vector>

namespace Supple
{
  /** Rotations of cells, batch by batch; of quadratic cells those of the four points of each batch.
   */
  struct CellRotations
  {
    using List = std::vector<Matrix3<Pack>>;

    List current; ///< of the last update; none: R = I
    List kept;    ///< what the operator was made with, where it may lag; none: those above
    List before;  ///< of Newton's correction before, with which strains are foreseen; none: none

    /** Those by which the tangent takes its strains, see Configuration::foresee_strains(). */
    const List &
    of_strain() const
    {
      return before.empty() ? current : before;
    }

    /** Those that the frozen tangent is made with. */
    const List &
    of_tangent() const
    {
      return kept.empty() ? current : kept;
    }
  };


  /** Elastic energy and extremes of the owned cells of one process. */
  struct Deformation
  {
    double elastic          = 0.; ///< [J]
    double min_volume_ratio = 1e300;
    double max_volume_ratio = -1e300;
    unsigned int inverted = 0; ///< cells with a volume ratio of zero or less, at a point of theirs
  };


  /** What is drawn of a cell. */
  struct CellState
  {
    double volume_ratio;
    double von_mises_stress; ///< [Pa]
    double rotation_angle;   ///< [degrees]
    double pressure;         ///< [Pa], positive where the cell is squeezed
  };


  /** Mean stresses [Pa] at the points of cells whose resistance to a change of volume is not their
   * own, and the measure of volume that they belong to. */
  struct MeanStress
  {
    VolumeMeasure measure;
    std::vector<double> of_points;
  };


  /**
   * The stress that a deformation causes, in sweeps over all cells of a process. An own law is a
   * struct of formulas for n_lanes cells (LawSweeps has the list of them, Corotational is one), and
   * a line in laws.cc.
   *
   * Rotations belong to the caller: they are those of the displacement, or older ones.
   */
  class Law
  {
  public:
    virtual ~Law() = default;

    virtual std::string
    name() const = 0;

    /** Whether the force is linear in the displacement, so that its derivative never changes. */
    virtual bool
    is_linear() const = 0;

    /** Whether the force is the gradient of the elastic energy. */
    virtual bool
    has_energy() const = 0;

    /** Whether cells have rotations other than I. */
    virtual bool
    has_rotations() const = 0;

    /** How many numbers the law remembers of each cell from step to step. */
    virtual unsigned int
    n_internal_variables() const
    {
      return 0;
    }

    /** R of every cell. */
    virtual void
    update_rotations(const double *displacement, CellRotations::List &rotations) const = 0;

    /** f -= the forces that the stress exerts on the nodes [N]. */
    virtual void
    subtract_force(const CellRotations &rotations,
                   const double *displacement,
                   double *force) const = 0;

    virtual Deformation
    deformation(const CellRotations &rotations, const double *displacement) const = 0;

    /** For each cell in the order given to Cells, owned or not. */
    virtual std::vector<CellState>
    states(const CellRotations &rotations, const double *displacement) const = 0;

    /** First Piola-Kirchhoff stress of each batch, or of the four points of each batch of quadratic
     * cells [Pa]; without P33 in plane stress. */
    virtual std::vector<Matrix3<Pack>>
    stresses(const CellRotations &rotations, const double *displacement) const = 0;

    /** Sum over owned cells and their nodes of (round-off in the node's force)^2 [N^2], at strains
     * of order one. */
    virtual double
    round_off_square() const = 0;

    /**
     * Computes what the derivatives of the rotations add to K; kept until called again.
     * @param mean_stress of cells whose resistance to a change of volume is not their own: what the
     * second derivative of a cell's volume change adds. It is indefinite for the determinant: there
     * the definite tangent goes without it.
     */
    virtual void
    update_tangent(Tangent tangent,
                   const CellRotations &rotations,
                   const double *displacement,
                   const MeanStress *mean_stress = nullptr) = 0;

    /** Whether K is free of derivatives of the rotations. */
    virtual bool
    tangent_is_frozen() const = 0;

    /** y += factor K w with frozen rotations. */
    virtual void
    add_frozen_product(const CellRotations &rotations,
                       double factor,
                       const double *w,
                       double *y) const = 0;

    /** y += factor times what the derivatives of the rotations add to K w. */
    virtual void
    add_turning_product(const CellRotations &rotations,
                        double factor,
                        const double *w,
                        double *y) const = 0;

    /**
     * A += mass M + frozen K + turning (what the derivatives of the rotations add to K).
     * @param added_bulk this many shear moduli are added to the bulk modulus
     */
    virtual void
    add_tangent(const CellRotations &rotations,
                double mass,
                double frozen,
                double turning,
                const CellSlots &slots,
                SymmetricBlockMatrix &A,
                double added_bulk = 0.) const = 0;

    /**
     * The same for the displacements of the vertices alone, those of middles of edges being the
     * means of both ends: P^T A P, for quadratic cells; of linear ones it is A.
     * @param slots of the corners in a matrix on the vertices
     * @param added_bulk as in add_tangent()
     */
    virtual void
    add_vertex_tangent(const CellRotations &rotations,
                       double mass,
                       double frozen,
                       double turning,
                       const CellSlots &slots,
                       SymmetricBlockMatrix &A,
                       double added_bulk = 0.) const = 0;

    /** Owned cells whose rotation differs by more than an angle [rad] from the one that is kept. */
    virtual std::size_t
    n_turned(const CellRotations &rotations, double angle) const = 0;

    /** Renews the kept rotations of these cells, and adds what this changes to A = ... + frozen K.
     */
    virtual void
    renew_tangent(CellRotations &rotations,
                  double angle,
                  double frozen,
                  const CellSlots &slots,
                  SymmetricBlockMatrix &A) const = 0;
  };
} // namespace Supple

#endif
