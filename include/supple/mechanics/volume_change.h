#ifndef supple_volume_change_h
#define supple_volume_change_h

#include <supple/mechanics/law.h>

#include <array>
#include <vector>

namespace Supple
{
  /**
   * How much the volume has changed at the points of all cells, of which a linear one has one, in a
   * measure that is linear in the displacement as long as H is kept:
   * V theta = constant + sum_a gradient_a . u_a.
   */
  struct VolumeChanges
  {
    unsigned int n_nodes = 0;                     ///< of a cell
    std::vector<double> volume;                   ///< V at rest, of each point [m^3]
    std::vector<double> constant;                 ///< of each point [m^3]
    std::vector<std::array<double, 3>> gradients; ///< V H grad N_a [m^2], n_nodes of each point
  };


  /** H of a point of a batch: the rotation (trace) or cof F (determinant). */
  inline Matrix3<Pack>
  volume_gradient(const CellRotations::List &rotations,
                  const VolumeMeasure measure,
                  const std::size_t place,
                  const Matrix3<Pack> &F)
  {
    if (measure == VolumeMeasure::determinant)
      return cofactor(F);
    return rotations.empty() ? Matrix3<Pack>::identity() : rotations[place];
  }


  /**
   * About this displacement: theta = H : F - h with H = R, h = 3 (trace, with the rotations given)
   * or H = cof F, h = 2 det F + 1 (determinant). With the hoop strain of an axisymmetric body. The
   * nodes of a linear cell ascend, those of a quadratic one are as in Cells::nodes_of().
   */
  void
  find_volume_changes(const Cells &cells,
                      const CellRotations::List &rotations,
                      VolumeMeasure measure,
                      const double *displacement,
                      VolumeChanges &changes);


  /** The second derivative of det F at the points of all cells, each times the volume V and a mean
   * stress s [N m]. */
  class VolumeStiffness
  {
  public:
    explicit VolumeStiffness(const Cells &cells)
      : cells(cells)
    {
    }

    /** About this displacement. @param mean_stress of each point [Pa] */
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

    /** The columns of the block of nodes a, c of a batch of linear cells. */
    std::array<std::array<Pack, 3>, 3>
    block(std::size_t batch, unsigned int a, unsigned int c) const;

    /** y += factor times its product with w, of linear cells */
    void
    add_product(double factor, const double *w, double *y) const;

    /** V s times the derivative of cof F in a direction G at a point of a batch, with hoop strain.
     */
    Matrix3<Pack>
    stress(std::size_t place, const Matrix3<Pack> &G) const;

  private:
    const Cells &cells;
    std::vector<Matrix3<Pack>> VsF; ///< V s F of each point of each batch
  };
} // namespace Supple

#endif
