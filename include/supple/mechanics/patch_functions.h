#ifndef supple_patch_functions_h
#define supple_patch_functions_h

#include <array>
#include <vector>

namespace Supple
{
  /** A point of a patch of cells, and the volume that it stands for. */
  struct PatchPoint
  {
    std::array<double, 3> place; ///< [m]
    double volume;               ///< [m^3]
  };


  /** Four linear functions, each by its coefficients of 1, x, y, z. */
  using LinearFunctions = std::array<std::array<double, 4>, 4>;


  /** 1 and three linear functions that are orthogonal over the points: sum V psi_k psi_l is the
   * volume of them all for k = l, and otherwise zero. @param points not all in a plane */
  LinearFunctions
  orthogonal_functions(const std::vector<PatchPoint> &points);
} // namespace Supple

#endif
