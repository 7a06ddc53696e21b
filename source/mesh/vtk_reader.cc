#include <supple/mesh/text_readers.h>

#include <supple/base/error.h>
#include <supple/base/files.h>
#include <supple/base/packed_number.h>
#include <supple/mesh/vtk_grid.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>

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
        : text(content_of(file))
      {
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
        return announced(word(), of);
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

      /** Texts, each on a line; or each after its length, whose first two bits tell how many bytes
       * it has. */
      void
      skip_strings(const std::size_t n)
      {
        line();
        for (std::size_t i = 0; i < n && position < text.size(); ++i)
          if (!binary)
            line();
          else
            {
              const auto first       = static_cast<unsigned char>(text[position]);
              const unsigned n_bytes = 1u << (3 - (first >> 6));
              std::size_t length     = first & 63;
              for (unsigned b = 1; b < n_bytes && position + b < text.size(); ++b)
                length = 256 * length + static_cast<unsigned char>(text[position + b]);
              position = std::min(position + n_bytes + length, text.size());
            }
      }

    private:
      const std::string text;
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
        if (text.size() - position < sizeof(Number))
          throw InputError("the file ends before all " + of + " are there.");
        position += sizeof(Number);
        // The most significant byte comes first.
        return packed_number<Number>(&text[position - sizeof(Number)], true);
      }

      double
      packed(const std::string &type, const std::string &of)
      {
        if (type == "double")
          return packed_as<double>(of);
        if (type == "float")
          return packed_as<float>(of);
        if (type == "int" || type == "vtkIdType")
          return packed_as<std::int32_t>(of);
        if (type == "unsigned_int")
          return packed_as<std::uint32_t>(of);
        if (type == "vtktypeint64" || type == "long")
          return packed_as<std::int64_t>(of);
        if (type == "vtktypeuint64" || type == "unsigned_long")
          return packed_as<std::uint64_t>(of);
        if (type == "short")
          return packed_as<std::int16_t>(of);
        if (type == "unsigned_short")
          return packed_as<std::uint16_t>(of);
        if (type == "char" || type == "signed_char")
          return packed_as<signed char>(of);
        if (type == "unsigned_char")
          return packed_as<unsigned char>(of);
        throw InputError("numbers of the type " + type + " are not read.");
      }
    };


    class VtkReader
    {
    public:
      explicit VtkReader(const std::string &file)
        : stream(file)
      {
        stream.line(); // the version
        stream.line(); // a title
        const std::string format = stream.coming();
        if (format != "ASCII" && format != "BINARY")
          throw InputError("its third line should be ASCII or BINARY, not '" + format + "'.");
        stream.binary = format == "BINARY";
        stream.word();
        read();
      }

      VtkGrid grid;

    private:
      VtkStream stream;

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
                grid.kinds          = stream.numbers(n, "int", "kinds of cells");
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
          grid.points.emplace_back(values[3 * v], values[3 * v + 1], values[3 * v + 2]);
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
            grid.offsets           = stream.numbers(n, type, "cells");
            if (stream.word() != "CONNECTIVITY")
              throw InputError("CONNECTIVITY is missing after OFFSETS.");
            const std::string other_type = stream.word();
            grid.connectivity            = stream.numbers(size, other_type, "vertices of cells");
            return;
          }
        const auto values = stream.numbers(size, "int", "cells");
        grid.offsets      = {0.};
        for (std::size_t i = 0; i < values.size();)
          {
            const double n_vertices = values[i++];
            for (double v = 0; v < n_vertices && i < values.size(); ++v)
              grid.connectivity.push_back(values[i++]);
            grid.offsets.push_back(grid.connectivity.size());
          }
        if (grid.offsets.size() != n + 1)
          throw InputError("it announces " + std::to_string(n) + " cells, but has " +
                           std::to_string(grid.offsets.size() - 1) + ".");
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

      void
      keep(const std::string &name,
           const std::size_t columns,
           const std::size_t rows,
           const std::string &type,
           const bool of_cells)
      {
        if (type == "string")
          stream.skip_strings(columns * rows);
        else if (const auto values = stream.numbers(columns * rows, type, "values of " + name);
                 of_cells)
          grid.fields.push_back({name, columns, values});
      }
    };
  } // namespace


  FileMesh
  read_legacy_vtk(const std::string &file)
  {
    return mesh_of(VtkReader(file).grid);
  }
} // namespace Supple
