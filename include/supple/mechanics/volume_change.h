#ifndef supple_volume_change_h
#define supple_volume_change_h

#include <supple/mechanics/law.h>

#include <array>
#include <vector>

namespace Supple
{
  /**
   * How much a cell's volume has changed, in a measure that is linear in the displacement as long
   * as H is kept: V theta = constant + sum_a gradient_a . u_a.
   */
  struct VolumeChange
  {
    double volume;                                  ///< V at rest [m^3]
    double constant;                                ///< [m^3]
    std::array<std::array<double, 3>, 4> gradients; ///< V H g_a [m^2], nodes ascending
  };


  /** H of a batch: the rotation (trace) or cof F (determinant). */
  inline Matrix3<Pack>
  volume_gradient(const CellRotations::List &rotations,
                  const VolumeMeasure measure,
                  const std::size_t batch,
                  const Matrix3<Pack> &F)
  {
    if (measure == VolumeMeasure::determinant)
      return cofactor(F);
    return rotations.empty() ? Matrix3<Pack>::identity() : rotations[batch];
  }


  /**
   * Of each cell, about this displacement: theta = H : F - h with H = R, h = 3 (trace, with the
   * rotations given) or H = cof F, h = 2 det F + 1 (determinant). With the hoop strain of an
   * axisymmetric body.
   */
  void
  find_volume_changes(const Cells &cells,
                      const CellRotations::List &rotations,
                      VolumeMeasure measure,
                      const double *displacement,
                      std::vector<VolumeChange> &changes);


  /** The second derivative of the cells' det F, each times the volume V and a mean stress s [N m].
   */
  class VolumeStiffness
  {
  public:
    explicit VolumeStiffness(const Cells &cells)
      : cells(cells)
    {
    }

    /** About this displacement. */
    void
    update(const double *displacement, const std::vector<double> &mean_stress);

    void
    clear()
    {
      VsF.clear();
    }

    /** Whether it is nothing. */
    bool
    empty() const
    {
      return VsF.empty();
    }

    /** The columns of the block of nodes a, c. */
    std::array<std::array<Pack, 3>, 3>
    block(std::size_t batch, unsigned int a, unsigned int c) const;

    /** y += factor times its product with w */
    void
    add_product(double factor, const double *w, double *y) const;

  private:
    /** V s times the derivative of cof F in a direction G, with hoop strain. */
    Matrix3<Pack>
    stress(std::size_t batch, const Matrix3<Pack> &G) const;

    const Cells &cells;
    std::vector<Matrix3<Pack>> VsF; ///< V s F of each batch
  };
} // namespace Supple

#endif
