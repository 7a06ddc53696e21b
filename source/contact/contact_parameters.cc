#include <supple/contact/contact_parameters.h>

#include <supple/base/error.h>
#include <supple/input/entries.h>

#include <filesystem>
#include <regex>

namespace Supple
{
  using dealii::ParameterHandler;
  using namespace Entries;

  namespace
  {
    const std::string tool_word = "Tool ";
  }


  void
  ContactParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Contact");
    add(
      prm,
      "Stiffness",
      stiffness,
      "Pa",
      Range::at_least(0),
      "Pressure of the barrier between the body and what it meets where half of its reach is left, "
      "roughly. 0: ten times the Young's modulus of the stiffest material. A softer one is "
      "pressed deeper; far below Young's modulus the steps fail.");
    add(
      prm,
      "Reach",
      reach,
      "m",
      Range::at_least(0),
      "Thickness of the barrier: a body touches a tool where their surfaces meet, and enters it "
      "by less than this. 0: a thousandth of the body's diameter, but no more than a tenth of "
      "the shortest edge of its surface. Of a tool it is at most half the radius, or a quarter of "
      "the shortest edge of a box.");
    add(prm,
        "Guard",
        guard,
        "none",
        Range::between(0, infinity),
        "Part of the barrier that acts on vertices and edges, and on the ends of tools, beside "
        "that which is spread over the surface. They keep tools out that are thinner than a cell; "
        "for large ones 0.01 gives pressures that are smoother.");
    add(prm,
        "Slip resolution",
        slip_resolution,
        "m/s",
        Range::between(0, infinity),
        "Speed below which friction holds less than it can: what should stick creeps by a part of "
        "it.");
    add_choice(prm,
               "Bodies",
               bodies,
               {{"tools", Bodies::tools}, {"pieces", Bodies::pieces}, {"all", Bodies::all}},
               "What a body meets: tools alone; the other pieces of the mesh too; or all surfaces, "
               "its own as well, as folds do. Bodies keep a distance of less than the reach.");
    add(prm,
        "Friction",
        friction,
        "none",
        Range::at_least(0),
        "Coefficient of Coulomb friction between bodies.");
    prm.leave_subsection();
  }


  void
  ToolParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection(section());
    add_choice(prm,
               "Shape",
               shape,
               {{"plane", Shape::plane},
                {"sphere", Shape::sphere},
                {"capsule", Shape::capsule},
                {"box", Shape::box},
                {"file", Shape::file}},
               "A plane with all that is behind it; a sphere; a capsule, a needle with round ends; "
               "a box; or the triangles of a file.");
    add(prm,
        "Position",
        position,
        "m",
        Range::expressions(3),
        "Where its reference point is in time: a point of the plane, the center of the sphere, the "
        "center of the capsule's round tip, the center of the box, the origin of the file. In a "
        "static problem t is the load factor, from 0 to "
        "1.");
    add(prm,
        "Rotation",
        rotation,
        "degrees",
        Range::expressions(3),
        "How the tool is turned about its reference point in time: the axis, as long as the "
        "angle.");
    declare_shapes(prm);
    add(prm,
        "Friction",
        friction,
        "none",
        Range::at_least(0),
        "Coefficient of Coulomb friction on this tool.");
    prm.leave_subsection();
  }


  void
  ToolParameters::declare_shapes(ParameterHandler &prm)
  {
    add(prm,
        "Normal",
        normal,
        "none",
        RangeList::three(Range::finite()),
        "Direction from the plane toward the body, before the rotation.");
    add(prm,
        "Axis",
        axis,
        "m",
        RangeList::three(Range::finite()),
        "From the center of the capsule's tip to that of its other end, before the rotation.");
    add(prm,
        "Radius",
        radius,
        "m",
        Range::between(0, infinity),
        "Radius of the sphere or the capsule.");
    add(prm,
        "Size",
        size,
        "m",
        RangeList::three(Range::between(0, infinity)),
        "Lengths of the edges of the box, before the rotation.");
    add(prm,
        "File",
        file,
        "none",
        dealii::Patterns::Anything(),
        "Surface of the tool (.stl, .obj, .ply), relative to the folder of the scene. The body "
        "feels it from as far as the barrier reaches.");
    add(prm,
        "Scale",
        scale,
        "m per unit of the file",
        Range::between(0, infinity),
        "All coordinates of the file times this.");
  }


  std::string
  ToolParameters::section() const
  {
    return tool_word + name;
  }


  void
  ToolParameters::check(const ParameterFile &scene) const
  {
    if (shape == Shape::plane && normal.norm() == 0.)
      throw InputError(scene.origin(section() + "/Normal") +
                       ": a plane needs a direction toward the body; it must not be 0, 0, 0.");
    if (shape == Shape::capsule && axis.norm() == 0.)
      throw InputError(scene.origin(section() + "/Axis") +
                       ": a capsule of no length is a sphere: take Shape = sphere.");
    if (shape == Shape::file && file.empty())
      throw InputError(scene.origin(section() + "/File") +
                       ": Shape = file needs a surface of triangles: .stl, .obj or .ply.");
  }


  TriangleMesh
  ToolParameters::read(const ParameterFile &scene) const
  {
    return read_triangles((std::filesystem::path(scene.folder()) / file).string(),
                          scene.origin(section() + "/File"));
  }


  std::vector<ToolParameters>
  tools_of(const ParameterFile &scene)
  {
    std::vector<ToolParameters> tools;
    for (const auto &[section, place] : scene.sections())
      {
        if (section.rfind(tool_word, 0) != 0)
          continue;
        tools.emplace_back();
        tools.back().name = section.substr(tool_word.size());
        if (!std::regex_match(tools.back().name, std::regex("[A-Za-z_][A-Za-z_0-9-]*")))
          throw InputError(place + ": subsection " + section +
                           ": the name of a tool has letters, digits, - and _, and begins with a "
                           "letter; its table is tool_NAME.csv.");
      }
    return tools;
  }
} // namespace Supple
