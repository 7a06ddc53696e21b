#ifndef supple_load_parameters_h
#define supple_load_parameters_h

#include <supple/base/hand_path.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace Supple
{
  /** Springs between a hand and nodes: no entry of a scene, but part of a live session. */
  struct Pull
  {
    struct End
    {
      unsigned int vertex;         ///< index in the mesh
      double stiffness;            ///< [N/m]
      dealii::Tensor<1, 3> offset; ///< from the hand [m]
    };

    std::vector<End> ends;
    SharedHandPath path; ///< of the hand
  };


  /** Subsection Loads: the forces on the body. */
  struct LoadParameters
  {
    std::string gravity        = "0, 0, 0"; ///< [m/s^2], three numbers or expressions
    std::string body_force     = "0; 0; 0"; ///< [N/m^3]
    std::string nodal_force    = "0; 0; 0"; ///< [N]
    std::string nodal_force_on = "all";
    std::string traction       = "0; 0; 0"; ///< [Pa]
    std::vector<std::string> traction_on;
    std::string pressure = "0"; ///< [Pa]
    std::vector<std::string> pressure_on;
    bool pressure_follows = true;

    std::vector<Pull> pulls; ///< of hands

    void
    declare(dealii::ParameterHandler &prm);

    /** Gravity as expressions, separated by semicolons. */
    std::string
    gravity_expressions() const;
  };
} // namespace Supple

#endif
