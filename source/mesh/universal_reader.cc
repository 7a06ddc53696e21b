#include <supple/mesh/text_readers.h>

#include <supple/base/error.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>

namespace Supple
{
  namespace
  {
    /** An element before it is known whose ids count. */
    struct UniversalElement
    {
      unsigned int dimension;
      std::size_t property, material;
      FileMesh::Element element;
    };


    class UniversalReader
    {
    public:
      FileMesh mesh;

      explicit UniversalReader(const std::string &file)
        : stream(file)
      {
        while (next())
          if (is_end())
            read_dataset();
        set_ids();
      }

    private:
      std::ifstream stream;
      std::string line;
      unsigned int number = 0; ///< of the line
      std::map<std::size_t, UniversalElement> elements;
      std::set<long> other_systems; ///< labels of coordinate systems that are not the basic one
      std::set<unsigned int> group_numbers;
      std::map<std::size_t, std::vector<unsigned int>> groups; ///< of elements
      std::map<unsigned int, std::string> group_names;
      std::size_t n_vertex_groups = 0;

      [[noreturn]] void
      refuse(const std::string &why) const
      {
        throw InputError("line " + std::to_string(number) + ": " + why);
      }

      bool
      next()
      {
        ++number;
        return static_cast<bool>(std::getline(stream, line));
      }

      /** @throws InputError at the end of the file */
      void
      require_next()
      {
        if (!next())
          refuse("the file ends within a dataset.");
      }

      bool
      is_end() const
      {
        return dealii::Utilities::trim(line) == "-1";
      }

      /** The whole numbers of the line. */
      std::vector<long>
      whole_numbers() const
      {
        std::istringstream words(line);
        std::vector<long> numbers;
        for (long value = 0; words >> value;)
          numbers.push_back(value);
        return numbers;
      }

      /** The whole numbers of the line. @throws InputError if there are fewer */
      std::vector<long>
      whole_numbers(const std::size_t least) const
      {
        const auto numbers = whole_numbers();
        if (numbers.size() < least)
          refuse("there should be " + std::to_string(least) + " whole numbers.");
        return numbers;
      }

      /** Some programs begin with 0. */
      std::size_t
      label(const long value) const
      {
        if (value < 0)
          refuse("the number " + std::to_string(value) + " is negative.");
        return value;
      }

      void
      read_dataset()
      {
        if (!next())
          return;
        const std::string name = dealii::Utilities::trim(line);
        require_next();
        while (!is_end())
          {
            if (name == "2411" || name == "781")
              read_vertex();
            else if (name == "2412")
              read_element();
            else if (name == "2420")
              read_systems();
            else if (name == "2467" || name == "2477" || name == "2452" || name == "2435")
              read_group(4);
            else if (name == "2429" || name == "2430" || name == "2432")
              read_group(2);
            else
              require_next();
          }
      }

      /** Label, coordinate systems and color; on the next line three numbers. */
      void
      read_vertex()
      {
        const auto labels = whole_numbers(2);
        if (other_systems.count(labels[1]) > 0)
          refuse("a vertex is given in the coordinate system " + std::to_string(labels[1]) +
                 ". Write all vertices in the basic system.");
        require_next();
        std::string text = line;
        std::replace(text.begin(), text.end(), 'D', 'E');
        std::replace(text.begin(), text.end(), 'd', 'e');
        std::istringstream words(text);
        dealii::Point<3> place;
        if (!(words >> place[0] >> place[1] >> place[2]))
          refuse("there should be three coordinates.");
        if (!mesh.vertices.emplace(label(labels[0]), place).second)
          refuse("the vertex " + std::to_string(labels[0]) + " is given twice.");
        require_next();
      }

      /** The part and its name, then label, kind and color of each system, a name, and four lines
       * of its axes and origin. */
      void
      read_systems()
      {
        require_next();
        for (require_next(); !is_end(); require_next())
          {
            const auto labels = whole_numbers(2);
            bool basic        = labels[1] == 0; // cartesian
            require_next();
            for (unsigned int row = 0; row < 4; ++row)
              {
                require_next();
                std::replace(line.begin(), line.end(), 'D', 'E');
                std::istringstream words(line);
                for (unsigned int column = 0; column < 3; ++column)
                  {
                    double value = 0.;
                    if (!(words >> value))
                      refuse("there should be three numbers.");
                    basic = basic && value == (row == column ? 1. : 0.);
                  }
              }
            if (!basic)
              other_systems.insert(labels[0]);
          }
      }

