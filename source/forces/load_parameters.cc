#include <supple/forces/load_parameters.h>

#include <supple/input/entries.h>

#include <algorithm>

namespace Supple
{
  using dealii::ParameterHandler;
  using namespace Entries;

  namespace
  {
    Range
    three_numbers_or_expressions()
    {
      const RangeList numbers = RangeList::three(Range::finite());
      return {numbers.description() + "; or " + Range::expressions(3).description(),
              [numbers](const std::string &text) {
                return text.find(';') != std::string::npos || numbers.match(text);
              }};
    }
  } // namespace


  void
  LoadParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Loads");
    add(prm,
        "Gravity",
        gravity,
        "m/s^2",
        three_numbers_or_expressions(),
        "Acceleration by gravity, at the place at rest and time.");
    add(prm,
        "Body force",
        body_force,
        "N/m^3",
        Range::expressions(3),
        "Force per volume at rest position and time.");
    add(prm,
        "Nodal force",
        nodal_force,
        "N",
        Range::expressions(3),
        "Force on each single vertex, at its place at rest and time.");
    prm.add_parameter(
      "Nodal force on",
      nodal_force_on,
      "Which vertices the nodal force acts on. Unit: none. Range: as Of in subsection Motion.",
      dealii::Patterns::Anything());
    add(prm,
        "Traction",
        traction,
        "Pa",
        Range::expressions(3),
        "Force per area at rest, at the place at rest and time.");
    add(prm,
        "Traction on",
        traction_on,
        "none",
        RangeList::boundary_ids(),
        "Where the traction acts.");
    add(prm,
        "Pressure",
        pressure,
        "Pa",
        Range::expressions(1),
        "Pressure that pushes on the surface from outside the body, such as blood on the wall of a "
        "vein; it may depend on t.");
    add(prm,
        "Pressure on",
        pressure_on,
        "none",
        RangeList::boundary_ids(),
        "Where the pressure acts.");
    add_choice(
      prm,
      "Pressure follows",
      pressure_follows,
      {{"true", true}, {"false", false}},
      "Whether the pressure acts on the surface as it is deformed (in methods with rotations "
      "frozen in each step as it is at the start of the step) or as it is at rest. Pressure "
      "that follows grows with the surface: beyond what a body can bear there is no "
      "equilibrium, and a static scene ends with exit status 2. Linear elasticity "
      "(Corotation/Rotation = none) bears it only while displacements are small.");
    prm.leave_subsection();
  }


  std::string
  LoadParameters::gravity_expressions() const
  {
    std::string text = gravity;
    if (text.find(';') == std::string::npos) // three numbers
      std::replace(text.begin(), text.end(), ',', ';');
    return text;
  }
} // namespace Supple
