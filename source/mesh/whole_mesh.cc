#include <supple/mesh/whole_mesh.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>
#include <supple/mesh/edge_middles.h>
#include <supple/mesh/mesh_generators.h>
#include <supple/mesh/mesh_pieces.h>
#include <supple/mesh/mesh_reader.h>
#include <supple/mesh/refinement.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <utility>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** Boundary ids by expressions: those that the user gives are stronger.
     * @param places of the vertices, where the map puts them */
    void
    assign_boundary_regions(SerialMesh &mesh,
                            const std::vector<Point<3>> &places,
                            const std::string &regions,
                            const std::string &origin)
    {
      for (const std::string &item : Utilities::split_string_list(regions, ';'))
        {
          if (item.empty())
            continue;
          const auto colon = item.find(':');
          const std::string id =
            Utilities::trim(item.substr(0, colon == std::string::npos ? 0 : colon));
          if (id.empty() || id.size() > 6 ||
              id.find_first_not_of("0123456789") != std::string::npos)
            throw InputError(origin + ": '" + item + "' is not of the form id: expression.");
          const Expression inside(item.substr(colon + 1), 1, origin);

          unsigned int n_faces = 0;
          for (auto &face : mesh.boundary)
            {
              const auto vertices = mesh.face_vertices(face);
              if (std::all_of(vertices.begin(), vertices.end(), [&](const unsigned int v) {
                    return inside.value(places[v], 0.) != 0.;
                  }))
                {
                  face.boundary_id = std::stoul(id);
                  ++n_faces;
                }
            }
          if (n_faces == 0)
            throw InputError(origin + ": no face of the surface has all its vertices in '" +
                             item.substr(colon + 1) + "'. The body lies in " +
                             extent_in_words(box_around(mesh, places), mesh.dimension) + " m.");
        }
    }


    /** @throws InputError where the map gives no place, or leaves the plane of a plane body */
    Point<3>
    mapped(const Expression &map,
           const Point<3> &vertex,
           const bool plane,
           const std::string &origin)
    {
      const Point<3> place(map.value(vertex, 0., 0),
                           map.value(vertex, 0., 1),
                           map.value(vertex, 0., 2));
      const bool finite =
        std::isfinite(place[0]) && std::isfinite(place[1]) && std::isfinite(place[2]);
      if (finite && (!plane || place[2] == 0.))
        return place;
      std::ostringstream text;
      text << origin << ": the vertex at (" << vertex << ") is put at (" << place << "); "
           << (finite ? "a plane body stays in the plane z = 0."
                      : "there must be a place for each vertex.");
      throw InputError(text.str());
    }


    /** Puts the vertices where the user wants them. A map may turn all cells around, as a mirror
     * does, but not some: it folds the body then. */
    void
    apply_map(SerialMesh &mesh, const std::string &expressions, const std::string &origin)
    {
      const Expression map(expressions, 3, origin);
      if (map.depends_on_time())
        throw InputError(origin + ": the body at rest does not depend on t.");

      std::vector<bool> was_positive(mesh.cells.size());
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        was_positive[c] = mesh.volume(c) > 0.;
      for (Point<3> &vertex : mesh.vertices)
        vertex = mapped(map, vertex, mesh.dimension == 2, origin);
      for (SerialMesh::Middle &middle : mesh.middles)
        middle.place = mapped(map, middle.place, false, origin);

      std::size_t n_turned = 0;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        n_turned += (mesh.volume(c) > 0.) != was_positive[c];
      if (n_turned > 0 && n_turned < mesh.cells.size())
        throw InputError(origin + ": it turns " + std::to_string(n_turned) + " of " +
                         std::to_string(mesh.cells.size()) +
                         " cells inside out; it must not fold the body.");
    }


    SerialMesh
    read_file(const std::string &file, const double scale, const ParameterFile &scene)
    {
      const auto path = std::filesystem::path(scene.folder()) / file;
      SerialMesh mesh = read_mesh(path.string(), scene.origin("Mesh/File"));
      for (auto &vertex : mesh.vertices)
        vertex *= scale;
      for (auto &middle : mesh.middles)
        middle.place *= scale;
      return mesh;
    }


    SerialMesh
    generate(const MeshParameters &parameters)
    {
      switch (parameters.shape)
        {
          case MeshParameters::Shape::hollow_cylinder:
            return hollow_cylinder_mesh(parameters);
          case MeshParameters::Shape::rectangle:
            return rectangle_mesh(parameters);
          default:
            return box_mesh(parameters);
        }
    }


    /** Of each file, or the one that is generated. */
    std::vector<SerialMesh>
    generate_or_read(const MeshParameters &parameters, const ParameterFile &scene)
    {
      const auto whole_name = std::filesystem::path(scene.folder()) / parameters.file;
      std::error_code unknown; // such as that of a name that is too long
      std::vector<SerialMesh> meshes;
      if (parameters.shape != MeshParameters::Shape::file)
        meshes.push_back(generate(parameters));
      else if (std::filesystem::exists(whole_name, unknown)) // its name may have commas
        meshes.push_back(read_file(parameters.file, parameters.scale, scene));
      else
        for (const std::string &file : Utilities::split_string_list(parameters.file, ','))
          meshes.push_back(read_file(file, parameters.scale, scene));
      return meshes;
    }


    /** All pieces, each where its map puts it. */
    SerialMesh
    join_pieces(const MeshParameters &parameters, const ParameterFile &scene)
    {
      const std::string origin = scene.origin("Mesh/Piece maps");
      const std::vector<std::string> maps =
        Utilities::split_string_list(parameters.piece_maps, '|');
      std::vector<SerialMesh> meshes = generate_or_read(parameters, scene);
      const std::size_t n            = std::max(maps.size(), meshes.size());
      if (!parameters.piece_maps.empty() && Utilities::trim(parameters.piece_maps).back() == '|')
        throw InputError(origin + ": there is no map after the last |.");
      if (meshes.size() > 1 && !maps.empty() && maps.size() != meshes.size())
        throw InputError(origin + ": there are " + std::to_string(maps.size()) + " maps for " +
                         std::to_string(meshes.size()) +
                         " files; each file needs its own, set apart by |.");
      if (!maps.empty() && parameters.shape == MeshParameters::Shape::hollow_cylinder &&
          (parameters.order == 2 || parameters.refinement.wanted()))
        throw InputError(origin +
                         ": the walls of a hollow cylinder are round about the z axis, "
                         "where finer and quadratic cells put new nodes. Take Mesh/Order = "
                         "1 without Mesh/Refine.");
      if (maps.empty() && meshes.size() == 1)
        return std::move(meshes[0]);
      SerialMesh whole;
      for (std::size_t k = 0; k < n; ++k)
        {
          SerialMesh piece = meshes[meshes.size() > 1 ? k : 0];
          if (!maps.empty())
            apply_map(piece, maps[k], origin);
          add_piece(whole, piece, scene.origin("Mesh/File"));
        }
      return whole;
    }


    /** Adds those warnings that are not there. */
    void
    add_new(const std::vector<std::string> &warnings, std::vector<std::string> &list)
    {
      for (const std::string &text : warnings)
        if (std::find(list.begin(), list.end(), text) == list.end())
          list.push_back(text);
    }


    /** Where the generator puts the middle of an edge. */
    Bisection::Middle
    middle_by_shape(const MeshParameters::Shape shape)
    {
      return shape == MeshParameters::Shape::hollow_cylinder ? middle_around_axis : middle_of_edge;
    }


    /** Gives the mesh the nodes of its order. */
    void
    set_order(SerialMesh &mesh, const MeshParameters &parameters, const ParameterFile &scene)
    {
      if (parameters.order == 1)
        {
          if (!mesh.middles.empty())
            mesh.warnings.push_back(
              "The nodes in the middles of the edges of the file are left out "
              "(Mesh/Order = 1).");
          mesh.middles.clear();
          return;
        }
      if (mesh.dimension == 2)
        throw InputError(scene.origin("Mesh/Order") +
                         ": 2 is for tetrahedra; this body has triangles, whose order is 1.");
      if (parameters.refinement.wanted() && !mesh.middles.empty())
        throw InputError(
          scene.origin(parameters.refinement.region.empty() ? "Mesh/File" : "Mesh/Refine region") +
          ": the file has nodes in the middles of edges, which may lie on curved "
          "walls; where an edge is cut, nothing says where the wall is. Refine it in "
          "the program that made it, or leave its cells as they are (Mesh/Refine, Space/Aim, "
          "Space/Second mesh = finer).");
      if (mesh.middles.empty())
        add_middles(mesh, middle_by_shape(parameters.shape));
    }


    /** Refines what the generator or the file has given, as its shape and the map want it.
     * @return the check of the mesh before that */
    MeshReport
    refine(SerialMesh &mesh,
           const MeshParameters &parameters,
           const ParameterFile &scene,
           const std::string &source)
    {
      const MeshReport before = check_mesh(mesh, source);
      BodyShape shape;
      shape.middle = middle_by_shape(parameters.shape);
      shape.places = [&](const SerialMesh &of) {
        SerialMesh copy = of;
        if (!parameters.map.empty())
          apply_map(copy, parameters.map, scene.origin("Mesh/Map"));
        return copy.vertices;
      };
      shape.name_boundaries = [&](SerialMesh &of) {
        assign_boundary_regions(of,
                                shape.places(of),
                                parameters.boundary_regions,
                                scene.origin("Mesh/Boundary regions"));
      };
      Supple::refine(mesh, parameters.refinement, shape, scene);
      return before;
    }
  } // namespace


  BoundingBox<3>
  box_around(const SerialMesh &mesh, const std::vector<Point<3>> &places)
  {
    Point<3> low = places[mesh.cells[0][0]], high = low;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (const unsigned int v : mesh.cell_vertices(c))
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = std::min(low[d], places[v][d]);
            high[d] = std::max(high[d], places[v][d]);
          }
    return BoundingBox<3>({low, high});
  }


  WholeMesh
  whole_mesh(const MeshParameters &parameters,
             const PlaneParameters &plane,
             const ParameterFile &scene)
  {
    const bool from_file     = parameters.shape == MeshParameters::Shape::file;
    const std::string source = scene.origin(from_file ? "Mesh/File" : "Mesh/Shape");
    SerialMesh mesh          = join_pieces(parameters, scene);
    MeshReport before;
    set_order(mesh, parameters, scene);
    if (parameters.refinement.wanted())
      {
        mesh.middles.clear();
        before = refine(mesh, parameters, scene, source);
        set_order(mesh, parameters, scene);
      }
    if (!parameters.map.empty())
      apply_map(mesh, parameters.map, scene.origin("Mesh/Map"));
    MeshReport report = check_mesh(mesh, source);
    find_parts_of_middles(mesh);
    check_middles(mesh, source);
    report.repaired += before.repaired;
    add_new(before.warnings, report.warnings);
    if (mesh.dimension == 2 && plane.section.axisymmetric())
      fit_to_axis(mesh, scene.origin(from_file ? "Mesh/File" : "Mesh/Rectangle origin"));
    if (!parameters.refinement.wanted())
      assign_boundary_regions(mesh,
                              mesh.vertices,
                              parameters.boundary_regions,
                              scene.origin("Mesh/Boundary regions"));
    return {std::move(mesh), std::move(report)};
  }
} // namespace Supple
