#include <supple/mesh/mesh_reader.h>

#include <supple/base/error.h>
#include <supple/mesh/mesh_format.h>
#include <supple/mesh/separate_process.h>
#include <supple/mesh/serial_mesh.h>

#include <deal.II/base/utilities.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gmsh.h>
#include <map>
#include <numeric>
#include <sstream>

namespace Supple
{
  namespace
  {
    constexpr int gmsh_line = 1, gmsh_triangle = 2, gmsh_tetrahedron = 4;

    /** Gmsh 4.13 loses a byte where binary VTK begins, and reads none of it; 4.8 does. */
    std::string
    remedy(const std::string &file)
    {
      std::ifstream stream(file);
      std::string version, title, kind;
      std::getline(stream, version);
      std::getline(stream, title);
      std::getline(stream, kind);
      const bool binary = version.rfind("# vtk", 0) == 0 && kind.rfind("BINARY", 0) == 0;
      return binary ? ". Not every version reads binary VTK: write it as text, or as .msh" : "";
    }


    /** Gmsh's library is a global thing: it is there while one of these lives. */
    class GmshSession
    {
    public:
      explicit GmshSession(const std::string &file)
      {
        gmsh::initialize(0, nullptr, false);
        gmsh::option::setNumber("General.Terminal", 0);
        gmsh::logger::start();
        try
          {
            gmsh::open(file);
          }
        catch (...)
          {
            const std::string reason = last_complaint();
            gmsh::finalize();
            throw InputError("Gmsh can't read it" + reason + remedy(file));
          }
      }

      ~GmshSession()
      {
        gmsh::finalize();
      }

      GmshSession(const GmshSession &) = delete;
      GmshSession &
      operator=(const GmshSession &) = delete;

      static std::string
      last_complaint()
      {
        std::vector<std::string> lines;
        gmsh::logger::get(lines);
        for (auto line = lines.rbegin(); line != lines.rend(); ++line)
          if (line->rfind("Error", 0) == 0)
            return " (" + *line + ")";
        return "";
      }
    };


    /** The model entities of each physical group of a dimension. */
    std::map<int, std::vector<int>>
    physical_groups(const int dimension)
    {
      std::map<int, std::vector<int>> groups;
      gmsh::vectorpair dimension_tags;
      gmsh::model::getPhysicalGroups(dimension_tags, dimension);
      for (const auto &[dim, tag] : dimension_tags)
        gmsh::model::getEntitiesForPhysicalGroup(dim, tag, groups[tag]);
      return groups;
    }


    /** Elements an ASCII .msh file of version 1 or 2 announces; Gmsh drops those whose number is
     * taken. */
    std::size_t
    announced_elements(const std::string &file)
    {
      std::ifstream stream(file);
      std::string line;
      while (std::getline(stream, line))
        {
          line = dealii::Utilities::trim(line);
          if (line == "$MeshFormat")
            {
              double version = 0.;
              int binary     = 0;
              stream >> version >> binary;
              if (version >= 3. || binary != 0)
                return 0;
            }
          if (line == "$Elements" || line == "$ELM")
            {
              std::size_t n = 0;
              stream >> n;
              return n;
            }
        }
      return 0;
    }


    std::size_t
    loaded_elements()
    {
      std::vector<int> types;
      gmsh::model::mesh::getElementTypes(types);
      std::size_t n = 0;
      for (const int type : types)
        {
          std::vector<std::size_t> tags, nodes;
          gmsh::model::mesh::getElementsByType(type, tags, nodes);
          n += tags.size();
        }
      return n;
    }


    /** The place of a node in the list of nodes.
     * @throws InputError if an element names a node that is not there */
    std::size_t
    position_of(const std::size_t node, const std::map<std::size_t, std::size_t> &position)
    {
      const auto found = position.find(node);
      if (found == position.end())
        throw InputError("an element has the node " + std::to_string(node) +
                         ", which is not in the file.");
      return found->second;
    }


