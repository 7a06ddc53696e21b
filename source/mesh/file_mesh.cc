#include <supple/mesh/file_mesh.h>

#include <supple/base/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <sstream>
#include <stdexcept>

namespace Supple
{
  namespace
  {
    using Element = FileMesh::Element;

    /** The numbers of nodes in the middles of edges. */
    std::set<std::size_t>
    middles_of(const FileMesh &file)
    {
      std::set<std::size_t> numbers;
      for (const auto &[ends, number] : file.middles)
        numbers.insert(number);
      return numbers;
    }


    /** The places of vertices in the list of vertices, by their numbers in the file. */
    class Positions
    {
    public:
      Positions(const FileMesh &file, const std::set<std::size_t> &middles)
      {
        for (const auto &[number, place] : file.vertices)
          if (middles.count(number) == 0)
            numbers.push_back(number);
      }

      /** @throws InputError if an element names a vertex that is not there */
      unsigned int
      operator()(const std::size_t number) const
      {
        const auto found = std::lower_bound(numbers.begin(), numbers.end(), number);
        if (found == numbers.end() || *found != number)
          throw InputError("an element has the node " + std::to_string(number) +
                           ", which is not in the file, or is the middle of an edge too.");
        return found - numbers.begin();
      }

    private:
      std::vector<std::size_t> numbers;
    };


    /** Whether all vertices lie in the plane z = 0. */
    bool
    is_flat(const FileMesh &file)
    {
      double size = 0., height = 0.;
      for (const auto &[number, vertex] : file.vertices)
        {
          size   = std::max({size, std::abs(vertex[0]), std::abs(vertex[1])});
          height = std::max(height, std::abs(vertex[2]));
        }
      return height <= 1e-9 * size;
    }


    std::string
    in_words(const std::map<std::string, std::size_t> &kinds)
    {
      std::string text;
      for (const auto &[kind, n] : kinds)
        text += (text.empty() ? "" : ", ") + std::to_string(n) + " of the kind " + kind;
      return text;
    }


    /** Cells of another kind beside ours would be lost. */
    void
    refuse_other_cells(const FileMesh &file, const unsigned int dimension)
    {
      if (!file.others[dimension].empty())
        throw InputError("it has cells that are not linear " +
                         std::string(dimension == 3 ? "or quadratic tetrahedra" : "triangles") +
                         ": " + in_words(file.others[dimension]) +
                         ". Mesh the body with tetrahedra of order 1 or 2 alone, in the plane with "
                         "triangles of order 1.");
    }


    /** @throws InputError if there is no body */
    unsigned int
    dimension_of(const FileMesh &file)
    {
      refuse_other_cells(file, 3);
      if (!file.elements[3].empty())
        return 3;
      if (file.n_quadratic_triangles > 0)
        throw InputError("it has no tetrahedra, and " + std::to_string(file.n_quadratic_triangles) +
                         " of the kind Triangle 6. Mesh a body in the plane with triangles of "
                         "order 1.");
      refuse_other_cells(file, 2);
      if (!file.elements[2].empty() && is_flat(file))
        return 2;
      std::string text = "it has " + std::to_string(file.vertices.size()) +
                         (file.vertices.size() == 1 ? " vertex" : " vertices") +
                         " but no tetrahedra.";
      if (!file.elements[2].empty())
        text += " Triangles alone are a body only if all vertices lie in the plane z = 0.";
      for (const std::string &warning : file.warnings)
        text += " " + warning;
      throw InputError(text);
    }


    std::array<std::size_t, 4>
    sorted_vertices(const Element &element, const unsigned int dimension)
    {
      std::array<std::size_t, 4> sorted = element.vertices;
      std::fill(sorted.begin() + dimension + 1, sorted.end(), 0);
      std::sort(sorted.begin(), sorted.end());
      return sorted;
    }


    /** Where a format has one id for each element, one that is in two groups is there twice. Those
     * become one; what is given twice with the same id stays, to be refused. */
    std::vector<Element>
    joined(const std::vector<Element> &elements, const unsigned int dimension)
    {
      std::vector<std::size_t> order(elements.size());
      std::iota(order.begin(), order.end(), std::size_t(0));
      std::vector<std::array<std::size_t, 4>> keys;
      for (const Element &element : elements)
        keys.push_back(sorted_vertices(element, dimension));
      std::stable_sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
        return keys[a] < keys[b];
      });

