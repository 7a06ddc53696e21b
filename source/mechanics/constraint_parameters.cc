#include <supple/mechanics/constraint_parameters.h>

#include <supple/input/entries.h>

namespace Supple
{
  using dealii::ParameterHandler;
  using namespace Entries;

  void
  ConstraintParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Constraints");
    add(prm,
        "Clamped boundaries",
        clamped_boundaries,
        "none",
        RangeList::boundary_ids(),
        "Boundaries whose vertices keep their place.");
    add(prm,
        "Clamped region",
        clamped_region,
        "none",
        Range::expressions(1),
        "Vertices at which this expression, such as y > 11.9, is true (not zero) keep their place. "
        "Empty: none.");
    for (unsigned int i = 0; i < 3; ++i)
      add(prm,
          std::string("Boundaries held along ") + "xyz"[i],
          sliding_boundaries[i],
          "none",
          RangeList::boundary_ids(),
          std::string("Boundaries whose vertices do not move along ") + "xyz"[i] +
            " but may slide otherwise: planes of symmetry.");
    prm.leave_subsection();
  }


  void
  MotionParameters::declare(ParameterHandler &prm, const std::string &section)
  {
    prm.enter_subsection(section);
    prm.add_parameter(
      "Of",
      of,
      "Which vertices are moved. Empty: none. Unit: m. Range: vertex and an index of the mesh, "
      "nearest to and a point, boundary and ids, region and an expression of x, y, z, or all.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "Displacement",
      displacement,
      "Displacement of these vertices from rest in time; in a static problem t is the load factor, "
      "from 0 to 1. A step at once is 0.01, a ramp 0.01*min(t/0.1, 1). Unit: m. Range: three "
      "expressions of x, y, z, t set apart by semicolons, or "
      "the "
      "word free for a direction that is not prescribed.",
      dealii::Patterns::Anything());
    prm.leave_subsection();
  }


  std::string
  motion_section(const unsigned int motion)
  {
    return motion == 0 ? "Motion" : "Motion " + std::to_string(motion + 1);
  }


  void
  StartParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Start");
    add(prm,
        "Displacement",
        displacement,
        "m",
        Range::expressions(3),
        "Displacement at time 0, after the rotation below; zero where the body is held.");
    add(prm,
        "Velocity",
        velocity,
        "m/s",
        Range::expressions(3),
        "Velocity at time 0; zero where the body is held.");
    add(prm,
        "Rotation",
        rotation,
        "degrees",
        RangeList::three(Range::finite()),
        "Rotation of the body at time 0: the axis, as long as the angle. What is held keeps its "
        "place.");
    add(prm,
        "Rotation center",
        rotation_center,
        "m",
        RangeList::three(Range::finite()),
        "A point on the axis of this rotation.");
    prm.leave_subsection();
  }
} // namespace Supple
