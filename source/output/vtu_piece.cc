#include <supple/output/vtu_piece.h>

#include <supple/base/error.h>
#include <supple/base/text.h>
#include <supple/output/vtk_array.h>

#include <limits>

namespace Supple
{
  namespace
  {
    /** Numbers have no number of components: meshio would make columns of one entry of them. */
    std::string
    attributes(const std::string &type, const std::string &name, const unsigned int n_components)
    {
      return "type=\"" + type + "\" Name=\"" + name + "\"" +
             (n_components == 1 ? ""
                                : " NumberOfComponents=\"" + std::to_string(n_components) + "\"");
    }


    std::string
    element(const std::string &attributes, const std::string &content)
    {
      return "<DataArray " + attributes + " format=\"binary\">\n" + content + "\n</DataArray>\n";
    }


    void
    append(std::string &text, const std::vector<VtuField> &fields)
    {
      for (const VtuField &field : fields)
        text += element(attributes("Float32", field.name, field.n_components),
                        vtk_array(*field.values, Packing::stored));
    }


    std::string
    declarations(const std::vector<VtuField> &fields)
    {
      std::string text;
      for (const VtuField &field : fields)
        text += "<PDataArray " + attributes("Float32", field.name, field.n_components) + "/>\n";
      return text;
    }


    /** Everything around a grid of this type. */
    std::string
    document(const std::string &type, const std::string &options, const std::string &content)
    {
      const std::uint16_t one = 1;
      const bool little       = reinterpret_cast<const unsigned char &>(one) == 1;
      return "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type +
             "\" version=\"1.0\" byte_order=\"" + (little ? "LittleEndian" : "BigEndian") +
             "\" header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<" + type + options +
             ">\n" + content + "</" + type + ">\n</VTKFile>\n";
    }


    std::string
    instant(const std::string &name, const double value)
    {
      return "<DataArray type=\"Float64\" Name=\"" + name +
             "\" NumberOfTuples=\"1\" format=\"ascii\">" + digits(value, all_digits) +
             "</DataArray>\n";
    }
  } // namespace


  VtuPiece::VtuPiece(const VtuCells &cells, const std::vector<VtuIds> &ids)
    : n_cells(cells.points.size() / cells.points_per_cell)
  {
    if (cells.points.size() > std::size_t(std::numeric_limits<std::int32_t>::max()))
      throw WriteError(
        "One process has too many cells for a frame: their vertices are counted in "
        "32 bits. Take more processes.");
    std::vector<std::int32_t> ends(n_cells);
    for (std::size_t cell = 0; cell < n_cells; ++cell)
      ends[cell] = (cell + 1) * cells.points_per_cell;
    const std::vector<std::uint8_t> types(n_cells, cells.type);
    topology = "<Cells>\n";
    topology +=
      element(attributes("Int32", "connectivity", 1), vtk_array(cells.points, Packing::compressed));
    topology += element(attributes("Int32", "offsets", 1), vtk_array(ends, Packing::compressed));
    topology += element(attributes("UInt8", "types", 1), vtk_array(types, Packing::compressed));
    topology += "</Cells>\n";
    for (const VtuIds &of_cells : ids)
      {
        const std::string declared = attributes("Int32", of_cells.name, 1);
        ids_declared += "<PDataArray " + declared + "/>\n";
        ids_packed += element(declared, vtk_array(*of_cells.values, Packing::compressed));
      }
  }


  std::string
  VtuPiece::file(const Instant &now) const
  {
    std::string text =
      "<FieldData>\n" + instant("CYCLE", now.step) + instant("TIME", now.time) + "</FieldData>\n";
    text += "<Piece NumberOfPoints=\"" + std::to_string(now.points.size() / 3) +
            "\" NumberOfCells=\"" + std::to_string(n_cells) + "\">\n<Points>\n";
    text += element(attributes("Float64", "Points", 3), vtk_array(now.points, Packing::stored));
    text += "</Points>\n";
    text += topology;
    text += "<PointData>\n";
    append(text, now.of_points);
    text += "</PointData>\n<CellData>\n";
    append(text, now.of_cells);
    text += ids_packed;
    text += "</CellData>\n</Piece>\n";
    return document("UnstructuredGrid", "", text);
  }


  std::string
  VtuPiece::record(const Instant &now, const std::vector<std::string> &files) const
  {
    std::string text = "<PPointData>\n" + declarations(now.of_points) +
                       "</PPointData>\n<PCellData>\n" + declarations(now.of_cells) + ids_declared +
                       "</PCellData>\n<PPoints>\n<PDataArray " +
                       attributes("Float64", "Points", 3) + "/>\n</PPoints>\n";
    for (const std::string &name : files)
      text += "<Piece Source=\"" + name + "\"/>\n";
    return document("PUnstructuredGrid", " GhostLevel=\"0\"", text);
  }
} // namespace Supple
