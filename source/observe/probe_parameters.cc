#include <supple/observe/probe_parameters.h>

#include <supple/input/entries.h>

namespace Supple
{
  using dealii::ParameterHandler;
  using namespace Entries;

  void
  ProbeParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Probes");
    const dealii::Patterns::Anything any;
    prm.add_parameter(
      "Points",
      points,
      "Named points, such as tip: 2, 0, 2; corner: vertex 7. The vertex nearest to "
      "each, or that of this index of the mesh, is followed. What is moved "
      "(subsection Motion) is followed in any case, as motion, motion2 ... Unit: m. "
      "Range: name: x, y, z, or name: vertex index, set apart by semicolons.",
      any);
    prm.add_parameter(
      "Boundaries",
      boundaries,
      "Named boundaries, such as wall: 3. Mean displacement and velocity of the vertices and the "
      "sum "
      "of their reactions. Unit: none. Range: name: boundary id, set apart by semicolons.",
      any);
    prm.add_parameter("Regions",
                      regions,
                      "Named regions, such as end: y < 0.1, as for boundaries. Unit: none. Range: "
                      "name: expression of x, "
                      "y, z, set apart by semicolons.",
                      any);
    prm.add_parameter("Profiles",
                      profiles,
                      "Named boundaries whose shape is written, such as skin: 3, into "
                      "profile_skin.csv: for each vertex its distance from the center below, its "
                      "depth -uy, and its deformed position. Unit: none. Range: name: boundary id, "
                      "set apart by semicolons.",
                      any);
    add(prm,
        "Profile center",
        profile_center,
        "m",
        RangeList::three(Range::finite()),
        "Where the needle is: distances in profiles are measured from there along x and z.");
    add(prm,
        "Profile every",
        profile_every,
        "steps",
        Range::whole_number(1),
        "Number of steps from profile to profile. The first and the last state are always "
        "written.");
    prm.leave_subsection();
  }
} // namespace Supple
