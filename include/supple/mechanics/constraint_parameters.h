#ifndef supple_constraint_parameters_h
#define supple_constraint_parameters_h

#include <supple/base/hand_path.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <vector>

namespace Supple
{
  /** Subsection Constraints: what is held at rest. */
  struct ConstraintParameters
  {
    std::vector<std::string> clamped_boundaries; ///< ids, or names of groups
    std::string clamped_region;
    std::array<std::vector<std::string>, 3> sliding_boundaries; ///< held along x, along y, along z

    /** A vertex that a hand holds: no entry of a scene, but part of a live session. */
    struct ByHand
    {
      unsigned int vertex; ///< index in the mesh
      SharedHandPath path;
    };
    std::vector<ByHand> by_hand;

    void
    declare(dealii::ParameterHandler &prm);
  };


  /** Subsections Motion, Motion 2, ...: a prescribed displacement. */
  struct MotionParameters
  {
    std::string of; ///< which vertices, as written; empty: there is no such motion
    std::string displacement = "0; 0; 0"; ///< three expressions, or the word free

    void
    declare(dealii::ParameterHandler &prm, const std::string &section);
  };


  using Motions = std::array<MotionParameters, 4>;


  /** The subsection of a motion, counted from 0: Motion, Motion 2, ... */
  std::string
  motion_section(unsigned int motion);


  /** Subsection Start: the state at time 0. */
  struct StartParameters
  {
    std::string displacement = "0; 0; 0";
    std::string velocity     = "0; 0; 0";
    dealii::Tensor<1, 3> rotation;    ///< axis times angle [degrees]
    dealii::Point<3> rotation_center; ///< [m]

    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Supple

#endif
