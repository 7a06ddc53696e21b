#include <supple/output/tool_polygons.h>

#include <supple/contact/tool_surface.h>

#include <sstream>

namespace Supple
{
  std::string
  draw_tools(const std::vector<Tool> &tools, const std::vector<Pose> &poses, const double extent)
  {
    std::ostringstream points, triangles, ends, tool_numbers;
    points.precision(9);
    unsigned int n_points = 0, n_triangles = 0;
    for (unsigned int t = 0; t < tools.size(); ++t)
      {
        const TriangleMesh mesh = drawn_surface(tools[t], extent);
        for (const auto &place : mesh.points)
          points << poses[t].carried(Arrow({place[0], place[1], place[2]})) << '\n';
        for (const auto &corners : mesh.triangles)
          {
            for (const unsigned int corner : corners)
              triangles << n_points + corner << ' ';
            triangles << '\n';
            ends << 3 * ++n_triangles << '\n';
            tool_numbers << t << '\n';
          }
        n_points += mesh.points.size();
      }
    const auto array = [](const std::string &attributes, const std::ostringstream &values) {
      return "<DataArray " + attributes + " format=\"ascii\">\n" + values.str() + "</DataArray>\n";
    };
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\">\n<PolyData>\n"
           "<Piece NumberOfPoints=\"" +
           std::to_string(n_points) + "\" NumberOfPolys=\"" + std::to_string(n_triangles) +
           "\">\n<Points>\n" + array("type=\"Float64\" NumberOfComponents=\"3\"", points) +
           "</Points>\n<Polys>\n" + array("type=\"Int32\" Name=\"connectivity\"", triangles) +
           array("type=\"Int32\" Name=\"offsets\"", ends) + "</Polys>\n<CellData>\n" +
           array("type=\"Int32\" Name=\"tool\"", tool_numbers) +
           "</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  }
} // namespace Supple
