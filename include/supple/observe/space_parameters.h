#ifndef supple_space_parameters_h
#define supple_space_parameters_h

#include <deal.II/base/parameter_handler.h>

namespace Supple
{
  /** Subsection Space: what is asked of the error in space. */
  struct SpaceParameters
  {
    enum class Estimate
    {
      end,
      frames,
      never
    };

    Estimate estimate = Estimate::end;
    double aim        = 0.; ///< relative error of a static scene; 0: none

    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Supple

#endif
