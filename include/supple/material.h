#ifndef supple_material_h
#define supple_material_h

namespace Supple
{
  /** An isotropic linear elastic material. */
  struct IsotropicMaterial
  {
    double lambda;  ///< Lame's first parameter [Pa]
    double mu;      ///< shear modulus [Pa]
    double density; ///< [kg/m^3]

    /** Poisson's ratio. */
    double
    poisson() const
    {
      return lambda / (2. * (lambda + mu));
    }
  };
} // namespace Supple

#endif
