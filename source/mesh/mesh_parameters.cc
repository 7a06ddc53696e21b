#include <supple/mesh/mesh_parameters.h>

#include <supple/base/error.h>
#include <supple/input/entries.h>

#include <cmath>
#include <numeric>
#include <sstream>

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
  MeshParameters::declare_rectangle(ParameterHandler &prm)
  {
    add(prm,
        "Rectangle origin",
        rectangle_origin,
        "m",
        RangeList::two(Range::finite()),
        "Corner of the rectangle with the smallest x and y.");
    add(prm,
        "Rectangle size",
        rectangle_size,
        "m",
        RangeList::two(Range::between(0, infinity)),
        "Lengths of the rectangle along x and y.");
    add(prm,
        "Rectangle squares",
        squares,
        "none",
        RangeList::two(Range::whole_number(1)),
        "Number of squares along x and y; each is cut into two triangles. The edges of the "
        "rectangle have the boundary ids 0 (left), 1 (right), 2 (bottom), 3 (top).");
    add_choice(prm,
               "Rectangle split",
               split,
               {{"falling", Split::falling},
                {"rising", Split::rising},
                {"alternating", Split::alternating}},
               "How squares are cut: from the upper left to the lower right, from the lower left "
               "to the upper right, or as on a chessboard, beginning with falling in the lower "
               "left corner. With an even number of squares along x the last one is a mirror "
               "image of itself.");
  }


  void
  MeshParameters::declare_file(ParameterHandler &prm)
  {
    const Range positive = Range::between(0, infinity);
    add(
      prm,
      "File",
      file,
      "none",
      dealii::Patterns::Anything(),
      "Mesh file (.msh, .vtk, .vtu, .unv, .mesh, .bdf, .nas), relative to the folder of the scene. "
      "Physical volumes become material ids and physical surfaces boundary ids, as do groups, "
      "references and properties of other formats; names of groups may stand for their ids in "
      "other entries. A file without tetrahedra, but with triangles in the plane z = 0, is a "
      "plane body: physical surfaces become material ids and physical curves boundary ids. "
      "Several files, set apart by commas, are pieces of one body.");
    add(prm,
        "Scale",
        scale,
        "m per unit of the file",
        positive,
        "All coordinates of a file times this.");
    prm.add_parameter(
      "Map",
      map,
      "Where a vertex is put that the mesh has at x, y, z, such as x*cos(y); x*sin(y); z for a "
      "ring "
      "out of a box. Cells, boundary ids and materials stay what they are; Boundary regions and "
      "all other places mean the body after it. Empty: vertices stay. Unit: m. Range: three "
      "expressions of x, y, z set apart by semicolons; the third is 0 for a plane body.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "Piece maps",
      piece_maps,
      "Where vertices of each piece are put, before Refine and Map: one map for each of several "
      "files, or one for each copy of the one mesh there is, such as x; y; z | x; y; z + 0.11 for "
      "two boxes. Pieces share no vertex; they touch each other by Contact/Bodies. Empty: pieces "
      "stay where their files put them. Unit: m. Range: maps as of Map, set apart by |.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "Boundary regions",
      boundary_regions,
      "Boundary ids by place, such as 7: z < 0.1; 8: z > 2. A face of the surface whose vertices "
      "all satisfy the expression gets the id, whatever it had before. Unit: m. Range: id: "
      "expression of x, y, z, set apart by semicolons.",
      dealii::Patterns::Anything());
  }


  void
  MeshParameters::declare_layers(ParameterHandler &prm)
  {
    const Range positive = Range::between(0, infinity);
    add(
      prm,
      "Layers",
      material_layers,
      "m",
      RangeList("thicknesses set apart by commas, each " + positive.description() + ", or nothing",
                positive,
                0,
                dealii::Patterns::List::max_int_value),
      "Layers of a box or a rectangle from the top, the largest y, downward: their cells have the "
      "material ids 0, 1, ... Together they are as thick as the body. Without Layer rows each has "
      "to "
      "end where a row of cubes or squares does; with them it ends anywhere. Empty: all cells have "
      "the material id 0.");
    add(prm,
        "Layer rows",
        layer_rows,
        "none",
        RangeList("whole numbers set apart by commas, each " +
                    Range::whole_number(1).description() + ", or nothing",
                  Range::whole_number(1),
                  0,
                  dealii::Patterns::List::max_int_value),
        "How many of the rows of cubes or squares each of the Layers has, a number for each, from "
        "the top downward; together all rows. The rows of a layer are equally high, and it may end "
        "anywhere. Empty: all rows of the body are equally high.");
  }


  void
  MeshParameters::declare_order(ParameterHandler &prm)
  {
    add(prm,
        "Order",
        order,
        "none",
        Range("1 or 2", [](const std::string &text) { return text == "1" || text == "2"; }),
        "Of the displacements in a cell. 1: linear, by its vertices. 2: quadratic, by nodes in the "
        "middles of edges too; tetrahedra alone. Where a body bends, the same error takes a "
        "fraction of the unknowns (doc/order.md). The nodes of a hollow cylinder are on its "
        "walls; Map puts them where it puts vertices.");
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
                {"rectangle", Shape::rectangle},
                {"file", Shape::file}},
               "The body: a box, a hollow cylinder about the z axis, a rectangle of triangles in "
               "the plane z = 0 (subsection Plane), or what a mesh file holds.");
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
    declare_rectangle(prm);
    declare_layers(prm);
    declare_file(prm);
    declare_order(prm);
    refinement.declare(prm);
    prm.leave_subsection();
  }


  std::pair<double, unsigned int>
  MeshParameters::height_and_rows() const
  {
    return shape == Shape::box ? std::make_pair(size[1], cubes[1])
                               : std::make_pair(rectangle_size[1], squares[1]);
  }


  std::vector<double>
  MeshParameters::ends_of_rows(const double height, const unsigned int n_rows) const
  {
    std::vector<double> ends(n_rows + 1);
    if (layer_rows.empty())
      for (unsigned int row = 0; row <= n_rows; ++row)
        ends[row] = height * row / n_rows;
    else
      {
        unsigned int row = n_rows;
        double top       = height;
        for (unsigned int layer = 0; layer < layer_rows.size(); ++layer)
          {
            for (unsigned int r = 0; r < layer_rows[layer]; ++r)
              ends[row - r] = top - material_layers[layer] * r / layer_rows[layer];
            row -= layer_rows[layer];
            top -= material_layers[layer];
          }
        ends[0] = 0.;
      }
    return ends;
  }


  std::vector<unsigned int>
  MeshParameters::material_of_rows(const std::vector<double> &ends) const
  {
    std::vector<unsigned int> material(ends.size() - 1);
    double bottom = ends.back();
    for (unsigned int layer = 0; layer < material_layers.size(); ++layer)
      {
        bottom -= material_layers[layer];
        for (unsigned int row = 0; row < material.size(); ++row)
          if (0.5 * (ends[row] + ends[row + 1]) < bottom)
            material[row] = layer + 1;
      }
    return material;
  }


  void
  MeshParameters::check_layers(const ParameterFile &scene) const
  {
    if (material_layers.empty())
      return;
    const std::string origin = scene.origin("Mesh/Layers");
    if (shape != Shape::box && shape != Shape::rectangle)
      throw InputError(origin + ": only a box and a rectangle have layers; with other shapes " +
                       "leave it empty.");

    const auto [height, n_rows] = height_and_rows();
    std::ostringstream text;
    double depth = 0.;
    for (const double thickness : material_layers)
      {
        depth += thickness;
        const double rows = depth / height * n_rows;
        if (std::abs(rows - std::round(rows)) > 1e-6 && layer_rows.empty() && text.str().empty())
          text << ": a layer ends " << depth << " m below the top, which is not where a row ends; "
               << "the rows are " << height / n_rows
               << " m high. Mesh/Layer rows lets it end anywhere.";
      }
    if (std::abs(depth / height - 1.) > 1e-6)
      {
        text.str("");
        text << ": the layers are " << depth << " m thick together, but the body is " << height
             << " m high (along y).";
      }
    if (!text.str().empty())
      throw InputError(origin + text.str());
  }


  void
  MeshParameters::check_layer_rows(const ParameterFile &scene) const
  {
    if (layer_rows.empty())
      return;
    const std::string origin = scene.origin("Mesh/Layer rows");
    if (layer_rows.size() != material_layers.size())
      throw InputError(origin + ": found " + std::to_string(layer_rows.size()) + " number(s) for " +
                       std::to_string(material_layers.size()) + " layer(s) (Mesh/Layers); there " +
                       "must be one for each.");
    const double total        = std::accumulate(layer_rows.begin(), layer_rows.end(), 0.);
    const unsigned int n_rows = height_and_rows().second;
    if (total != n_rows)
      throw InputError(origin + ": these are " + std::to_string(std::lround(total)) +
                       " rows together, but the body has " + std::to_string(n_rows) + " along y.");
  }


  bool
  MeshParameters::walls_cross() const
  {
    return inner_radius > outer_radius * std::cos(dealii::numbers::PI / sectors);
  }


  void
  MeshParameters::check_cylinder(const ParameterFile &scene) const
  {
    const double n_wedges = double(sectors) * rings * layers;
    if (n_wedges > 2e7)
      throw InputError(scene.origin("Mesh/Cylinder rings") +
                       ": there can be 2e7 vertices at most.");
    if (inner_radius >= outer_radius)
      throw InputError(scene.origin("Mesh/Cylinder inner radius") +
                       ": it must be smaller than the outer radius.");
    if (walls_cross())
      throw InputError(
        scene.origin("Mesh/Cylinder sectors") +
        ": so few that the straight edges of the outer wall would cut through the inner one. "
        "Take more sectors or a thicker wall.");
  }


  void
  MeshParameters::check_order(const ParameterFile &scene) const
  {
    if (order == 1)
      return;
    const std::string origin = scene.origin("Mesh/Order");
    if (shape == Shape::rectangle)
      throw InputError(origin +
                       ": 2 is for tetrahedra; a rectangle has triangles, whose order is 1.");
  }


  void
  MeshParameters::check(const ParameterFile &scene) const
  {
    check_order(scene);
    const double n_cubes = double(cubes[0]) * cubes[1] * cubes[2];
    if (shape == Shape::box && n_cubes > 2e7)
      throw InputError(scene.origin("Mesh/Box cubes") + ": there can be 2e7 cubes at most.");
    if (shape == Shape::rectangle && double(squares[0]) * squares[1] > 2e7)
      throw InputError(scene.origin("Mesh/Rectangle squares") +
                       ": there can be 2e7 squares at most.");
    if (shape == Shape::hollow_cylinder)
      check_cylinder(scene);
    if (shape == Shape::file && file.empty())
      throw InputError(scene.origin("Mesh/File") + ": Shape = file needs a mesh file.");
    check_layers(scene);
    check_layer_rows(scene);
  }


  void
  PlaneParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Plane");
    add_choice(prm,
               "Model",
               section.geometry,
               {{"plane strain", Geometry::plane_strain},
                {"plane stress", Geometry::plane_stress},
                {"axisymmetric", Geometry::axisymmetric}},
               "Of a body of triangles in the plane z = 0. plane strain: it goes on along z and "
               "does not strain there. plane stress: a plate, on whose faces nothing presses. "
               "axisymmetric: the triangles go around the y axis, and x is the distance from it; "
               "forces and masses are those of the whole circumference, and vertices on the axis "
               "stay on it.");
    add(prm,
        "Thickness",
        section.thickness,
        "m",
        Range::between(0, infinity),
        "Of the plate, or of the piece that is looked at in plane strain: forces and masses are "
        "those of this thickness.");
    prm.leave_subsection();
  }


  void
  PlaneParameters::check(const ParameterFile &scene) const
  {
    if (section.axisymmetric() && section.thickness != 1.)
      throw InputError(scene.origin("Plane/Thickness") +
                       ": an axisymmetric body goes all the way round; leave the thickness at 1.");
  }
} // namespace Supple
