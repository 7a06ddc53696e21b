#include <supple/entries.h>
#include <supple/error.h>
#include <supple/parameters.h>

#include <cmath>

namespace Supple
{
  using dealii::ParameterHandler;
  using namespace Entries;

  void
  MeshParameters::declare_cylinder(ParameterHandler &prm)
  {
    const Range positive = Range::between(0, infinity);
    add(prm, "Cylinder inner radius", inner_radius, "m", positive, "Radius of the cavity.");
    add(prm, "Cylinder outer radius", outer_radius, "m", positive, "Radius of the outer wall.");
    add(prm, "Cylinder height", height, "m", positive, "Length along z; the middle is at z = 0.");
    add(prm,
        "Cylinder sectors",
        sectors,
        "none",
        Range::whole_number(3),
        "Number of vertices on each circle.");
    add(
      prm,
      "Cylinder rings",
      rings,
      "none",
      Range::whole_number(2),
      "Number of cross sections with vertices, both ends included. Boundary ids: 0 (inner wall), 1 "
      "(outer wall), 2 (bottom), 3 (top).");
    add(prm,
        "Cylinder layers",
        layers,
        "none",
        Range::whole_number(1),
        "Number of layers of cells through the wall.");
  }


  void
  MeshParameters::declare(ParameterHandler &prm)
  {
    const Range positive = Range::between(0, infinity);
    prm.enter_subsection("Mesh");
    add_choice(prm,
               "Shape",
               shape,
               {{"box", Shape::box},
                {"hollow cylinder", Shape::hollow_cylinder},
                {"file", Shape::file}},
               "The body: a box, a hollow cylinder about the z axis, or what a mesh file holds.");
    add(prm,
        "Box origin",
        origin,
        "m",
        RangeList::three(Range::finite()),
        "Corner of the box with the smallest coordinates.");
    add(prm,
        "Box size",
        size,
        "m",
        RangeList::three(positive),
        "Lengths of the box along x, y and z.");
    add(
      prm,
      "Box cubes",
      cubes,
      "none",
      RangeList::three(Range::whole_number(1)),
      "Number of cubes along x, y and z; each is cut into six tetrahedra along its diagonal from "
      "the "
      "smallest to the largest coordinates. The faces of the box have the boundary ids 0 (smallest "
      "x), 1 (largest x), 2, 3 (y), 4, 5 (z).");
    declare_cylinder(prm);
    add(prm,
        "File",
        file,
        "none",
        dealii::Patterns::Anything(),
        "Mesh file (.msh, .vtk, .unv, .mesh, .bdf), relative to the folder of the scene. Physical "
        "volumes "
        "become material ids and physical surfaces boundary ids.");
    add(prm,
        "Scale",
        scale,
        "m per unit of the file",
        positive,
        "All coordinates of a file times this.");
    prm.add_parameter(
      "Boundary regions",
      boundary_regions,
      "Boundary ids by place, such as 7: z < 0.1; 8: z > 2. A face of the surface whose vertices "
      "all satisfy the expression gets the id, whatever it had before. Unit: m. Range: id: "
      "expression of x, y, z, set apart by semicolons.",
      dealii::Patterns::Anything());
    prm.leave_subsection();
  }


  void
  MeshParameters::check(const Parameters &parameters) const
  {
    const double n_cubes = double(cubes[0]) * cubes[1] * cubes[2];
    if (shape == Shape::box && n_cubes > 2e7)
      throw InputError(parameters.origin("Mesh/Box cubes") + ": there can be 2e7 cubes at most.");
    const double n_wedges = double(sectors) * rings * layers;
    if (shape == Shape::hollow_cylinder && n_wedges > 2e7)
      throw InputError(parameters.origin("Mesh/Cylinder rings") +
                       ": there can be 2e7 vertices at most.");
    if (shape == Shape::hollow_cylinder && inner_radius >= outer_radius)
      throw InputError(parameters.origin("Mesh/Cylinder inner radius") +
                       ": it must be smaller than the outer radius.");
    if (shape == Shape::hollow_cylinder &&
        inner_radius > outer_radius * std::cos(dealii::numbers::PI / sectors))
      throw InputError(
        parameters.origin("Mesh/Cylinder sectors") +
        ": so few that the straight edges of the outer wall would cut through the inner one. "
        "Take more sectors or a thicker wall.");
    if (shape == Shape::file && file.empty())
      throw InputError(parameters.origin("Mesh/File") + ": Shape = file needs a mesh file.");
  }
} // namespace Supple
