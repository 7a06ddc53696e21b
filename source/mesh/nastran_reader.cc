#include <supple/mesh/text_readers.h>

#include <supple/base/error.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <set>

namespace Supple
{
  namespace
  {
    using dealii::Utilities::trim;

    /** A card: its name, and its fields over all its lines. */
    struct Card
    {
      std::string name;
      std::vector<std::string> fields;
      std::string place; ///< file and line, for messages
      std::string
        mark; ///< in the last field of its last line, that the next line should begin with

      std::string
      field(const std::size_t i) const
      {
        return i < fields.size() ? fields[i] : "";
      }

      [[noreturn]] void
      refuse(const std::string &why) const
      {
        throw InputError(place + ", " + name + ": " + why);
      }

      /** @throws InputError if a field is no whole number; an empty one is @p preset */
      std::size_t
      whole_number(const std::size_t i, const std::size_t preset = 0) const
      {
        const std::string text = field(i);
        if (text.empty() && preset > 0)
          return preset;
        if (text.empty() || text.size() > 18 ||
            text.find_first_not_of("0123456789") != std::string::npos)
          refuse("'" + text + "' in field " + std::to_string(i + 2) + " is not a whole number.");
        return std::stoul(text);
      }

      /** 1.5, 15.-1, 1.5E0 or 1.5D0; an empty field is 0. */
      double
      number(const std::size_t i) const
      {
        std::string text = field(i);
        std::replace(text.begin(), text.end(), 'D', 'E');
        const auto sign = text.find_last_of("+-");
        if (sign != std::string::npos && sign > 0 && text[sign - 1] != 'E')
          text.insert(sign, "E");
        char *end          = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        if (*end != '\0' || !std::isfinite(value))
          refuse("'" + field(i) + "' in field " + std::to_string(i + 2) + " is not a number.");
        return value;
      }
    };


