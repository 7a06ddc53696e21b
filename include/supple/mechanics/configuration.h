#ifndef supple_configuration_h
#define supple_configuration_h

#include <supple/base/effort.h>
#include <supple/mechanics/body.h>
#include <supple/mechanics/law.h>
#include <supple/mechanics/volumetric_patches.h>

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <vector>

namespace Supple
{
  /** Displacement [m] and velocity [m/s] of all nodes. A static problem has no velocity: that
   * vector is empty. */
  struct State
  {
    Vector displacement, velocity;

    bool
    has_velocity() const
    {
      return velocity.size() > 0;
    }
  };


  /** Where all is that moves as prescribed, held vertices and tools: at a part of the straight way
   * from its place at one time to that at another. */
  struct Passage
  {
    double from = 0.; ///< the start of the step [s]; the load factor of a static problem
    double to   = 0.; ///< [s]
    double part = 1.; ///< less than 1 only within the iterations of contact
  };


  /**
   * All that the state of a body is: displacement, velocity, and what its cells remember, which are
   * rotations, the rotations that the operator was made with, and the internal variables of their
   * law. An integrator changes it from one accepted state to the next:
   *
   *   begin_step(time);  ... trial states ...  accept() or reject()
   *
   * Rotations are those of the last update_rotations(). In between, a frozen configuration keeps
   * those of the start of its step, and pressure pushes on the surface as it was there.
   */
  class Configuration
  {
  public:
    enum class Rotations
    {
      frozen,   ///< those of the start of the step
      following ///< those of the displacement
    };

    /** The body at rest.
     * @param law of its cells; must outlive the configuration, as the body */
    Configuration(const Body &body, const Law &law, bool has_velocity);

    const Vector &
    displacement() const
    {
      return state.displacement;
    }

    const Vector &
    velocity() const
    {
      return state.velocity;
    }

    /** Displacement and, if there is one, velocity. */
    std::vector<Vector *>
    vectors();

    /** From the next update_rotations() on the tangent takes its strains by the rotations of the
     * update before: sym(R_before^T F) - I is the strain that the correction foresaw, without the
     * stretch that comes of going straight where the body turns. */
    void
    foresee_strains()
    {
      rotations.before = rotations.current;
    }

    /** The tangent takes its strains by the rotations of now. */
    void
    forget_strains()
    {
      rotations.before.clear();
    }

    /** R of every cell from the displacement, and with them the gradients of the volume of patches;
     * nothing to do for linear elasticity. */
    void
    update_rotations(Effort &effort);

    /** What tangents are made with stays as it is now, until called again: the rotations of the
     * cells, and the gradients of the volume of patches. */
    void
    keep_for_tangent();

    /** The displacement of the surface that pressure follows [m]. */
    const Vector &
    surface_displacement() const
    {
      return rotations_are == Rotations::frozen ? start.displacement : state.displacement;
    }

    /** Remembers the state, which must have its rotations, as the start of a step.
     * @param time of the state [s]; the load factor of a static problem */
    void
    begin_step(double time);

    /** At the last begin_step(). */
    const State &
    start_of_step() const
    {
      return start;
    }

    /** The step stands: there is no way back to its start. */
    void
    accept();

    /** Returns to the start of the step, rotations included. */
    void
    reject(Effort &effort);

    /**
     * What cells remember and the displacement does not tell, by the index of the cell in the mesh,
     * so that the number of processes may change; collective, counts on the first process.
     * Displacement and velocity are kept by whoever keeps this.
     */
    nlohmann::json
    save_cells() const;

    /** The same taken back, after displacement and velocity; updates the rotations. Collective.
     * @throws nlohmann::json::exception, std::out_of_range if @p saved is something else */
    void
    load_cells(const nlohmann::json &saved, Effort &effort);

    const Body &body;
    State state;
    Passage passage;
    Rotations rotations_are = Rotations::following;
    CellRotations rotations;
    std::vector<Pack> internal; ///< variables of the law, one after the other for each batch

    /** What resists to a change of volume in place of the cells; null if they do it themselves. */
    std::unique_ptr<VolumetricPatches> patches;

  private:
    const Law &law;
    bool in_step = false;
    State start;
    std::vector<Pack> start_internal;
  };
} // namespace Supple

#endif