      /** Dimension of a kind of element; 0 for springs, masses and the like. */
      static unsigned int
      dimension_of(const long kind)
      {
        return kind >= 101 && kind <= 118  ? 3
               : kind >= 41 && kind <= 100 ? 2
               : kind >= 11 && kind <= 40  ? 1
                                           : 0;
      }

      /** Label, kind, physical property, material, color, number of vertices; for a beam a line of
       * its orientation; the vertices, eight on a line. */
      void
      read_element()
      {
        const auto words             = whole_numbers(6);
        const unsigned int dimension = dimension_of(words[1]);
        const std::size_t n_vertices = label(words[5]);
        if (words[1] == 11 || (words[1] >= 21 && words[1] <= 24))
          require_next();
        std::vector<long> vertices;
        while (vertices.size() < n_vertices)
          {
            require_next();
            if (is_end())
              refuse("the file ends within an element.");
            const auto more = whole_numbers(1);
            vertices.insert(vertices.end(), more.begin(), more.end());
          }
        require_next();
        if (dimension == 0)
          return;
        if (n_vertices != dimension + 1)
          {
            const char *const names[] = {"", "Line ", "Face ", "Cell "};
            ++mesh.others[dimension][names[dimension] + std::to_string(n_vertices)];
            return;
          }
        UniversalElement element{dimension,
                                 static_cast<std::size_t>(std::max(words[2], 0l)),
                                 static_cast<std::size_t>(std::max(words[3], 0l)),
                                 {label(words[0]), {}, {}}};
        for (std::size_t v = 0; v < n_vertices; ++v)
          element.element.vertices[v] = label(vertices[v]);
        if (!elements.emplace(element.element.number, element).second)
          refuse("the element " + std::to_string(words[0]) +
                 " is given twice. Each element needs a number of its own.");
      }

      /** Its number and, last, how many members it has; its name; the members, each a kind, a label
       * and other numbers. */
      void
      read_group(const std::size_t n_numbers)
      {
        const auto words = whole_numbers(2);
        // 0 means that an element has no id.
        unsigned int id = std::max<std::size_t>(label(words.front()), 1);
        while (!group_numbers.insert(id).second)
          ++id;
        require_next();
        group_names[id] = dealii::Utilities::trim(line);
        std::vector<long> members;
        while (members.size() < n_numbers * static_cast<std::size_t>(std::max(words.back(), 0l)))
          {
            require_next();
            if (is_end())
              refuse("the file ends within the group " + group_names[id] + ".");
            const auto more = whole_numbers(n_numbers);
            members.insert(members.end(), more.begin(), more.end());
          }
        bool has_vertices = false;
        for (std::size_t m = 0; m + 1 < members.size(); m += n_numbers)
          if (members[m] == 8)
            groups[members[m + 1]].push_back(id);
          else
            has_vertices = has_vertices || members[m] == 7;
        n_vertex_groups += has_vertices;
        require_next();
      }

      void
      set_ids()
      {
        std::set<unsigned int> with_groups;
        bool has_materials = false;
        for (const auto &[label, element] : elements)
          {
            if (groups.count(label) > 0)
              with_groups.insert(element.dimension);
            has_materials = has_materials || element.material > 0;
          }
        for (auto &[label, element] : elements)
          {
            auto &ids = element.element.ids;
            if (groups.count(label) > 0)
              ids = groups[label];
            const std::size_t id = has_materials ? element.material : element.property;
            if (with_groups.count(element.dimension) == 0 && id > 0)
              ids.push_back(id);
            for (const unsigned int group : groups[label])
              mesh.names[element.dimension][group_names[group]].insert(group);
            mesh.elements[element.dimension].push_back(element.element);
          }
        if (n_vertex_groups > 0)
          mesh.warnings.push_back(std::to_string(n_vertex_groups) +
                                  " group(s) of vertices are not read; groups of faces are.");
      }
    };
  } // namespace


  FileMesh
  read_universal(const std::string &file)
  {
    return UniversalReader(file).mesh;
  }
} // namespace Supple
