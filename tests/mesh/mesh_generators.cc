// Generated bodies: numbers of vertices and cells, volumes, boundaries, and the bar and the vein
// cell by cell as in tests/data/bar and tests/data/vein.

#include <supple/mesh/mesh_check.h>
#include <supple/mesh/mesh_generators.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>

using namespace Supple;

namespace
{
  std::vector<std::vector<double>>
  read_csv(const std::string &file)
  {
    std::ifstream stream(std::string(SOURCE_DIR) + "/../data/" + file);
    std::vector<std::vector<double>> rows;
    std::string line;
    std::getline(stream, line);
    while (std::getline(stream, line))
      rows.push_back(
        dealii::Utilities::string_to_double(dealii::Utilities::split_string_list(line, ',')));
    return rows;
  }


  void
  print(const char *name, SerialMesh mesh)
  {
    std::printf("%s: %zu vertices, %zu cells\n", name, mesh.vertices.size(), mesh.cells.size());
    double volume = 0.;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      volume += mesh.volume(c);

    // What the generator says of the boundary must be the whole of it.
    const std::size_t n_given = mesh.boundary.size();
    const MeshReport report   = check_mesh(mesh, name);
    std::map<unsigned int, double> area;
    for (const auto &triangle : mesh.boundary)
      {
        const auto &x = mesh.vertices;
        area[triangle.boundary_id] +=
          0.5 * dealii::cross_product_3d(x[triangle.vertices[1]] - x[triangle.vertices[0]],
                                         x[triangle.vertices[2]] - x[triangle.vertices[0]])
                  .norm();
      }
    std::printf("  volume %.9f, worst quality %.9f\n", volume, report.worst_quality);
    std::printf("  boundary complete: %s, warnings: %zu, repaired: %u, pieces: %u\n",
                n_given == mesh.boundary.size() ? "yes" : "no",
                report.warnings.size(),
                report.repaired,
                static_cast<unsigned int>(report.pieces.size()));
    for (const auto &[id, size] : area)
      std::printf("  boundary %u: area %.9f\n", id, size);
  }


  void
  compare(const char *name, const SerialMesh &mesh, const std::string &folder, const bool in_order)
  {
    const auto nodes = read_csv(folder + "/nodes.csv"), cells = read_csv(folder + "/tets.csv");
    double distance = nodes.size() == mesh.vertices.size() ? 0. : 1e300;
    for (std::size_t v = 0; v < nodes.size() && distance < 1e300; ++v)
      for (unsigned int d = 0; d < 3; ++d)
        distance = std::max(distance, std::abs(nodes[v][d + 1] - mesh.vertices[v][d]));
    std::printf("%s: vertices within 1e-8 of the data: %s\n", name, distance < 1e-8 ? "yes" : "no");

    unsigned int n_equal = 0;
    for (std::size_t c = 0; c < cells.size() && c < mesh.cells.size(); ++c)
      {
        std::array<unsigned int, 4> ours = mesh.cells[c], theirs;
        for (unsigned int a = 0; a < 4; ++a)
          theirs[a] = cells[c][a];
        if (!in_order) // the thesis did not care for orientation
          {
            std::sort(ours.begin(), ours.end());
            std::sort(theirs.begin(), theirs.end());
          }
        n_equal += ours == theirs;
      }
    std::printf("%s: %u of %zu cells as in the data\n", name, n_equal, cells.size());
  }
} // namespace


int
main()
{
  MeshParameters bar;
  bar.size  = {4., 12., 4.};
  bar.cubes = {{2, 8, 2}};
  print("bar", box_mesh(bar));
  compare("bar", box_mesh(bar), "bar", true);

  MeshParameters vein;
  vein.height  = 5.;
  vein.sectors = 15;
  vein.rings   = 22;
  print("vein", hollow_cylinder_mesh(vein));
  compare("vein", hollow_cylinder_mesh(vein), "vein", false);
  const SerialMesh mesh = hollow_cylinder_mesh(vein);
  for (const unsigned int v : {0, 120, 330, 659})
    std::printf("  vertex %u at %.9f %.9f %.9f\n",
                v,
                mesh.vertices[v][0],
                mesh.vertices[v][1],
                mesh.vertices[v][2]);

  vein.layers = 3;
  print("vein of three layers", hollow_cylinder_mesh(vein));
}
