#ifndef supple_tool_report_h
#define supple_tool_report_h

#include <deal.II/base/tensor.h>

namespace Supple
{
  /** What a tool meets. */
  struct ToolReport
  {
    dealii::Tensor<1, 3> place;  ///< of its reference point [m]
    dealii::Tensor<1, 3> force;  ///< on the body [N]
    dealii::Tensor<1, 3> torque; ///< on the body, about the reference point [N m]
    double gap   = 0.;           ///< the least one to its core, more than zero [m]
    double depth = 0.; ///< how far the body is within it, less than the barrier reaches [m]
    double area  = 0.; ///< of the surface at rest that it touches [m^2]
    double work  = 0.; ///< since the start [J]
  };
} // namespace Supple

#endif
