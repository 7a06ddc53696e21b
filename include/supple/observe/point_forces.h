#ifndef supple_point_forces_h
#define supple_point_forces_h

#include <supple/forces/load_parameters.h>
#include <supple/mechanics/constraints.h>

#include <vector>

namespace Supple
{
  /**
   * Vertices at which a nodal force acts, or at which the body is held or moved, though no face of
   * a cell shares that: on finer and finer meshes these are forces at points or along lines, and
   * the exact solution has infinite strain energy there (Kelvin 1848).
   */
  class PointForces
  {
  public:
    /** @param scene knows where the entries were set
     * @throws InputError */
    PointForces(const Body &body,
                const Constraints &constraints,
                const LoadParameters &loads,
                const ParameterFile &scene);

    /** Whether more than a twentieth of the forces acts so; collective.
     * @param reactions of what holds the body [N]
     * @param loads     on the body [N] */
    bool
    matter(const Vector &reactions, const Vector &loads) const;

    /** Whether a nodal force acts so at a degree of freedom of this process. */
    bool
    load(const unsigned int dof) const
    {
      return is_loaded[dof / 3];
    }

  private:
    /** Of these nodes, the owned ones that are not on a face of a cell with all its nodes among
     * them. */
    std::vector<bool>
    without_face(const std::vector<bool> &nodes) const;

    const Body &body;
    std::vector<bool> is_loaded;          ///< owned nodes
    std::vector<unsigned int> held_alone; ///< owned degrees of freedom
  };
} // namespace Supple

#endif
