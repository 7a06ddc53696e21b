#ifndef supple_space_error_h
#define supple_space_error_h

#include <supple/forces/elastic_force.h>
#include <supple/observe/cell_stresses.h>
#include <supple/observe/recovery.h>

#include <optional>
#include <vector>

namespace Supple
{
  /** A relative error beyond which numbers mean little. */
  constexpr double largest_told_error = 0.5;


  /** What the recovered stress says of the error of a configuration, of all processes. */
  struct EnergyError
  {
    double square        = 0.; ///< eta^2, twice the strain energy of the error [J]
    double of_patches    = 0.; ///< what patches add to the error of the work, see SpaceError [J]
    double strain_energy = 0.; ///< W [J]
    std::optional<double> lock_ratio; ///< error by jumps over that by recovery; if it was asked for
    unsigned int inverted = 0;        ///< cells
    bool rough            = false;    ///< see Recovery::is_rough()

    /** eta / sqrt(2 W + eta^2), relative error in the energy norm. */
    double
    relative_norm() const;

    /** e / (2 W + e): what the work of given loads lacks of the right one. */
    double
    of_work() const;

    /** e / (2 W - e): what the forces at given displacements have too much of the right ones; may
     * be infinite. */
    double
    of_forces() const;

    /** sqrt(1 + e / (2 W)) - 1: by how much a swing of this shape is too quick. */
    double
    of_frequency() const;

    /** Cells lock, so that the error is more than the estimate. */
    bool
    locks() const;

    /** Cells lock so much that the estimate is far too small. */
    bool
    is_unknown_by_locking() const;

  private:
    /** e = eta^2 and the patches' part [J]. */
    double
    of_energy() const;
  };


  /** The errors of this process's cells in a state, see SpaceError::of_cells(). */
  struct CellErrors
  {
    unsigned int step = 0;       ///< of the state
    std::vector<float> of_cells; ///< empty where they are unknown
  };


  /**
   * The error in space of a configuration by superconvergent patch recovery: with the recovered
   * stress T*,
   *
   *   eta_e^2 = integral over the cell of (T* - T) : C^-1 : (T* - T),   eta^2 = sum eta_e^2,
   *
   * where C is the elasticity of the material. Patches of cells that keep their volume together are
   * no longer too stiff alone; the error of the work has
   *
   *   (1 - k/kappa) sum V (Theta_P - theta_e) (2 (p*_e - p_e) - k (Theta_P - theta_e))
   *
   * beside eta^2, with the mean stress p, the mean p*_e of the recovered one in a cell or its value
   * at a point, and the bulk modulus k that cells keep: 0, or 2/3 mu of quadratic ones
   * (VolumetricPatches has the rest).
   */
  class SpaceError
  {
  public:
    /** Collective. */
    SpaceError(const Configuration &configuration, const ElasticForce &elastic);

    /** Of the configuration as it is, which must have the rotations of its displacement;
     * collective.
     */
    const EnergyError &
    estimate();

    /** The stresses of the last estimate. */
    const CellStresses &
    stresses() const
    {
      return *stress;
    }

    /** The mean stress in lane 6 and the rest of CellStresses::turned with what is recovered of it.
     */
    const Recovery::Field &
    recovered() const
    {
      return field;
    }

    /** Of this process's cells, by LocalCell::index: eta_e over the root of the mean of 2 W + eta^2
     * in its volume. The mean of its square over the body is that of EnergyError::relative_norm().
     */
    std::vector<float>
    of_cells() const;

    /** eta_e^2 of the cells of the body [J]; zero of those of other processes. */
    const std::vector<double> &
    of_body_cells() const
    {
      return squares;
    }

    const Recovery recovery;

  private:
    void
    find_indicators();

    /** This process's part of EnergyError::of_patches [J]. */
    double
    part_of_patches() const;

    /** The error of the cells that may lock by jumps over that by recovery; nothing if there are
     * none, or they have no error; collective. */
    std::optional<double>
    lock_ratio() const;

    /** Whether the material is near to incompressible, so that its cells may lock. */
    bool
    may_lock(unsigned int material) const;

    const Configuration &configuration;
    const ElasticForce &elastic;
    EnergyError error;
    std::optional<CellStresses> stress;
    Recovery::Field field;
    std::vector<double> squares; ///< eta_e^2 of the cells of the body [J]; zero of those not owned
  };
} // namespace Supple

#endif
