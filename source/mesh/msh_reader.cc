#include <supple/mesh/msh_reader.h>

#include <supple/base/error.h>
#include <supple/base/files.h>
#include <supple/base/packed_number.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace Supple
{
  namespace
  {
    /** What the number of a kind of element stands for. */
    struct Kind
    {
      unsigned int dimension;
      unsigned int n_nodes;
      std::string other; ///< its name if it is none of our elements
    };

    constexpr long triangle_6 = 9, tetrahedron_10 = 11;

    const std::map<long, Kind> kinds = {{1, {1, 2, ""}},
                                        {2, {2, 3, ""}},
                                        {3, {2, 4, "Quadrilateral 4"}},
                                        {4, {3, 4, ""}},
                                        {5, {3, 8, "Hexahedron 8"}},
                                        {6, {3, 6, "Prism 6"}},
                                        {7, {3, 5, "Pyramid 5"}},
                                        {8, {1, 3, "Line 3"}},
                                        {9, {2, 6, "Triangle 6"}},
                                        {10, {2, 9, "Quadrilateral 9"}},
                                        {11, {3, 10, "Tetrahedron 10"}},
                                        {12, {3, 27, "Hexahedron 27"}},
                                        {13, {3, 18, "Prism 18"}},
                                        {14, {3, 14, "Pyramid 14"}},
                                        {15, {0, 1, "Point"}},
                                        {16, {2, 8, "Quadrilateral 8"}},
                                        {17, {3, 20, "Hexahedron 20"}},
                                        {18, {3, 15, "Prism 15"}},
                                        {19, {3, 13, "Pyramid 13"}},
                                        {20, {2, 9, "Triangle 9"}},
                                        {21, {2, 10, "Triangle 10"}},
                                        {22, {2, 12, "Triangle 12"}},
                                        {23, {2, 15, "Triangle 15"}},
                                        {24, {2, 15, "Triangle 15"}},
                                        {25, {2, 21, "Triangle 21"}},
                                        {26, {1, 4, "Line 4"}},
                                        {27, {1, 5, "Line 5"}},
                                        {28, {1, 6, "Line 6"}},
                                        {29, {3, 20, "Tetrahedron 20"}},
                                        {30, {3, 35, "Tetrahedron 35"}},
                                        {31, {3, 56, "Tetrahedron 56"}},
                                        {36, {2, 16, "Quadrilateral 16"}},
                                        {92, {3, 64, "Hexahedron 64"}},
                                        {93, {3, 125, "Hexahedron 125"}}};


    class MshReader
    {
    public:
      FileMesh mesh;

      MshReader(const std::string &file, const MshFormat &format)
        : format(format)
        , text(content_of(file))
      {
        while (position < text.size())
          if (const std::string head = line(); head.rfind("$", 0) == 0)
            read_section(head);
        if (!has_elements)
          throw InputError("the section $Elements is missing.");
      }

    private:
      const MshFormat format;
      const std::string text;
      std::size_t position = 0;
      bool has_elements    = false;

      std::string
      line()
      {
        const auto end      = std::min(text.find('\n', position), text.size());
        std::string content = text.substr(position, end - position);
        position            = std::min(end + 1, text.size());
        return dealii::Utilities::trim(content);
      }

      void
      read_section(const std::string &head)
      {
        if (head == "$Nodes" || head == "$NOD" || head == "$ParametricNodes")
          read_nodes();
        else if (head == "$Elements" || head == "$ELM")
          read_elements();
        else if (head == "$PhysicalNames")
          read_names();
        else if (head.rfind("$End", 0) != 0 && head.rfind("$END", 0) != 0)
          {
            position = std::min(text.find("$End" + head.substr(1), position), text.size());
            line();
          }
      }

      /** How many items a section has. */
      std::size_t
      count(const std::string &of)
      {
        return announced(line(), of);
      }

      /** The numbers of the next line that is not empty; none at the end of a section. */
      std::vector<double>
      numbers()
      {
        std::string content;
        while (content.empty() && position < text.size())
          content = line();
        std::vector<double> values;
        if (content.rfind("$", 0) == 0)
          return values;
        for (const char *from = content.c_str(); *from != '\0';)
          {
            char *end = nullptr;
            values.push_back(std::strtod(from, &end));
            if (end == from || !std::isfinite(values.back()))
              throw InputError("in the line '" + content.substr(0, 60) +
                               "' there are not only numbers.");
            from = end + std::strspn(end, " \t");
          }
        return values;
      }

      template <class Number>
      Number
      packed()
      {
        if (text.size() - position < sizeof(Number))
          throw InputError("the file ends before all that it announces is there.");
        position += sizeof(Number);
        return packed_number<Number>(&text[position - sizeof(Number)], format.swapped);
      }

      static std::size_t
      whole(const double value)
      {
        if (!(value >= 0. && value <= 1e15 && value == std::floor(value)))
          {
            std::ostringstream message;
            message << value << " is not the number of a node.";
            throw InputError(message.str());
          }
        return value;
      }

      [[noreturn]] static void
      refuse_count(const std::string &of, const std::size_t announced, const std::string &found)
      {
        throw InputError("the file announces " + std::to_string(announced) + " " + of +
                         ", but has " + found + ".");
      }

      /** Refuses what follows a list that is read to its end. */
      void
      require_end(const std::string &of, const std::size_t announced)
      {
        while (position < text.size() && std::isspace(static_cast<unsigned char>(text[position])))
          ++position;
        if (position < text.size() && text[position] != '$')
          refuse_count(of, announced, "more");
      }

      void
      read_nodes()
      {
        const std::size_t n = count("nodes");
        for (std::size_t i = 0; i < n; ++i)
          {
            std::vector<double> row;
            if (format.binary)
              {
                row.push_back(packed<std::int32_t>());
                for (unsigned int d = 0; d < 3; ++d)
                  row.push_back(packed<double>());
              }
            else
              row = numbers();
            if (row.empty())
              refuse_count("nodes", n, std::to_string(i));
            if (row.size() < 4)
              throw InputError("a node has not three coordinates.");
            const dealii::Point<3> place(row[1], row[2], row[3]);
            const auto [found, is_new] = mesh.vertices.emplace(whole(row[0]), place);
            if (!is_new && found->second != place)
              throw InputError("the node " + std::to_string(found->first) +
                               " is given twice, at two places.");
          }
        require_end("nodes", n);
      }

      void
      read_elements()
      {
        if (has_elements)
          throw InputError("there are two sections of elements.");
        has_elements        = true;
        const std::size_t n = count("elements");
        if (format.binary)
          read_blocks(n);
        else
          for (std::size_t i = 0; i < n; ++i)
            {
              const auto row = numbers();
              if (row.empty())
                refuse_count("elements", n, std::to_string(i));
              read_row(row);
            }
        require_end("elements", n);
      }

      /** Number, kind, group, elementary number, number of nodes, nodes in version 1; number, kind,
       * number of tags, tags, nodes in version 2, where the first tag is the group. */
      void
      read_row(const std::vector<double> &row)
      {
        const double n_tags = format.version < 2. ? 2. : row.size() > 2 ? row[2] : 0.;
        const double first  = format.version < 2. ? 5. : 3. + n_tags;
        if (row.size() < 3 || !(n_tags >= 0. && first <= static_cast<double>(row.size())))
          throw InputError("an element is not whole.");
        const std::size_t i_group = format.version < 2. ? 2 : 3;
        add(row[0],
            row[1],
            n_tags > 0. ? row[i_group] : 0.,
            {row.begin() + static_cast<std::ptrdiff_t>(first), row.end()});
      }

      /** Blocks of kind, number of elements, number of tags, and for each element its number, tags
       * and nodes. */
      void
      read_blocks(const std::size_t n)
      {
        std::size_t done = 0;
        while (done < n)
          {
            const long kind = packed<std::int32_t>(), n_elements = packed<std::int32_t>(),
                       n_tags = packed<std::int32_t>();
            const auto found  = kinds.find(kind);
            if (found == kinds.end() || n_elements <= 0)
              throw InputError("its elements can't be read: there are " +
                               std::to_string(n_elements) + " of the kind " + std::to_string(kind) +
                               ".");
            for (long e = 0; e < n_elements; ++e, ++done)
              {
                const double number = packed<std::int32_t>();
                double group        = 0.;
                for (long tag = 0; tag < n_tags; ++tag)
                  {
                    const double value = packed<std::int32_t>();
                    group              = tag == 0 ? value : group;
                  }
                std::vector<double> nodes;
                for (unsigned int v = 0; v < found->second.n_nodes; ++v)
                  nodes.push_back(packed<std::int32_t>());
                add(number, kind, group, nodes);
              }
          }
        if (done > n)
          refuse_count("elements", n, std::to_string(done));
      }

      void
      add(const double number,
          const double kind,
          const double group,
          const std::vector<double> &nodes)
      {
        const auto found = kinds.find(static_cast<long>(kind));
        if (found == kinds.end())
          {
            ++mesh.others[3]["number " + std::to_string(static_cast<long>(kind))];
            return;
          }
        if (!found->second.other.empty() && found->first != triangle_6 &&
            found->first != tetrahedron_10)
          {
            if (found->second.dimension > 0)
              ++mesh.others[found->second.dimension][found->second.other];
            return;
          }
        if (nodes.size() != found->second.n_nodes)
          throw InputError("the element " + std::to_string(std::lround(number)) + " has " +
                           std::to_string(nodes.size()) + " nodes; there should be " +
                           std::to_string(found->second.n_nodes) + ".");
        FileMesh::Element element{static_cast<std::size_t>(std::max(number, 0.)), {}, {}};
        // A negative group means that the element is turned around.
        if (group != 0.)
          element.ids.push_back(id_of(std::abs(group)));
        if (!found->second.other.empty())
          {
            std::vector<std::size_t> all(nodes.size());
            std::transform(nodes.begin(), nodes.end(), all.begin(), whole);
            add_quadratic(mesh, element, all, NodeOrder::gmsh);
            return;
          }
        std::transform(nodes.begin(), nodes.end(), element.vertices.begin(), whole);
        mesh.elements[found->second.dimension].push_back(element);
      }

      /** Dimension (from version 2.1 on), id, and the name in quotes. */
      void
      read_names()
      {
        for (std::size_t n = count("names"); n > 0 && position < text.size(); --n)
          {
            const std::string content = line();
            const auto begin = content.find('"'), end = content.rfind('"');
            std::istringstream words(content.substr(0, begin));
            std::vector<long> numbers;
            for (long value = 0; words >> value;)
              numbers.push_back(value);
            if (begin == std::string::npos || begin == end || numbers.empty())
              throw InputError("the line '" + content + "' does not name a group.");
            const std::string name = content.substr(begin + 1, end - begin - 1);
            const long id          = std::labs(numbers.back());
            if (name.empty())
              continue;
            for (long dimension = 1; dimension <= 3; ++dimension)
              if (numbers.size() == 1 || numbers.front() == dimension)
                mesh.names[dimension][name].insert(id);
          }
      }
    };
  } // namespace


  MshFormat
  msh_format_of(const std::string &file)
  {
    std::ifstream stream(file, std::ios::binary);
    MshFormat format;
    for (std::string line; std::getline(stream, line);)
      {
        line = dealii::Utilities::trim(line);
        if (line == "$Nodes" || line == "$NOD" || line == "$Entities")
          return format;
        if (line != "$MeshFormat")
          continue;
        std::getline(stream, line);
        std::istringstream(line) >> format.version >> format.binary;
        std::array<char, 4> one{};
        if (format.binary && stream.read(one.data(), one.size()))
          format.swapped = one[0] != 1;
        return format;
      }
    return format;
  }


  unsigned int
  n_nodes_of_kind(const long kind)
  {
    const auto found = kinds.find(kind);
    return found == kinds.end() ? 0 : found->second.n_nodes;
  }


  FileMesh
  read_msh(const std::string &file)
  {
    return MshReader(file, msh_format_of(file)).mesh;
  }
} // namespace Supple
