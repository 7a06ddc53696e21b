#ifndef supple_cell_stresses_h
#define supple_cell_stresses_h

#include <supple/mechanics/configuration.h>
#include <supple/observe/recovery.h>

#include <vector>

namespace Supple
{
  /** The stresses of all cells of a process in a configuration, with the mean stress of patches
   * where these resist to a change of volume. */
  struct CellStresses
  {
    /** @param configuration with the rotations of its displacement */
    CellStresses(const Configuration &configuration, const Law &law);

    /** First Piola-Kirchhoff stress P of each point of each batch [Pa]. */
    std::vector<Matrix3<Pack>> piola;

    /**
     * T = P R^T of each point of each cell [Pa]: the stress of the turned cell, symmetric. Lanes 0
     * to 5 have its deviator, s11, s22, s33 and sqrt(2) times s12, s23, s31, and lane 6 its mean,
     * so that
     *
     *   T : C^-1 : T = (sum of the squares of lanes 0 to 5) / (2 mu) + lane 6^2 / kappa.
     */
    std::vector<Octet> turned;
  };
} // namespace Supple

#endif
