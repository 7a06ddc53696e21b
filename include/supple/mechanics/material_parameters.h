#ifndef supple_material_parameters_h
#define supple_material_parameters_h

#include <supple/input/parameter_file.h>
#include <supple/mechanics/law_choice.h>
#include <supple/mechanics/material.h>
#include <supple/mechanics/rotation.h>

#include <map>
#include <string>

namespace Supple
{
  /** Subsection Material. */
  struct MaterialParameters
  {
    enum class Constants
    {
      young_poisson,
      lame
    };

    enum class LockingCure
    {
      none,
      patches
    };

    std::string law              = "corotational";
    Constants constants          = Constants::young_poisson;
    LockingCure cure             = LockingCure::none;
    VolumeMeasure volume_measure = VolumeMeasure::determinant; ///< of patches
    double young                 = 1e6;
    double poisson               = 0.3;
    double lambda                = 1e6;
    double mu                    = 1e6;
    double density               = 1000.;
    bool lumped                  = false;
    double mooney_ratio          = 0.25; ///< c2 / c1 of the law mooney-rivlin
    double vertex_mass           = 0.;   ///< [kg]; if positive, densities count for nothing
    std::string by_id;                   ///< as written

    void
    declare(dealii::ParameterHandler &prm);

    /** @throws InputError for a material without resistance to pressure */
    void
    check(const ParameterFile &scene) const;

    /** The law with its constants beside those of the material. */
    LawChoice
    law_choice() const
    {
      return {law, mooney_ratio};
    }

    /** What holds for cells whose material id is not in the list below. */
    IsotropicMaterial
    preset() const;

    /** Materials of their own by id, checked.
     * @param names ids of groups of the mesh file, which may be called by their names
     * @throws InputError */
    std::map<unsigned int, IsotropicMaterial>
    exceptions(const std::string &origin,
               const std::map<std::string, unsigned int> &names = {}) const;

  private:
    void
    declare_constants(dealii::ParameterHandler &prm);
  };


  /** Subsection Corotation: how the rotations of the cells are found. */
  struct CorotationParameters
  {
    RotationMethod rotation = RotationMethod::polar;
    double warp_tolerance   = 0.; ///< [degrees]

    void
    declare(dealii::ParameterHandler &prm);
  };


  /** Subsection Damping: D = mass_factor M + stiffness_factor K' + viscous I. */
  struct DampingParameters
  {
    double mass_factor      = 0.; ///< [1/s]
    double stiffness_factor = 0.; ///< [s]
    double viscous          = 0.; ///< [N s/m] at each node

    void
    declare(dealii::ParameterHandler &prm);

    bool
    any() const;
  };
} // namespace Supple

#endif
