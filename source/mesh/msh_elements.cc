#include <supple/mesh/msh_elements.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gmsh.h>
#include <map>
#include <sstream>

namespace Supple
{
  namespace
  {
    /** Nodes of the linear types that count: edge, triangle, tetrahedron; 0 for others. */
    unsigned int
    n_simplex_nodes(const long type)
    {
      return type == 1 ? 2 : type == 2 ? 3 : type == 4 ? 4 : 0;
    }


    void
    add(MshElements &elements, const std::vector<std::size_t> &nodes, const long group)
    {
      std::array<std::size_t, 4> key{};
      std::copy(nodes.begin(), nodes.end(), key.begin());
      std::sort(key.begin(), key.end());
      // A negative group means that the element is turned around.
      elements.groups.emplace_back(key, static_cast<unsigned int>(std::labs(group)));
    }


    /** number, type, group, elementary number, number of nodes, nodes in version 1; number, type,
     * number of tags, tags, nodes in version 2, where the first tag is the group. */
    void
    read_line(MshElements &elements, const std::string &line, const double version)
    {
      std::istringstream words(line);
      long number = 0, type = 0, group = 0, other = 0, n_nodes = 0, n_tags = 0;
      words >> number >> type;
      if (version < 2.)
        words >> group >> other >> n_nodes;
      else
        {
          words >> n_tags;
          for (long tag = 0; tag < n_tags && words; ++tag)
            words >> (tag == 0 ? group : other);
        }
      std::vector<std::size_t> nodes(n_simplex_nodes(type));
      for (std::size_t &node : nodes)
        words >> node;
      if (words && !nodes.empty())
        add(elements, nodes, group);
    }


    unsigned int
    n_nodes_of(const int type, std::map<int, unsigned int> &known)
    {
      const auto [found, is_new] = known.emplace(type, 0);
      if (is_new)
        {
          std::string name;
          int dimension, order, n_nodes = 0, n_primary_nodes;
          std::vector<double> local_coordinates;
          gmsh::model::mesh::getElementProperties(
            type, name, dimension, order, n_nodes, local_coordinates, n_primary_nodes);
          found->second = n_nodes;
        }
      return found->second;
    }


    int
    read_int(std::istream &stream, const bool swapped)
    {
      std::array<char, 4> bytes{};
      stream.read(bytes.data(), bytes.size());
      if (swapped)
        std::reverse(bytes.begin(), bytes.end());
      int value = 0;
      std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char *>(&value));
      return value;
    }


    /** Blocks of type, number of elements, number of tags, and for each element its number, tags
     * and nodes. */
    void
    read_binary(MshElements &elements, std::istream &stream, const bool swapped)
    {
      std::map<int, unsigned int> n_nodes;
      for (std::size_t done = 0; done < elements.n_announced && stream;)
        {
          const int type = read_int(stream, swapped), n = read_int(stream, swapped),
                    n_tags = read_int(stream, swapped);
          if (!stream || n <= 0)
            return;
          for (int e = 0; e < n && stream; ++e, ++done)
            {
              read_int(stream, swapped);
              long group = 0;
              for (int tag = 0; tag < n_tags && stream; ++tag)
                {
                  const int value = read_int(stream, swapped);
                  group           = tag == 0 ? value : group;
                }
              std::vector<std::size_t> nodes;
              for (unsigned int v = 0; v < n_nodes_of(type, n_nodes) && stream; ++v)
                nodes.push_back(read_int(stream, swapped));
              if (stream && n_simplex_nodes(type) > 0)
                add(elements, nodes, group);
            }
        }
    }


    /** The kind of file that a line after $MeshFormat tells of. */
    struct Format
    {
      double version = 1.;
      bool binary    = false;
      bool swapped   = false;
    };


    Format
    read_format(std::istream &stream)
    {
      Format format;
      std::string line;
      std::getline(stream, line);
      std::istringstream(line) >> format.version >> format.binary;
      if (format.binary)
        format.swapped = read_int(stream, false) != 1;
      return format;
    }


    void
    read_elements(MshElements &elements, std::istream &stream, const Format &format)
    {
      std::string line;
      if (format.version >= 3.)
        {
          std::size_t n_blocks = 0;
          if (!format.binary)
            stream >> n_blocks >> elements.n_announced;
          return;
        }
      std::getline(stream, line);
      std::istringstream(line) >> elements.n_announced;
      if (format.binary)
        read_binary(elements, stream, format.swapped);
      else
        while (std::getline(stream, line) && line.rfind("$", 0) != 0)
          read_line(elements, line, format.version);
      std::sort(elements.groups.begin(), elements.groups.end());
    }
  } // namespace


  bool
  MshElements::find(std::array<std::size_t, 4> nodes, std::vector<unsigned int> &ids) const
  {
    std::sort(nodes.begin(), nodes.end());
    const auto first = std::lower_bound(groups.begin(), groups.end(), std::make_pair(nodes, 0u));
    if (first == groups.end() || first->first != nodes)
      return false;
    ids.clear();
    for (auto group = first; group != groups.end() && group->first == nodes; ++group)
      if (group->second != 0 && (ids.empty() || ids.back() != group->second))
        ids.push_back(group->second);
    return true;
  }


  MshElements
  read_msh_elements(const std::string &file)
  {
    std::ifstream stream(file, std::ios::binary);
    MshElements elements;
    Format format;
    for (std::string line; std::getline(stream, line);)
      {
        line = dealii::Utilities::trim(line);
        if (line == "$MeshFormat")
          format = read_format(stream);
        if (line == "$Elements" || line == "$ELM")
          {
            read_elements(elements, stream, format);
            break;
          }
      }
    return elements;
  }
} // namespace Supple
