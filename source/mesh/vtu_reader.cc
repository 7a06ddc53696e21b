#include <supple/mesh/text_readers.h>

#include <supple/base/error.h>
#include <supple/base/files.h>
#include <supple/mesh/vtk_grid.h>
#include <supple/mesh/vtu_arrays.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace Supple
{
  namespace
  {
    /** A file as XML, and what it has appended: raw bytes are no XML. */
    struct VtuText
    {
      XmlElement file;
      std::string appended;
      bool is_base64 = false;

      explicit VtuText(const std::string &text)
      {
        const auto tag = text.find("<AppendedData");
        if (tag == std::string::npos)
          {
            file = parse_xml(text);
            return;
          }
        const auto end   = text.find('>', tag);
        const auto begin = text.find('_', end);
        if (end == std::string::npos || begin == std::string::npos)
          throw InputError("the appended data have no beginning (_).");
        file      = parse_xml(text.substr(0, tag) + "</VTKFile>");
        appended  = text.substr(begin + 1);
        is_base64 = text.substr(tag, end - tag).find("\"raw\"") == std::string::npos;
        if (is_base64) // up to the next tag
          appended.resize(std::min(appended.find('<'), appended.size()));
      }
    };


    const XmlElement &
    required(const XmlElement &element, const std::string &name)
    {
      const XmlElement *const child = element.child(name);
      if (!child)
        throw InputError("<" + name + "> is missing in <" + element.name + ">.");
      return *child;
    }


    class VtuReader
    {
    public:
      VtkGrid grid;

      explicit VtuReader(VtuText text)
        : arrays(text.file, std::move(text.appended), text.is_base64)
      {
        const std::string kind = text.file.attribute("type");
        if (text.file.name != "VTKFile" || kind != "UnstructuredGrid")
          throw InputError(text.file.name != "VTKFile"
                             ? "this is no XML file of VTK: such a file begins with <VTKFile."
                             : "it holds a dataset of the kind " + kind +
                                 "; an UnstructuredGrid alone has tetrahedra.");
        grid.offsets = {0.};
        for (const XmlElement &piece : required(text.file, "UnstructuredGrid").children)
          if (piece.name == "Piece")
            read_piece(piece);
      }

    private:
      VtuArrays arrays;
      std::size_t n_pieces = 0;

      static std::size_t
      count(const XmlElement &piece, const std::string &attribute)
      {
        const std::string text = piece.attribute(attribute);
        if (text.empty() || text.size() > 12 ||
            text.find_first_not_of("0123456789") != std::string::npos)
          throw InputError("<Piece> has no " + attribute + ".");
        return std::stoul(text);
      }

      /** @throws InputError if there are not so many values */
      std::vector<double>
      values(const XmlElement &array, const std::size_t n) const
      {
        auto result = arrays.values(array);
        if (result.size() != n)
          throw InputError("the array " + array.attribute("Name") + " has " +
                           std::to_string(result.size()) + " values; there should be " +
                           std::to_string(n) + ".");
        return result;
      }

      static const XmlElement &
      array_of(const XmlElement &cells, const std::string &name)
      {
        for (const XmlElement &array : cells.children)
          if (array.attribute("Name") == name)
            return array;
        throw InputError("of <Cells> the array " + name + " is missing.");
      }

      void
      read_piece(const XmlElement &piece)
      {
        const std::size_t n_points = count(piece, "NumberOfPoints"),
                          n_cells = count(piece, "NumberOfCells"), first = grid.points.size();
        if (n_points == 0)
          return;
        const auto places = values(required(required(piece, "Points"), "DataArray"), 3 * n_points);
        for (std::size_t v = 0; v < n_points; ++v)
          grid.points.emplace_back(places[3 * v], places[3 * v + 1], places[3 * v + 2]);
        if (n_cells > 0)
          read_cells(required(piece, "Cells"), n_cells, first);
        if (const XmlElement *const data = piece.child("CellData"); data && n_cells > 0)
          for (const XmlElement &array : data->children)
            read_field(array, n_cells);
        n_pieces += n_cells > 0;
      }

      void
      read_cells(const XmlElement &cells, const std::size_t n_cells, const std::size_t first)
      {
        const double begin = grid.connectivity.size();
        for (const double end : values(array_of(cells, "offsets"), n_cells))
          grid.offsets.push_back(begin + end);
        const double size = grid.offsets.back() - begin;
        const auto points = arrays.values(array_of(cells, "connectivity"));
        if (static_cast<double>(points.size()) != size)
          throw InputError("the array connectivity has " + std::to_string(points.size()) +
                           " values, but offsets ends with " + std::to_string(std::lround(size)) +
                           ".");
        for (const double point : points)
          {
            if (!(point >= 0. && point + first < grid.points.size()))
              throw InputError("a cell has the vertex " + std::to_string(std::lround(point)) +
                               ", but there are only " +
                               std::to_string(grid.points.size() - first) + ".");
            grid.connectivity.push_back(point + first);
          }
        const auto kinds = values(array_of(cells, "types"), n_cells);
        grid.kinds.insert(grid.kinds.end(), kinds.begin(), kinds.end());
      }

      /** Of several pieces one field has the values of all. */
      void
      read_field(const XmlElement &array, const std::size_t n_cells)
      {
        if (array.name != "DataArray" || array.attribute("type") == "String")
          return;
        const std::string name = array.attribute("Name");
        const std::string text = array.attribute("NumberOfComponents");
        const std::size_t n_columns =
          std::max<std::size_t>(std::strtoul(text.c_str(), nullptr, 10), 1);
        auto field = std::find_if(grid.fields.begin(), grid.fields.end(), [&](const auto &known) {
          return known.name == name;
        });
        if (field == grid.fields.end() && n_pieces > 0)
          throw InputError("not all pieces have the field " + name + ".");
        if (field == grid.fields.end())
          field = grid.fields.insert(field, {name, n_columns, {}});
        const auto more = values(array, n_columns * n_cells);
        field->values.insert(field->values.end(), more.begin(), more.end());
      }
    };
  } // namespace


  FileMesh
  read_vtu(const std::string &file)
  {
    return mesh_of(VtuReader(VtuText(content_of(file))).grid);
  }
} // namespace Supple
