#ifndef supple_section_h
#define supple_section_h

#include <deal.II/base/numbers.h>

namespace Supple
{
  /** What cells stand for: tetrahedra for themselves, triangles in the plane z = 0 for what is in
   * front of them and behind. */
  enum class Geometry
  {
    solid,
    plane_strain,
    plane_stress,
    axisymmetric
  };


  /**
   * The third direction of a body.
   *
   * - plane_strain: nothing strains along z, F33 = 1.
   * - plane_stress: nothing presses along z, P33 = 0: lambda* = 2 lambda mu / (lambda + 2 mu)
   * instead of lambda gives the stresses in the plane.
   * - axisymmetric: x is the distance r from the axis, y runs along it, and the triangles go all
   * the way round. F33 = 1 + u_r / r, taken at the centroid of each cell.
   */
  struct Section
  {
    Geometry geometry = Geometry::solid;
    double thickness  = 1.; ///< along z [m]

    /** Whether the body lies in the plane z = 0. */
    bool
    plane() const
    {
      return geometry != Geometry::solid;
    }

    bool
    axisymmetric() const
    {
      return geometry == Geometry::axisymmetric;
    }

    /** How far a point of the plane reaches along z, or all around the axis [m]. */
    double
    thickness_at(const double x) const
    {
      return axisymmetric() ? 2. * dealii::numbers::PI * x : thickness;
    }
  };
} // namespace Supple

#endif
