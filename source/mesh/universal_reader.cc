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
      std::vector<std::size_t> nodes; ///< of a quadratic one, otherwise none
    };


    struct UniversalGroup
    {
      unsigned int number;
      std::string name;
      std::vector<std::size_t> members; ///< labels of elements
      bool has_vertices = false;
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
        require_basic_systems();
        set_ids();
        warn_of_groups();
      }

    private:
      std::ifstream stream;
      std::string line;
      unsigned int number = 0; ///< of the line
      std::map<std::size_t, UniversalElement> elements;
      std::set<long> other_systems; ///< labels of coordinate systems that are not the basic one
      std::map<long, unsigned int>
        systems_of_vertices;                ///< and the line of the first vertex of each
      std::set<std::size_t> other_elements; ///< labels of those that are not read
      std::vector<UniversalGroup> groups;

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
        systems_of_vertices.emplace(labels[1], number);
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
        const bool quadratic =
          (dimension == 2 && n_vertices == 6) || (dimension == 3 && n_vertices == 10);
        const bool is_read = n_vertices == dimension + 1 || quadratic;
        if (dimension == 0 || !is_read)
          other_elements.insert(label(words[0]));
        if (dimension == 0)
          return;
        if (!is_read)
          {
            const char *const names[] = {"", "Line ", "Face ", "Cell "};
            ++mesh.others[dimension][names[dimension] + std::to_string(n_vertices)];
            return;
          }
        UniversalElement element{dimension,
                                 static_cast<std::size_t>(std::max(words[2], 0l)),
                                 static_cast<std::size_t>(std::max(words[3], 0l)),
                                 {label(words[0]), {}, {}},
                                 {}};
        for (std::size_t v = 0; v < n_vertices; ++v)
          if (quadratic)
            element.nodes.push_back(label(vertices[v]));
          else
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
        UniversalGroup group{id_of(label(words.front())), "", {}};
        require_next();
        group.name = dealii::Utilities::trim(line);
        std::vector<long> members;
        while (members.size() < n_numbers * static_cast<std::size_t>(std::max(words.back(), 0l)))
          {
            require_next();
            if (is_end())
              refuse("the file ends within the group " + group.name + ".");
            const auto more = whole_numbers(n_numbers);
            members.insert(members.end(), more.begin(), more.end());
          }
        for (std::size_t m = 0; m + 1 < members.size(); m += n_numbers)
          if (members[m] == 8)
            group.members.push_back(label(members[m + 1]));
          else
            group.has_vertices = group.has_vertices || members[m] == 7;
        groups.push_back(group);
        require_next();
      }

      void
      require_basic_systems()
      {
        for (const auto &[system, first_line] : systems_of_vertices)
          if (other_systems.count(system) > 0)
            {
              number = first_line;
              refuse("a vertex is given in the coordinate system " + std::to_string(system) +
                     ". Write all vertices in the basic system.");
            }
      }

      /** Those members of a group that are elements of a dimension. */
      std::vector<std::size_t>
      members_of(const UniversalGroup &group, const unsigned int dimension) const
      {
        std::vector<std::size_t> members;
        for (const std::size_t member : group.members)
          if (const auto found = elements.find(member);
              found != elements.end() && found->second.dimension == dimension)
            members.push_back(member);
        return members;
      }

      /** The id is the number, unless that is 0, which means no id, or that of another group. */
      unsigned int
      id_of_group(const UniversalGroup &group,
                  const std::map<unsigned int, std::string> &owners,
                  std::set<unsigned int> &taken)
      {
        const auto owner = owners.find(group.number);
        if (group.number > 0 && (owner == owners.end() || owner->second == group.name))
          return group.number;
        const unsigned int id = *taken.rbegin() + 1;
        taken.insert(id);
        mesh.warnings.push_back(
          (group.number == 0 ? "The group " + group.name + " has the number 0, which means no id"
                             : "The groups " + owner->second + " and " + group.name +
                                 " have the same number " + std::to_string(group.number)) +
          "; " + group.name + " gets the id " + std::to_string(id) + ".");
        return id;
      }

      void
      set_ids_of_groups(const unsigned int dimension)
      {
        std::set<unsigned int> taken = {0};
        for (const UniversalGroup &group : groups)
          if (!members_of(group, dimension).empty())
            taken.insert(group.number);
        std::map<unsigned int, std::string> owners;
        for (const UniversalGroup &group : groups)
          {
            const auto members = members_of(group, dimension);
            if (members.empty())
              continue;
            const unsigned int id = id_of_group(group, owners, taken);
            owners.emplace(id, group.name);
            mesh.names[dimension][group.name].insert(id);
            for (const std::size_t member : members)
              if (auto &ids = elements.at(member).element.ids;
                  std::count(ids.begin(), ids.end(), id) == 0)
                ids.push_back(id);
          }
      }

      /** Of those without groups: the material, or the physical property if that alone differs. */
      void
      set_other_ids(const unsigned int dimension)
      {
        std::set<std::size_t> materials, properties;
        bool has_groups = false;
        for (const auto &[label, element] : elements)
          if (element.dimension == dimension)
            {
              materials.insert(element.material);
              properties.insert(element.property);
              has_groups = has_groups || !element.element.ids.empty();
            }
        const bool by_property =
          materials.size() < 2 && (properties.size() > 1 || materials.count(0) > 0);
        for (auto &[label, element] : elements)
          if (const std::size_t id = by_property ? element.property : element.material;
              element.dimension == dimension && !has_groups && id > 0)
            element.element.ids.push_back(id_of(id));
      }

      void
      set_ids()
      {
        for (unsigned int dimension = 1; dimension <= 3; ++dimension)
          {
            set_ids_of_groups(dimension);
            set_other_ids(dimension);
          }
        for (const auto &[label, element] : elements)
          if (element.nodes.empty())
            mesh.elements[element.dimension].push_back(element.element);
          else
            add_quadratic(mesh, element.element, element.nodes, NodeOrder::universal);
      }

      void
      warn_of_groups()
      {
        std::size_t n_of_vertices = 0;
        for (const UniversalGroup &group : groups)
          {
            n_of_vertices += group.has_vertices;
            const auto n_missing =
              std::count_if(group.members.begin(), group.members.end(), [&](const auto member) {
                return elements.count(member) == 0 && other_elements.count(member) == 0;
              });
            if (n_missing > 0)
              mesh.warnings.push_back("The group " + group.name + " names " +
                                      std::to_string(n_missing) +
                                      " element(s) that are not in the file.");
          }
        if (n_of_vertices > 0)
          mesh.warnings.push_back(std::to_string(n_of_vertices) +
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