    std::string
    capitals(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), [](const unsigned char letter) {
        return std::toupper(letter);
      });
      return text;
    }


    std::string
    without_tabs(const std::string &line)
    {
      std::string text;
      for (const char letter : line)
        if (letter == '\t')
          text.append(8 - text.size() % 8, ' ');
        else
          text.push_back(letter);
      return text;
    }


    /** The fields of one line, the first and the mark at the end included where they are there. */
    std::vector<std::string>
    fields_of(const std::string &line)
    {
      std::vector<std::string> fields;
      if (line.find(',') != std::string::npos)
        {
          for (std::size_t begin = 0; begin <= line.size();)
            {
              const auto comma = std::min(line.find(',', begin), line.size());
              fields.push_back(trim(line.substr(begin, comma - begin)));
              begin = comma + 1;
            }
          return fields;
        }
      const bool wide = line.substr(0, 8).find('*') != std::string::npos;
      for (std::size_t begin = 0; begin < std::min<std::size_t>(line.size(), 80);)
        {
          const std::size_t width = wide && begin > 0 && begin < 72 ? 16 : 8;
          fields.push_back(trim(line.substr(begin, width)));
          begin += width;
        }
      return fields;
    }


    /** Cuts a file and those that it includes into cards. */
    class Cards
    {
    public:
      std::vector<Card> list;
      bool may_be_cut = false; ///< it begins the bulk data and does not end them

      void
      read(const std::filesystem::path &file, const unsigned int depth = 0)
      {
        std::ifstream stream(file);
        if (!stream)
          throw InputError("the included file " + file.string() + " can't be read.");
        const bool has_head = begins_bulk(file, depth);
        if (depth == 0)
          in_bulk = !has_head;
        unsigned int number = 0;
        for (std::string line; std::getline(stream, line) && !ended;)
          {
            ++number;
            if (line.rfind("\xEF\xBB\xBF", 0) == 0)
              throw InputError(file.filename().string() +
                               " begins with a byte order mark, three bytes that some editors "
                               "write. Save it without (as UTF-8 without BOM).");
            line                    = without_tabs(line.substr(0, line.find('$')));
            line                    = line.substr(0, line.find_last_not_of(" \r\n") + 1);
            const std::string start = capitals(trim(line)).substr(0, 8);
            const std::string place = file.filename().string() + ", line " + std::to_string(number);
            if (start.rfind("INCLUDE", 0) == 0)
              read(included(trim(line), file, place), depth + 1);
            else if (start.rfind("BEGIN", 0) == 0)
              in_bulk = true;
            else if (start.rfind("ENDDATA", 0) == 0)
              ended = true;
            else if (in_bulk && !start.empty())
              add(capitals(line), place);
          }
        may_be_cut = depth == 0 && has_head && !ended;
      }

    private:
      bool ended   = false;
      bool in_bulk = false; ///< or still in the case control

      /** Whether it has the line BEGIN BULK, or one of the files that it includes. */
      static bool
      begins_bulk(const std::filesystem::path &file, const unsigned int depth)
      {
        if (depth > 8)
          throw InputError("INCLUDE of files that include each other.");
        std::ifstream stream(file);
        unsigned int number = 0;
        for (std::string line; std::getline(stream, line);)
          {
            ++number;
            line = trim(line.substr(0, std::min(line.find('$'), line.find('\r'))));
            const std::string start = capitals(line.substr(0, 8));
            if (start.rfind("BEGIN", 0) == 0)
              return true;
            const std::string place = file.filename().string() + ", line " + std::to_string(number);
            if (start.rfind("INCLUDE", 0) == 0 &&
                begins_bulk(included(line, file, place), depth + 1))
              return true;
          }
        return false;
      }

      static std::filesystem::path
      included(const std::string &line, const std::filesystem::path &file, const std::string &place)
      {
        std::string name = trim(line.substr(7));
        if (!name.empty() && (name[0] == '\'' || name[0] == '"'))
          {
            if (name.size() < 2 || name.back() != name[0])
              throw InputError(place + ", INCLUDE: write the name on one line.");
            name = name.substr(1, name.size() - 2);
          }
        const auto path = file.parent_path() / name;
        std::error_code problem;
        if (name.empty() || !std::filesystem::is_regular_file(path, problem))
          throw InputError(place + ": the included file '" + name + "' is not there.");
        return path;
      }

      /** Between commas the mark of a continuation line may come before the last field. */
      static bool
      is_mark(const std::string &field)
      {
        return !field.empty() && field[0] == '+' &&
               (field.size() == 1 || std::isalpha(static_cast<unsigned char>(field[1])));
      }

      void
      add(const std::string &line, const std::string &place)
      {
        std::vector<std::string> fields = fields_of(line);
        std::string name                = fields[0];
        if (name.rfind("=", 0) == 0)
          throw InputError(place + ": lines that repeat others (=) are not read.");
        const bool wide        = name.find('*') != std::string::npos;
        const std::size_t most = wide ? 4 : 8;
        std::string mark;
        if (fields.size() == most + 2 || (fields.size() > 1 && is_mark(fields.back())))
          {
            mark = fields.back();
            fields.pop_back();
          }
        if (fields.size() < most + 1)
          fields.resize(most + 1);
        if (!name.empty() && name[0] != '+' && name[0] != '*')
          list.push_back({trim(name.substr(0, name.find('*'))), {}, place, ""});
        else if (list.empty())
          throw InputError(place + ": a continuation line without a line before it.");
        else
          require_order(list.back().mark, name, place);
        list.back().mark = mark;
        list.back().fields.insert(list.back().fields.end(), fields.begin() + 1, fields.end());
      }

      /** A line goes on with the card before it, unless it is marked as one of another. The first
       * character of a mark may be any. */
      static void
      require_order(std::string mark, std::string name, const std::string &place)
      {
        const std::string any = mark.empty() ? "" : trim(mark.substr(1));
        for (std::string *text : {&mark, &name})
          *text = text->empty() ? "" : trim(text->substr((*text)[0] == '+' || (*text)[0] == '*'));
        if (!mark.empty() && !name.empty() && mark != name && any != name)
          throw InputError(place + ": the continuation line is not that of the line before it ('" +
                           name + "' and '" + mark + "').");
      }
    };


    class NastranReader
    {
    public:
      FileMesh mesh;

      explicit NastranReader(const std::string &file)
      {
        Cards cards;
        cards.read(file);
        if (cards.may_be_cut)
          mesh.warnings.push_back("ENDDATA is missing: the file may be cut off.");
        for (const Card &card : cards.list)
          if (card.name == "GRDSET")
            preset_system = card.field(1);
        for (const Card &card : cards.list)
          read(card);
        std::string unknown;
        for (const auto &[name, n] : not_read)
          unknown += (unknown.empty() ? "" : ", ") + name + " (" + std::to_string(n) + ")";
        if (!unknown.empty())
          mesh.warnings.push_back("Elements that are no cells are not read: " + unknown + ".");
      }

    private:
      std::string preset_system;
      std::set<std::size_t> element_numbers;
      std::map<std::string, unsigned int> not_read;

      static bool
      begins(const Card &card, const std::vector<std::string> &starts)
      {
        return std::any_of(starts.begin(), starts.end(), [&](const std::string &start) {
          return card.name.rfind(start, 0) == 0;
        });
      }

      void
      read(const Card &card)
      {
        if (card.name == "GRID")
          read_vertex(card);
        else if (card.name == "CTETRA")
          read_element(card, 3, 10, "Tetrahedron");
        else if (card.name == "CTRIA3" || card.name == "CTRIAR")
          read_element(card, 2, 3, "Triangle");
        else if (std::set<std::string>{"CBAR", "CBEAM", "CROD", "CTUBE"}.count(card.name) > 0)
          read_element(card, 1, 2, "Line");
        else if (begins(card, {"CHEX", "CPENTA", "CPYRA", "CTET"}))
          ++mesh.others[3][card.name];
        else if (begins(card, {"CTRI", "CQUAD", "CSHEAR", "CTRAX", "CPLST"}))
          ++mesh.others[2][card.name];
        else if ((card.name[0] == 'C' && !begins(card, {"CORD"})) || begins(card, {"RBE", "RBAR"}))
          ++not_read[card.name];
      }

      void
      read_vertex(const Card &card)
      {
        const std::string system = card.field(1).empty() ? preset_system : card.field(1);
        if (!system.empty() && system != "0")
          card.refuse("the vertex is given in the coordinate system " + system +
                      ". Write all vertices in the basic system.");
        const dealii::Point<3> place(card.number(2), card.number(3), card.number(4));
        const auto [found, is_new] = mesh.vertices.emplace(card.whole_number(0), place);
        if (!is_new && found->second != place)
          card.refuse("the vertex " + card.field(0) + " is given twice, at two places.");
      }

      /** The number of the element, its property, and vertices, which may be so many. */
      void
      read_element(const Card &card,
                   const unsigned int dimension,
                   const unsigned int most,
                   const std::string &kind)
      {
        FileMesh::Element element{card.whole_number(0), {}, {}};
        if (!element_numbers.insert(element.number).second)
          card.refuse("the element " + card.field(0) +
                      " is given twice. Each element needs a number of its own.");
        if (const std::size_t property = card.whole_number(1, element.number))
          {
            if (property > std::numeric_limits<int>::max())
              card.refuse("the number of the property, " + std::to_string(property) +
                          ", is too large.");
            element.ids.push_back(property);
          }
        unsigned int n_vertices = dimension + 1;
        for (unsigned int v = n_vertices; v < most; ++v)
          if (!card.field(2 + v).empty())
            n_vertices = most;
        if (kind == "Tetrahedron" && n_vertices == 10)
          {
            std::vector<std::size_t> nodes;
            for (unsigned int v = 0; v < n_vertices; ++v)
              nodes.push_back(card.whole_number(2 + v));
            add_quadratic(mesh, element, nodes, NodeOrder::vtk);
            return;
          }
        if (n_vertices > dimension + 1)
          {
            ++mesh.others[dimension][kind + " " + std::to_string(n_vertices)];
            return;
          }
        for (unsigned int v = 0; v < n_vertices; ++v)
          element.vertices[v] = card.whole_number(2 + v);
        mesh.elements[dimension].push_back(element);
      }
    };
  } // namespace


  FileMesh
  read_nastran(const std::string &file)
  {
    return NastranReader(file).mesh;
  }
} // namespace Supple
