#include <supple/mesh/coarser_mesh.h>
#include <supple/mesh/mesh_counts.h>

#include <algorithm>
#include <array>

namespace Supple
{
  namespace
  {
    using Shape = MeshParameters::Shape;


    /** Whether two rows that become one are of different materials. */
    bool
    would_mix_materials(const MeshParameters &mesh)
    {
      if (mesh.material_layers.empty())
        return false;
      const auto [height, n_rows] = mesh.height_and_rows();
      const std::vector<unsigned int> material =
        mesh.material_of_rows(mesh.ends_of_rows(height, n_rows));
      for (unsigned int row = 0; row + 1 < n_rows; row += 2)
        if (material[row] != material[row + 1])
          return true;
      return false;
    }


    /** The numbers of a box of vertices with every other one left out.
     * @param n intervals of the whole along each direction, even */
    std::vector<unsigned int>
    every_other(const std::array<unsigned int, 3> &n)
    {
      std::vector<unsigned int> vertices;
      for (unsigned int k = 0; k <= n[2]; k += 2)
        for (unsigned int j = 0; j <= n[1]; j += 2)
          for (unsigned int i = 0; i <= n[0]; i += 2)
            vertices.push_back(i + (n[0] + 1) * (j + (n[1] + 1) * k));
      return vertices;
    }


    /** Of a hollow cylinder, whose every other circle is half a sector ahead: of the coarser one's,
     * that is a whole sector of the finer one. */
    std::vector<unsigned int>
    every_other_of_cylinder(const MeshParameters &mesh)
    {
      std::vector<unsigned int> vertices;
      const unsigned int n = mesh.sectors;
      for (unsigned int ring = 0; ring < mesh.rings; ring += 2)
        for (unsigned int circle = 0; circle <= mesh.layers; circle += 2)
          for (unsigned int i = 0; i < n; i += 2)
            vertices.push_back((ring * (mesh.layers + 1) + circle) * n + (i + circle / 2 % 2) % n);
      return vertices;
    }
  } // namespace


  std::string
  obstacle_to_coarser(const MeshParameters &mesh)
  {
    if (mesh.shape == Shape::file)
      return "Mesh/Shape is file, and of a file there is no mesh twice as coarse";
    if (mesh.refinement.asked())
      return "a mesh that is refined where the scene says has none twice as coarse";
    for (const MeshCounts &counts : counts_of(mesh))
      if (std::any_of(counts.intervals.begin(), counts.intervals.end(), [](const unsigned int n) {
            return n % 2 == 1;
          }))
        return counts.entry + " must be " + (counts.added % 2 == 0 ? "even" : "odd");
    if (would_mix_materials(mesh))
      return "each layer of Mesh/Layers must have an even number of rows";
    if (mesh.shape == Shape::hollow_cylinder && (mesh.sectors < 6 || coarser(mesh).walls_cross()))
      return "with half of the sectors the walls of the cylinder would cross";
    return "";
  }


  MeshParameters
  coarser(const MeshParameters &mesh)
  {
    MeshParameters result = mesh;
    for (unsigned int &n : result.cubes)
      n /= 2;
    for (unsigned int &n : result.squares)
      n /= 2;
    for (unsigned int &n : result.layer_rows)
      n /= 2;
    result.sectors = mesh.sectors / 2;
    result.layers  = mesh.layers / 2;
    result.rings   = (mesh.rings - 1) / 2 + 1;
    return result;
  }


  std::vector<unsigned int>
  vertices_of_coarser(const MeshParameters &mesh)
  {
    switch (mesh.shape)
      {
        case Shape::box:
          return every_other(mesh.cubes);
        case Shape::rectangle:
          return every_other({{mesh.squares[0], mesh.squares[1], 0}});
        default:
          return every_other_of_cylinder(mesh);
      }
  }
} // namespace Supple