      std::vector<Element> result = elements;
      std::vector<bool> drop(elements.size());
      for (std::size_t first = 0, end = 0; first < order.size(); first = end)
        {
          std::set<unsigned int> ids;
          for (; end < order.size() && keys[order[end]] == keys[order[first]]; ++end)
            ids.insert(elements[order[end]].ids.begin(), elements[order[end]].ids.end());
          if (end - first == 1 || ids.size() < end - first)
            continue;
          result[order[first]].ids.assign(ids.begin(), ids.end());
          for (std::size_t i = first + 1; i < end; ++i)
            drop[order[i]] = true;
        }
      std::vector<Element> kept;
      for (std::size_t i = 0; i < result.size(); ++i)
        if (!drop[i])
          kept.push_back(std::move(result[i]));
      std::stable_sort(kept.begin(), kept.end(), [](const Element &a, const Element &b) {
        return a.number < b.number;
      });
      return kept;
    }


    void
    add_cells(SerialMesh &mesh, const FileMesh &file, const Positions &position)
    {
      std::size_t n_twice = 0;
      for (const Element &element : joined(file.elements[mesh.dimension], mesh.dimension))
        {
          std::array<unsigned int, 4> cell;
          cell.fill(dealii::numbers::invalid_unsigned_int);
          for (unsigned int a = 0; a <= mesh.dimension; ++a)
            cell[a] = position(element.vertices[a]);
          mesh.cells.push_back(cell);
          const auto &ids = element.ids;
          mesh.materials.push_back(ids.empty() ? 0 : *std::min_element(ids.begin(), ids.end()));
          n_twice += ids.size() > 1;
        }
      if (n_twice > 0)
        mesh.warnings.push_back(std::to_string(n_twice) +
                                " cell(s) belong to several groups; the least id counts.");
    }


    /** Where the edges of all cells have a node in the middle, or none has. */
    void
    add_middles(SerialMesh &mesh, const FileMesh &file, const Positions &position)
    {
      if (file.middles.empty())
        return;
      for (const auto &[ends, number] : file.middles)
        {
          const auto place = file.vertices.find(number);
          if (place == file.vertices.end())
            throw InputError("an element has the node " + std::to_string(number) +
                             ", which is not in the file.");
          if (!std::isfinite(place->second.norm()))
            throw InputError("a coordinate of the node " + std::to_string(number) +
                             " is not a finite number, or too large.");
          std::array<unsigned int, 2> of_mesh = {{position(ends[0]), position(ends[1])}};
          std::sort(of_mesh.begin(), of_mesh.end());
          mesh.middles.push_back({of_mesh, place->second});
        }
      std::sort(mesh.middles.begin(), mesh.middles.end(), [](const auto &a, const auto &b) {
        return a.ends < b.ends;
      });
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (const auto &[a, b] : tetrahedron_edges)
          try
            {
              mesh.middle(mesh.cells[c][a], mesh.cells[c][b]);
            }
          catch (const std::out_of_range &)
            {
              throw InputError(
                "it has both linear and quadratic tetrahedra; the first linear one is "
                "cell " +
                std::to_string(c) + ". Mesh the body with one order alone.");
            }
    }


    void
    add_boundary(SerialMesh &mesh, const FileMesh &file, const Positions &position)
    {
      for (const Element &element : file.elements[mesh.dimension - 1])
        for (const unsigned int id : element.ids)
          {
            SerialMesh::BoundaryFace face;
            face.vertices.fill(dealii::numbers::invalid_unsigned_int);
            for (unsigned int a = 0; a < mesh.dimension; ++a)
              face.vertices[a] = position(element.vertices[a]);
            face.boundary_id = id;
            mesh.boundary.push_back(face);
          }
      std::stable_sort(mesh.boundary.begin(),
                       mesh.boundary.end(),
                       [](const SerialMesh::BoundaryFace &a, const SerialMesh::BoundaryFace &b) {
                         return a.boundary_id < b.boundary_id;
                       });
      const auto &others = file.others[mesh.dimension - 1];
      if (!others.empty())
        mesh.warnings.push_back("Elements of the surface that are not read: " + in_words(others) +
                                ".");
    }


    bool
    is_number(const std::string &name)
    {
      const std::string digits = name.substr(name.rfind("+", 0) == 0);
      return !digits.empty() && digits.find_first_not_of("0123456789") == std::string::npos;
    }


    /** Those that stand for one id. A number is an id, whatever else has it as its name. */
    std::map<std::string, unsigned int>
    unique_names(SerialMesh &mesh, const std::map<std::string, std::set<unsigned int>> &names)
    {
      std::map<std::string, unsigned int> unique;
      for (const auto &[name, ids] : names)
        if (name.find_first_of("#,;:") != std::string::npos)
          mesh.warnings.push_back("The group " + name +
                                  " has a #, comma, semicolon or colon in its name, which mean "
                                  "something else in a parameter file; give its id.");
        else if (is_number(name))
          {
            if (ids.size() > 1 || name != std::to_string(*ids.begin()))
              mesh.warnings.push_back("A group with the id " + std::to_string(*ids.begin()) +
                                      " has the name " + name +
                                      ": in a parameter file a number is an id, not a name; give "
                                      "the id of the group.");
          }
        else if (ids.size() == 1)
          unique.emplace(name, *ids.begin());
        else
          mesh.warnings.push_back("Several groups have the name " + name +
                                  "; only their ids tell them apart.");
      return unique;
    }
  } // namespace


  void
  add_quadratic(FileMesh &mesh,
                FileMesh::Element element,
                const std::vector<std::size_t> &nodes,
                const NodeOrder order)
  {
    // For each place of VTK's order that of the format.
    using Places                      = std::array<unsigned int, 10>;
    constexpr Places vtk              = {{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}};
    constexpr Places gmsh             = {{0, 1, 2, 3, 4, 5, 6, 7, 9, 8}};
    constexpr Places ideas            = {{0, 2, 4, 9, 1, 3, 5, 6, 7, 8}};
    constexpr unsigned int ends[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
    const bool solid                  = nodes.size() == 10;
    for (unsigned int a = 0; a < (solid ? 4 : 3); ++a)
      element.vertices[a] = nodes[order == NodeOrder::universal ? ideas[a] : a];
    mesh.elements[solid ? 3 : 2].push_back(element);
    mesh.n_quadratic_triangles += !solid;
    if (!solid)
      return;
    const Places &places = order == NodeOrder::vtk ? vtk : order == NodeOrder::gmsh ? gmsh : ideas;
    for (unsigned int e = 0; e < 6; ++e)
      {
        std::array<std::size_t, 2> edge = {
          {element.vertices[ends[e][0]], element.vertices[ends[e][1]]}};
        std::sort(edge.begin(), edge.end());
        const std::size_t node     = nodes[places[4 + e]];
        const auto [found, is_new] = mesh.middles.emplace(edge, node);
        if (!is_new && found->second != node)
          throw InputError("the edge between the nodes " + std::to_string(edge[0]) + " and " +
                           std::to_string(edge[1]) + " has two nodes in its middle, " +
                           std::to_string(found->second) + " and " + std::to_string(node) + ".");
      }
  }


  std::size_t
  announced(const std::string &word, const std::string &of)
  {
    if (word.empty() || word.size() > 12 ||
        word.find_first_not_of("0123456789") != std::string::npos)
      throw InputError("there should be the number of " + of + ", not '" + word + "'.");
    return std::stoul(word);
  }


  unsigned int
  id_of(const double number)
  {
    if (!(number >= 0. && number <= std::numeric_limits<int>::max() &&
          number == std::floor(number)))
      {
        std::ostringstream message;
        message.precision(12);
        message << number << " can't be an id: an id is a whole number, "
                << std::numeric_limits<int>::max() << " at most.";
        throw InputError(message.str());
      }
    return number;
  }


  SerialMesh
  body_of(const FileMesh &file)
  {
    SerialMesh mesh;
    mesh.dimension                      = dimension_of(file);
    mesh.warnings                       = file.warnings;
    const std::set<std::size_t> middles = middles_of(file);
    for (const auto &[number, vertex] : file.vertices)
      if (middles.count(number) == 0)
        mesh.vertices.emplace_back(vertex[0], vertex[1], mesh.dimension == 2 ? 0. : vertex[2]);
    const Positions position(file, middles);
    add_cells(mesh, file, position);
    add_middles(mesh, file, position);
    add_boundary(mesh, file, position);
    mesh.material_names = unique_names(mesh, file.names[mesh.dimension]);
    mesh.boundary_names = unique_names(mesh, file.names[mesh.dimension - 1]);
    return mesh;
  }
} // namespace Supple
