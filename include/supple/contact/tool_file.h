#ifndef supple_tool_file_h
#define supple_tool_file_h

#include <array>
#include <string>
#include <vector>

namespace Supple
{
  /** Triangles by the numbers of their corners. */
  struct TriangleMesh
  {
    std::vector<std::array<double, 3>> points; ///< each stands once
    std::vector<std::array<unsigned int, 3>> triangles;
  };


  /** Reads the surface of a rigid body from a .stl, .obj or .ply file, with the Open Asset Import
   * Library. Triangles of no area are left out.
   * @throws InputError beginning with @p origin */
  TriangleMesh
  read_triangles(const std::string &file, const std::string &origin);
} // namespace Supple

#endif
