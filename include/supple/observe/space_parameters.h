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

    /** A second run on another mesh. */
    enum class SecondMesh
    {
      none,
      coarser, ///< cells twice as large
      finer,   ///< each cell cut in eight, or four triangles
      linear   ///< linear cells on the vertices of quadratic ones
    };

    Estimate estimate      = Estimate::end;
    SecondMesh second_mesh = SecondMesh::none;
    double aim             = 0.; ///< relative error of a static scene; 0: none

    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Supple

#endif
