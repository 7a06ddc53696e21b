#ifndef supple_law_choice_h
#define supple_law_choice_h

#include <supple/mechanics/material.h>

#include <string>

namespace Supple
{
  /** A law by its name, with the constants that it has beside those of an isotropic material. */
  struct LawChoice
  {
    std::string name    = "corotational";
    double mooney_ratio = 0.25; ///< c2 / c1 of mooney-rivlin

    /** Whether stress follows from an energy of the deformation gradient alone: all laws but the
     * corotational one. They have no rotations that could be held in a step. */
    bool
    is_hyperelastic() const
    {
      return name != "corotational";
    }

    /**
     * Lame's first parameter [Pa] below which the law has no least energy, or the material no
     * resistance to pressure. Cells whose resistance to a change of volume is that of patches have
     * this one.
     */
    double
    least_lambda(const IsotropicMaterial &material) const;
  };
} // namespace Supple

#endif
