#ifndef supple_stress_jumps_h
#define supple_stress_jumps_h

#include <supple/mechanics/body.h>

#include <functional>
#include <vector>

namespace Supple
{
  /**
   * An estimate of the error of the strain energy by the jumps of the traction between cells
   * (Kelly, Gago, Zienkiewicz and Babuska 1983), twice that energy [J]:
   *
   *   sum h A |[P n]|^2 / (48 mu)
   *
   * over the faces between two cells of one material, with their area A and size h, the root of A
   * or the length of an edge. It grows without bounds beside that of Recovery where cells lock, for
   * then pressures go up and down from cell to cell. Collective.
   * @param piola first Piola-Kirchhoff stress P of each batch [Pa]
   * @param counts whether the cells of a material id count
   */
  double
  jump_estimate(const Body &body,
                const std::vector<Matrix3<Pack>> &piola,
                const std::function<bool(unsigned int)> &counts);
} // namespace Supple

#endif