    /** Vertices of all elements of a type on an entity, as positions in the list of nodes. */
    std::vector<std::size_t>
    elements(const int type, const int entity, const std::map<std::size_t, std::size_t> &position)
    {
      std::vector<std::size_t> element_tags, node_tags, positions;
      gmsh::model::mesh::getElementsByType(type, element_tags, node_tags, entity);
      for (const std::size_t tag : node_tags)
        positions.push_back(position_of(tag, position));
      return positions;
    }


    bool
    has_elements(const int type)
    {
      std::vector<int> types;
      gmsh::model::mesh::getElementTypes(types);
      return std::count(types.begin(), types.end(), type) > 0;
    }


    /** The order that makes numbers ascend: Gmsh gives nodes and elements entity by entity. */
    std::vector<std::size_t>
    ascending(const std::vector<std::size_t> &tags)
    {
      std::vector<std::size_t> order(tags.size());
      std::iota(order.begin(), order.end(), std::size_t(0));
      std::sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
        return tags[a] < tags[b];
      });
      return order;
    }


    /** Sets the vertices by the numbers of the nodes in the file.
     * @return the vertex of each number */
    std::map<std::size_t, std::size_t>
    read_vertices(SerialMesh &mesh)
    {
      std::vector<std::size_t> tags;
      std::vector<double> coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters);
      std::map<std::size_t, std::size_t> position;
      for (const std::size_t i : ascending(tags))
        if (position.emplace(tags[i], mesh.vertices.size()).second)
          mesh.vertices.emplace_back(coordinates[3 * i],
                                     coordinates[3 * i + 1],
                                     coordinates[3 * i + 2]);
      return position;
    }


    /** Tetrahedra, or triangles where there are none, by their numbers in the file. Those of a
     * physical group of their dimension get its number. */
    void
    read_cells(SerialMesh &mesh, const std::map<std::size_t, std::size_t> &position)
    {
      const int type = mesh.dimension == 3 ? gmsh_tetrahedron : gmsh_triangle;
      std::vector<std::size_t> tags, nodes;
      gmsh::model::mesh::getElementsByType(type, tags, nodes);
      std::map<std::size_t, unsigned int> material;
      for (const auto &[group, entities] : physical_groups(mesh.dimension))
        for (const int entity : entities)
          {
            std::vector<std::size_t> group_tags, group_nodes;
            gmsh::model::mesh::getElementsByType(type, group_tags, group_nodes, entity);
            for (const std::size_t tag : group_tags)
              material.emplace(tag, group);
          }
      const unsigned int n_nodes = mesh.dimension + 1;
      for (const std::size_t c : ascending(tags))
        {
          std::array<unsigned int, 4> cell;
          cell.fill(dealii::numbers::invalid_unsigned_int);
          for (unsigned int a = 0; a < n_nodes; ++a)
            cell[a] = position_of(nodes[n_nodes * c + a], position);
          mesh.cells.push_back(cell);
          const auto found = material.find(tags[c]);
          mesh.materials.push_back(found == material.end() ? 0 : found->second);
        }
    }


    void
    read_boundary(SerialMesh &mesh, const std::map<std::size_t, std::size_t> &position)
    {
      const int type             = mesh.dimension == 3 ? gmsh_triangle : gmsh_line;
      const unsigned int n_nodes = mesh.dimension;
      for (const auto &[group, entities] : physical_groups(mesh.dimension - 1))
        for (const int entity : entities)
          {
            const auto vertices = elements(type, entity, position);
            for (std::size_t first = 0; first < vertices.size(); first += n_nodes)
              {
                SerialMesh::BoundaryFace face;
                face.vertices.fill(dealii::numbers::invalid_unsigned_int);
                std::copy_n(vertices.begin() + first, n_nodes, face.vertices.begin());
                face.boundary_id = group;
                mesh.boundary.push_back(face);
              }
          }
    }


    /** Whether all vertices lie in the plane z = 0. */
    bool
    is_flat(const SerialMesh &mesh)
    {
      double size = 0., height = 0.;
      for (const auto &vertex : mesh.vertices)
        {
          size   = std::max({size, std::abs(vertex[0]), std::abs(vertex[1])});
          height = std::max(height, std::abs(vertex[2]));
        }
      return height <= 1e-9 * size;
    }


    /** Cells of another kind beside ours would be lost. */
    void
    refuse_other_cells(const SerialMesh &mesh)
    {
      std::vector<int> types;
      gmsh::model::mesh::getElementTypes(types, mesh.dimension);
      std::string others;
      for (const int type : types)
        if (type != gmsh_tetrahedron && type != gmsh_triangle)
          {
            std::string name;
            int dimension, order, n_nodes, n_primary_nodes;
            std::vector<double> local_coordinates;
            gmsh::model::mesh::getElementProperties(
              type, name, dimension, order, n_nodes, local_coordinates, n_primary_nodes);
            std::vector<std::size_t> tags, nodes;
            gmsh::model::mesh::getElementsByType(type, tags, nodes);
            others +=
              (others.empty() ? "" : ", ") + std::to_string(tags.size()) + " of the kind " + name;
          }
      if (!others.empty())
        throw InputError("it has cells that are not linear " +
                         std::string(mesh.dimension == 3 ? "tetrahedra" : "triangles") + ": " +
                         others +
                         ". Mesh the body with tetrahedra (in the plane: triangles) of order 1 "
                         "alone.");
    }


    void
    refuse_without_cells(const SerialMesh &mesh)
    {
      std::string text = "it has " + std::to_string(mesh.vertices.size()) +
                         " vertices but no tetrahedra" + GmshSession::last_complaint() + ".";
      if (has_elements(gmsh_triangle))
        text += " Triangles alone are a body only if all vertices lie in the plane z = 0.";
      throw InputError(text);
    }


    /** Gmsh drops elements whose number is taken. */
    void
    require_all_elements(const std::string &file)
    {
      const std::size_t announced = announced_elements(file), loaded = loaded_elements();
      if (loaded < announced)
        throw InputError("the file announces " + std::to_string(announced) +
                         " elements, of which only " + std::to_string(loaded) +
                         " can be read. Each element needs a number of its own; meshio convert "
                         "(package meshio-tools) numbers them anew.");
    }


    SerialMesh
    read_by_gmsh(const std::string &file)
    {
      const GmshSession session(file);

      require_all_elements(file);

      SerialMesh mesh;
      const auto position = read_vertices(mesh);
      if (!has_elements(gmsh_tetrahedron))
        {
          refuse_other_cells(mesh);
          mesh.dimension = 2;
          refuse_other_cells(mesh);
          if (!has_elements(gmsh_triangle) || !is_flat(mesh))
            refuse_without_cells(mesh);
          for (auto &vertex : mesh.vertices)
            vertex[2] = 0.;
        }
      else
        refuse_other_cells(mesh);
      read_cells(mesh, position);
      read_boundary(mesh, position);
      return mesh;
    }


    /** A good mesh is read at megabytes a second, and takes less than fifty times its size. */
    ProcessLimits
    limits_for(const std::string &file)
    {
      const std::size_t size         = std::filesystem::file_size(file);
      constexpr std::size_t megabyte = 1000000;
      return {static_cast<unsigned int>(30 + 10 * (size / megabyte)), 1000 * megabyte + 200 * size};
    }
  } // namespace


  SerialMesh
  read_mesh(const std::string &file, const std::string &origin)
  {
    try
      {
        require_readable_format(file);
        // Gmsh crashes on some damaged files.
        const std::string packed = in_separate_process(
          [&] {
            std::ostringstream stream;
            boost::archive::binary_oarchive(stream) << read_by_gmsh(file);
            return stream.str();
          },
          limits_for(file));
        std::istringstream stream(packed);
        SerialMesh mesh;
        boost::archive::binary_iarchive(stream) >> mesh;
        return mesh;
      }
    catch (const InputError &error)
      {
        throw InputError(origin + ": " + error.what());
      }
    catch (const SeparateProcessError &error)
      {
        throw InputError(origin +
                         ": the file is damaged, or no mesh: Gmsh's library fails on it (" +
                         error.what() + ").");
      }
  }
} // namespace Supple
