#include <supple/mesh/text_readers.h>

#include <supple/base/error.h>

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
    /** The words and numbers of a file, ASCII or binary. */
    class VtkStream
    {
    public:
      bool binary = false;

      explicit VtkStream(const std::string &file)
      {
        std::ifstream stream(file, std::ios::binary);
        std::ostringstream content;
        content << stream.rdbuf();
        text = content.str();
      }

      std::string
      line()
      {
        const auto end      = std::min(text.find('\n', position), text.size());
        std::string content = text.substr(position, end - position);
        position            = std::min(end + 1, text.size());
        while (!content.empty() && std::isspace(static_cast<unsigned char>(content.back())))
          content.pop_back();
        return content;
      }

      /** Empty at the end. */
      std::string
      word()
      {
        const auto is_space = [&](const std::size_t i) {
          return std::isspace(static_cast<unsigned char>(text[i])) != 0;
        };
        while (position < text.size() && is_space(position))
          ++position;
        const std::size_t begin = position;
        while (position < text.size() && !is_space(position))
          ++position;
        return text.substr(begin, position - begin);
      }

      /** The next word, in capitals, which stays the next one. */
      std::string
      coming()
      {
        const std::size_t before = position;
        std::string next         = word();
        position                 = before;
        std::transform(next.begin(), next.end(), next.begin(), [](const unsigned char letter) {
          return std::toupper(letter);
        });
        return next;
      }

      std::size_t
      count(const std::string &of)
      {
        const std::string next = word();
        if (next.empty() || next.size() > 12 ||
            next.find_first_not_of("0123456789") != std::string::npos)
          throw InputError("'" + next + "' is no number of " + of + ".");
        return std::stoul(next);
      }

      /** So many numbers of a type, such as double; binary ones begin on the next line.
       * @throws InputError if there are fewer */
      std::vector<double>
      numbers(const std::size_t n, const std::string &type, const std::string &of)
      {
        // Each number takes two characters, or a byte.
        if (n > text.size() || (type == "bit" && binary))
          throw InputError(type == "bit" ? "bits are not read."
                                         : "the file ends before all " + of + " are there.");
        std::vector<double> values(n);
        if (binary)
          line();
        for (double &value : values)
          value = binary ? packed(type, of) : written(of);
        return values;
      }

      /** What stands between an array and the next word: of interest to VTK alone. */
      void
      skip_metadata()
      {
        while (coming() == "METADATA")
          {
            word();
            line();
            while (position < text.size() && !line().empty())
              ;
          }
      }

    private:
      std::string text;
      std::size_t position = 0;

      double
      written(const std::string &of)
      {
        const std::string next = word();
        char *end              = nullptr;
        const double value     = std::strtod(next.c_str(), &end);
        if (next.empty())
          throw InputError("the file ends before all " + of + " are there.");
        if (*end != '\0')
          throw InputError("of the " + of + " a number is '" + next + "'.");
        return value;
      }

      template <class Number>
      double
      packed_as(const std::string &of)
      {
        std::array<char, sizeof(Number)> bytes;
        if (text.size() - position < bytes.size())
          throw InputError("the file ends before all " + of + " are there.");
        // The most significant byte comes first.
        std::reverse_copy(text.begin() + position,
                          text.begin() + position + bytes.size(),
                          bytes.begin());
        position += bytes.size();
        Number value;
        std::memcpy(&value, bytes.data(), bytes.size());
        return value;
      }

      double
      packed(const std::string &type, const std::string &of)
      {
        if (type == "double")
          return packed_as<double>(of);
        if (type == "float")
          return packed_as<float>(of);
        if (type == "int" || type == "vtkIdType" || type == "unsigned_int")
          return packed_as<std::int32_t>(of);
        if (type == "vtktypeint64" || type == "long" || type == "unsigned_long" ||
            type == "vtktypeuint64")
          return packed_as<std::int64_t>(of);
        if (type == "short" || type == "unsigned_short")
          return packed_as<std::int16_t>(of);
        if (type == "char" || type == "unsigned_char" || type == "signed_char")
          return packed_as<signed char>(of);
        throw InputError("numbers of the type " + type + " are not read.");
      }
    };


    /** Of cells: which simplex it is, or what else. */
    struct VtkKind
    {
      unsigned int dimension;
      unsigned int n_vertices;
      std::string other;
    };

    const std::map<int, VtkKind> vtk_kinds = {{3, {1, 2, ""}},
                                              {4, {1, 0, "Polyline"}},
                                              {5, {2, 3, ""}},
                                              {6, {2, 0, "Triangle strip"}},
                                              {7, {2, 0, "Polygon"}},
                                              {8, {2, 4, "Pixel"}},
                                              {9, {2, 4, "Quadrilateral 4"}},
                                              {10, {3, 4, ""}},
                                              {11, {3, 8, "Voxel"}},
                                              {12, {3, 8, "Hexahedron 8"}},
                                              {13, {3, 6, "Prism 6"}},
                                              {14, {3, 5, "Pyramid 5"}},
                                              {21, {1, 3, "Line 3"}},
                                              {22, {2, 6, "Triangle 6"}},
                                              {23, {2, 8, "Quadrilateral 8"}},
                                              {24, {3, 10, "Tetrahedron 10"}},
                                              {25, {3, 20, "Hexahedron 20"}}};


    /** Names of fields of cells that programs write ids in, in small letters. */
    const std::vector<std::string> id_names = {"medit",
                                               "medit:ref",
                                               "gmsh:physical",
                                               "cellentityids",
                                               "material",
                                               "materials",
                                               "materialid",
                                               "materialids",
                                               "material_id",
                                               "material_ids",
                                               "physical",
                                               "physicalids",
                                               "region",
                                               "regionid",
                                               "cell_tags",
                                               "nastran:ref",
                                               "tetgen:ref",
                                               "avsucd:material"};


    class VtkReader
    {
    public:
      explicit VtkReader(const std::string &file)
        : stream(file)
      {
        const std::string version = stream.line();
        stream.line(); // a title
        stream.binary = stream.line().rfind("BINARY", 0) == 0;
        read();
      }

      FileMesh
      mesh()
      {
        const std::size_t n_cells = offsets.empty() ? 0 : offsets.size() - 1;
        if (kind_numbers.size() != n_cells)
          throw InputError("there are " + std::to_string(kind_numbers.size()) +
                           " kinds of cells for " + std::to_string(n_cells) + " cells.");
        for (std::size_t c = 0; c < kind_numbers.size(); ++c)
          add_cell(c);
        if (ids.empty() && !fields.empty())
          result.warnings.push_back("Of the fields of cells (" + fields +
                                    ") none has the name of ids, such as MaterialIds; all cells "
                                    "have the material id 0.");
        return std::move(result);
      }

    private:
      VtkStream stream;
      FileMesh result;
      std::vector<double> connectivity, offsets, kind_numbers, ids;
      std::string fields; ///< names of those of cells
      std::size_t rank_of_ids = id_names.size();

      void
      read()
      {
        bool of_cells       = false;
        std::size_t n_items = 0;
        for (std::string word = stream.coming(); !word.empty(); word = stream.coming())
          {
            stream.word();
            if (word == "DATASET")
              require_grid(stream.word());
            else if (word == "POINTS")
              read_points();
            else if (word == "CELLS")
              read_cells();
            else if (word == "CELL_TYPES")
              {
                const std::size_t n = stream.count("kinds of cells");
                kind_numbers        = stream.numbers(n, "int", "kinds of cells");
              }
            else if (word == "CELL_DATA" || word == "POINT_DATA")
              {
                of_cells = word == "CELL_DATA";
                n_items  = stream.count("values");
              }
            else
              read_field(word, n_items, of_cells);
            stream.skip_metadata();
          }
      }

      static void
      require_grid(const std::string &kind)
      {
        if (kind != "UNSTRUCTURED_GRID")
          throw InputError("it holds a dataset of the kind " + kind +
                           "; an UNSTRUCTURED_GRID alone has tetrahedra.");
      }

      void
      read_points()
      {
        const std::size_t n    = stream.count("points");
        const std::string type = stream.word();
        const auto values      = stream.numbers(3 * n, type, "points");
        for (std::size_t v = 0; v < n; ++v)
          result.vertices.emplace_hint(result.vertices.end(),
                                       v,
                                       dealii::Point<3>(values[3 * v],
                                                        values[3 * v + 1],
                                                        values[3 * v + 2]));
      }

      /** Up to version 4: the number of vertices before those of each cell. In version 5 where each
       * cell begins, and then all vertices. */
      void
      read_cells()
      {
        const std::size_t n = stream.count("cells"), size = stream.count("vertices of cells");
        if (stream.coming() == "OFFSETS")
          {
            stream.word();
            const std::string type = stream.word();
            offsets                = stream.numbers(n, type, "cells");
            if (stream.word() != "CONNECTIVITY")
              throw InputError("CONNECTIVITY is missing after OFFSETS.");
            const std::string other_type = stream.word();
            connectivity                 = stream.numbers(size, other_type, "vertices of cells");
            return;
          }
        const auto values = stream.numbers(size, "int", "cells");
        offsets           = {0.};
        for (std::size_t i = 0; i < values.size();)
          {
            const double n_vertices = values[i++];
            for (double v = 0; v < n_vertices && i < values.size(); ++v)
              connectivity.push_back(values[i++]);
            offsets.push_back(connectivity.size());
          }
        if (offsets.size() != n + 1)
          throw InputError("it announces " + std::to_string(n) + " cells, but has " +
                           std::to_string(offsets.size() - 1) + ".");
      }

      void
      read_field(const std::string &word, const std::size_t n, const bool of_cells)
      {
        if (word == "FIELD")
          {
            stream.word();
            for (std::size_t k = stream.count("fields"); k > 0; --k)
              {
                const std::string name    = stream.word();
                const std::size_t columns = stream.count("components"), rows = stream.count("rows");
                keep(name, columns, rows, stream.word(), of_cells);
                stream.skip_metadata();
              }
            return;
          }
        const std::string name = stream.word();
        if (word == "LOOKUP_TABLE") // four numbers for each color
          stream.numbers(4 * stream.count("colors"), stream.binary ? "char" : "float", "colors");
        else if (word == "COLOR_SCALARS")
          stream.numbers(n * stream.count("colors"), stream.binary ? "char" : "float", "colors");
        else
          keep_attribute(word, name, n, of_cells);
      }

      void
      keep_attribute(const std::string &word,
                     const std::string &name,
                     const std::size_t n,
                     const bool of_cells)
      {
        const std::map<std::string, std::size_t> columns = {{"SCALARS", 1},
                                                            {"VECTORS", 3},
                                                            {"NORMALS", 3},
                                                            {"TENSORS", 9},
                                                            {"TENSORS6", 6},
                                                            {"TEXTURE_COORDINATES", 0},
                                                            {"GLOBAL_IDS", 1},
                                                            {"PEDIGREE_IDS", 1}};
        const auto found                                 = columns.find(word);
        if (found == columns.end())
          throw InputError("the word " + word + " is not understood.");
        std::size_t n_columns = found->second;
        if (n_columns == 0)
          n_columns = stream.count("components");
        const std::string type = stream.word();
        if (word == "SCALARS")
          {
            if (stream.coming() != "LOOKUP_TABLE")
              n_columns = stream.count("components");
            if (stream.coming() == "LOOKUP_TABLE")
              {
                stream.word();
                stream.word();
              }
          }
        keep(name, n_columns, n, type, of_cells);
      }

      /** Takes ids from the field that has the likeliest name. */
      void
      keep(const std::string &name,
           const std::size_t columns,
           const std::size_t rows,
           const std::string &type,
           const bool of_cells)
      {
        const auto values = stream.numbers(columns * rows, type, "values of " + name);
        if (!of_cells)
          return;
        fields += (fields.empty() ? "" : ", ") + name;
        std::string small = name;
        std::transform(small.begin(), small.end(), small.begin(), [](const unsigned char letter) {
          return std::tolower(letter);
        });
        const std::size_t rank =
          std::find(id_names.begin(), id_names.end(), small) - id_names.begin();
        const bool whole = std::all_of(values.begin(), values.end(), [](const double value) {
          return value >= 0. && value < 1e9 && value == std::floor(value);
        });
        if (rank >= rank_of_ids || columns != 1)
          return;
        if (!whole)
          result.warnings.push_back("The field " + name +
                                    " has values that are no ids; it is not read.");
        else
          {
            rank_of_ids = rank;
            ids         = values;
          }
      }

      void
      add_cell(const std::size_t c)
      {
        const auto found = vtk_kinds.find(static_cast<int>(kind_numbers[c]));
        if (found == vtk_kinds.end())
          {
            if (kind_numbers[c] > 2.) // vertices are no cells
              ++result.others[3]["number " + std::to_string(static_cast<int>(kind_numbers[c]))];
            return;
          }
        const VtkKind &kind = found->second;
        if (!kind.other.empty())
          {
            ++result.others[kind.dimension][kind.other];
            return;
          }
        FileMesh::Element element{c, {}, {}};
        if (offsets[c + 1] - offsets[c] != kind.n_vertices || offsets[c] < 0. ||
            offsets[c + 1] > connectivity.size())
          throw InputError("the cell " + std::to_string(c) + " has not " +
                           std::to_string(kind.n_vertices) + " vertices.");
        for (unsigned int v = 0; v < kind.n_vertices; ++v)
          {
            const double vertex = connectivity[static_cast<std::size_t>(offsets[c]) + v];
            if (vertex < 0. || vertex >= result.vertices.size())
              throw InputError("an element has the node " + std::to_string(std::lround(vertex)) +
                               ", which is not in the file.");
            element.vertices[v] = vertex;
          }
        if (c < ids.size() && ids[c] > 0.)
          element.ids.push_back(ids[c]);
        result.elements[kind.dimension].push_back(element);
      }
    };
  } // namespace


  FileMesh
  read_legacy_vtk(const std::string &file)
  {
    return VtkReader(file).mesh();
  }
} // namespace Supple
