#ifndef supple_material_h
#define supple_material_h

#include <supple/mesh/section.h>

namespace Supple
{
  /** How much larger a cell has become than at rest. */
  enum class VolumeMeasure
  {
    trace,      ///< tr(R^T F) - 3: exact for small strains
    determinant ///< det F - 1: exact
  };


  /** An isotropic linear elastic material. */
  struct IsotropicMaterial
  {
    double lambda;  ///< Lame's first parameter [Pa]
    double mu;      ///< shear modulus [Pa]
    double density; ///< [kg/m^3]

    /** Bulk modulus [Pa]. */
    double
    bulk() const
    {
      return lambda + 2. / 3. * mu;
    }

    /** The same material without resistance to a change of volume. */
    IsotropicMaterial
    deviatoric() const
    {
      return {-2. / 3. * mu, mu, density};
    }

    /** The same material with lambda = 0, which leaves it a bulk modulus of 2/3 mu. */
    IsotropicMaterial
    without_lambda() const
    {
      return {0., mu, density};
    }

    /** Poisson's ratio. */
    double
    poisson() const
    {
      return lambda / (2. * (lambda + mu));
    }
  };


  /** The material with which three-dimensional formulas give the stresses in the plane of a body.
   */
  inline IsotropicMaterial
  effective(const IsotropicMaterial &material, const Section &section)
  {
    if (section.geometry != Geometry::plane_stress)
      return material;
    const double lambda = material.lambda, mu = material.mu;
    return {2. * lambda * mu / (lambda + 2. * mu), mu, material.density};
  }
} // namespace Supple

#endif
