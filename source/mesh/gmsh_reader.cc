#include <supple/mesh/gmsh_reader.h>

#include <supple/base/error.h>
#include <supple/mesh/msh_blocks.h>

#include <algorithm>
#include <cstdlib>
#include <gmsh.h>
#include <set>
#include <sstream>

namespace Supple
{
  namespace
  {
    constexpr int gmsh_point = 15, gmsh_triangle_6 = 9, gmsh_tetrahedron_10 = 11;

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
            throw InputError("Gmsh can't read it" + reason);
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


    void
    read_vertices(FileMesh &mesh)
    {
      std::vector<std::size_t> tags;
      std::vector<double> coordinates, parameters;
      gmsh::model::mesh::getNodes(tags, coordinates, parameters);
      for (std::size_t i = 0; i < tags.size(); ++i)
        mesh.vertices.emplace(tags[i],
                              dealii::Point<3>(coordinates[3 * i],
                                               coordinates[3 * i + 1],
                                               coordinates[3 * i + 2]));
    }


    /** The ids of the groups of an entity, ascending. */
    std::vector<unsigned int>
    groups_of(const int dimension, const int entity)
    {
      std::vector<int> tags;
      gmsh::model::getPhysicalGroupsForEntity(dimension, entity, tags);
      std::vector<unsigned int> ids;
      for (const int tag : tags)
        ids.push_back(std::abs(tag));
      std::sort(ids.begin(), ids.end());
      ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
      return ids;
    }


    /** Those of one type on one entity. */
    void
    add_elements(FileMesh &mesh,
                 const int type,
                 const std::vector<std::size_t> &tags,
                 const std::vector<std::size_t> &nodes,
                 const std::vector<unsigned int> &groups)
    {
      std::string name;
      int dimension, order, n_nodes, n_primary_nodes;
      std::vector<double> local_coordinates;
      gmsh::model::mesh::getElementProperties(
        type, name, dimension, order, n_nodes, local_coordinates, n_primary_nodes);
      if (type == gmsh_triangle_6 || type == gmsh_tetrahedron_10)
        {
          for (std::size_t e = 0; e < tags.size(); ++e)
            add_quadratic(mesh,
                          {tags[e], {}, groups},
                          {nodes.begin() + n_nodes * e, nodes.begin() + n_nodes * (e + 1)},
                          NodeOrder::gmsh);
          return;
        }
      if (order != 1 || n_nodes != dimension + 1)
        {
          mesh.others[dimension][name] += tags.size();
          return;
        }
      for (std::size_t e = 0; e < tags.size(); ++e)
        {
          FileMesh::Element element{tags[e], {}, groups};
          std::copy_n(nodes.begin() + n_nodes * e, n_nodes, element.vertices.begin());
          mesh.elements[dimension].push_back(std::move(element));
        }
    }


    /** Of a mesh that was cut into parts, the parts that are named, and those that have cells. */
    class Parts
    {
    public:
      void
      add(const int dimension, const int entity, const bool has_elements)
      {
        std::vector<int> parts;
        gmsh::model::getPartitions(dimension, entity, parts);
        named.insert(parts.begin(), parts.end());
        if (has_elements && dimension > of_cells)
          {
            of_cells = dimension;
            with_cells.clear();
          }
        if (has_elements && dimension == of_cells)
          with_cells.insert(parts.begin(), parts.end());
      }

      /** A file may hold one of several parts. */
      void
      require_all() const
      {
        if (with_cells.size() < named.size())
          throw InputError("it holds " + std::to_string(with_cells.size()) + " of " +
                           std::to_string(named.size()) +
                           " parts of a mesh. Save all parts in one file (in Gmsh: "
                           "Mesh.PartitionSplitMeshFiles = 0).");
      }

    private:
      int of_cells = 0; ///< their dimension
      std::set<int> named, with_cells;
    };


    /** Of each entity by itself: elements of several entities may have the same number, and those
     * of another part of a partitioned mesh that are next to one (ghosts) are given twice. */
    void
    read_elements(FileMesh &mesh, const std::size_t n_in_file)
    {
      std::size_t n_loaded = 0;
      Parts parts;
      gmsh::vectorpair entities;
      gmsh::model::getEntities(entities);
      for (const auto &[dimension, entity] : entities)
        {
          std::string kind;
          gmsh::model::getType(dimension, entity, kind);
          if (kind.rfind("Ghost", 0) == 0)
            {
              parts.add(dimension, entity, false);
              continue;
            }
          std::vector<int> types;
          std::vector<std::vector<std::size_t>> tags, nodes;
          gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
          parts.add(dimension, entity, !types.empty());
          const auto groups = groups_of(dimension, entity);
          for (std::size_t t = 0; t < types.size(); ++t)
            {
              n_loaded += tags[t].size();
              if (types[t] != gmsh_point)
                add_elements(mesh, types[t], tags[t], nodes[t], groups);
            }
        }
      parts.require_all();
      // Gmsh drops elements whose number is taken.
      if (n_loaded < n_in_file)
        throw InputError("the file has " + std::to_string(n_in_file) + " elements, of which only " +
                         std::to_string(n_loaded) +
                         " can be read. Each element needs a number of its own; meshio convert "
                         "(package meshio-tools) numbers them anew.");
    }


    void
    read_names(FileMesh &mesh)
    {
      gmsh::vectorpair groups;
      gmsh::model::getPhysicalGroups(groups);
      for (const auto &[dimension, id] : groups)
        {
          std::string name;
          gmsh::model::getPhysicalName(dimension, id, name);
          if (!name.empty())
            mesh.names[dimension][name].insert(std::abs(id));
        }
    }
  } // namespace


  FileMesh
  read_gmsh(const std::string &file)
  {
    const MshFormat format = msh_format_of(file);
    if (format.version < 3.)
      return read_msh(file);
    if (format.version < 4. || format.version >= 5.)
      {
        std::ostringstream message;
        message << "it is of version " << format.version
                << " of the format; versions 1, 2 and 4 are read. Save it anew, in Gmsh with "
                   "Mesh.MshFileVersion = 4.1.";
        throw InputError(message.str());
      }
    const std::size_t n_elements = check_msh_blocks(file, format);
    const GmshSession session(file);
    FileMesh mesh;
    read_vertices(mesh);
    read_elements(mesh, n_elements);
    read_names(mesh);
    const std::string complaint = GmshSession::last_complaint();
    if (!complaint.empty())
      mesh.warnings.push_back("Gmsh's library says of the file" + complaint + ".");
    return mesh;
  }
} // namespace Supple
