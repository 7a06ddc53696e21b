// Bisection of longest edges: conforming, nested, of bounded quality, with the volume, the
// materials and the boundary of the mesh that is refined.

#include <supple/mesh/bisection.h>
#include <supple/mesh/mesh_check.h>
#include <supple/mesh/mesh_generators.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

using namespace Supple;
using dealii::Point;

namespace
{
  /** Summed up without round-off of its own. */
  double
  volume(const SerialMesh &mesh)
  {
    long double sum = 0.;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      sum += mesh.volume(c);
    return sum;
  }


  double
  size(const SerialMesh &mesh, const SerialMesh::BoundaryFace &face)
  {
    const auto &x = mesh.vertices;
    if (mesh.dimension == 2)
      return x[face.vertices[0]].distance(x[face.vertices[1]]);
    return 0.5 * dealii::cross_product_3d(x[face.vertices[1]] - x[face.vertices[0]],
                                          x[face.vertices[2]] - x[face.vertices[0]])
                   .norm();
  }


  std::map<unsigned int, long double>
  areas(const SerialMesh &mesh)
  {
    std::map<unsigned int, long double> sum;
    for (const auto &face : mesh.boundary)
      sum[face.boundary_id] += size(mesh, face);
    return sum;
  }


  std::map<unsigned int, long double>
  volumes(const SerialMesh &mesh)
  {
    std::map<unsigned int, long double> sum;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      sum[mesh.materials[c]] += mesh.volume(c);
    return sum;
  }


  double
  worst_quality(const SerialMesh &mesh)
  {
    double worst = 1.;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      worst = std::min(worst, quality(mesh, c));
    return worst;
  }


  bool
  near(const std::map<unsigned int, long double> &a, const std::map<unsigned int, long double> &b)
  {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto &p, const auto &q) {
      return p.first == q.first && std::abs(p.second / q.second - 1.L) < 1e-14L;
    });
  }


  Point<3>
  halfway(const Point<3> &a, const Point<3> &b)
  {
    return a + 0.5 * (b - a);
  }


  /** Whether an affine function that is halved with the edges is the same at all vertices, and the
   * boundary is the surface of the cells: no vertex hangs. */
  void
  print(const char *name, const SerialMesh &coarse, SerialMesh fine)
  {
    const double change        = volume(fine) / volume(coarse) - 1.;
    const std::size_t n_given  = fine.boundary.size();
    const bool same_boundaries = near(areas(coarse), areas(fine));
    const bool same_materials  = near(volumes(coarse), volumes(fine));
    const double worst         = worst_quality(fine);
    const MeshReport report    = check_mesh(fine, name);
    std::printf("%s: %s cells, volume kept: %s, boundaries kept: %s, materials kept: %s\n",
                name,
                fine.cells.size() > coarse.cells.size() ? "more" : "as many",
                std::abs(change) < 1e-14 ? "yes" : "no",
                same_boundaries ? "yes" : "no",
                same_materials ? "yes" : "no");
    std::printf("  no vertex hangs: %s, warnings: %zu, quality above .3: %s\n",
                n_given == fine.boundary.size() && near(areas(fine), areas(coarse)) ? "yes" : "no",
                report.warnings.size(),
                worst > 0.3 ? "yes" : "no");
  }


  /** Cells that touch a ball about a corner are cut. */
  SerialMesh
  towards(const SerialMesh &mesh, const Point<3> &corner, const unsigned int rounds)
  {
    SerialMesh fine = mesh;
    for (unsigned int round = 0; round < rounds; ++round)
      {
        Bisection bisection(fine, fine.vertices);
        const double radius = 0.5 * std::pow(0.7, round);
        for (std::size_t c = 0; c < fine.cells.size(); ++c)
          for (const unsigned int v : fine.cell_vertices(c))
            if (fine.vertices[v].distance(corner) < radius)
              bisection.mark(c);
        bisection.close();
        const std::size_t n_cells = bisection.n_cells();
        fine                      = bisection.refined(halfway);
        if (fine.cells.size() != n_cells)
          std::printf("  wrong number of cells\n");
      }
    return fine;
  }


  /** All edges of all cells are cut. */
  SerialMesh
  halved(const SerialMesh &mesh)
  {
    Bisection bisection(mesh, mesh.vertices);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      bisection.mark_all(c);
    bisection.close();
    return bisection.refined(halfway);
  }


  /** How far an affine function is off where it is halved with the edges: new vertices stand behind
   * the old ones. */
  void
  print_affine(const SerialMesh &coarse)
  {
    const auto u = [](const Point<3> &x) { return 0.3 + 2. * x[0] - x[1] + 0.7 * x[2]; };
    std::vector<double> values;
    for (const auto &x : coarse.vertices)
      values.push_back(u(x));
    Bisection bisection(coarse, coarse.vertices);
    for (std::size_t c = 0; c < coarse.cells.size(); c += 3)
      bisection.mark(c);
    bisection.close();
    const SerialMesh fine = bisection.refined([&](const Point<3> &a, const Point<3> &b) {
      values.push_back(0.5 * (u(a) + u(b)));
      return halfway(a, b);
    });
    double worst          = 0.;
    for (std::size_t v = 0; v < fine.vertices.size(); ++v)
      worst = std::max(worst, std::abs(values[v] - u(fine.vertices[v])));
    std::printf("an affine function passes over: %s\n", worst < 1e-14 ? "yes" : "no");
  }
} // namespace


int
main()
{
  MeshParameters parameters;
  parameters.cubes           = {{2, 4, 2}};
  parameters.size            = {1., 2., 1.};
  parameters.material_layers = {0.5, 1.5};
  const SerialMesh box       = box_mesh(parameters);
  print("box, one corner, 8 rounds", box, towards(box, {1., 2., 1.}, 8));
  print("box, inside, 8 rounds", box, towards(box, {0.45, 0.8, 0.55}, 8));
  print("box, all edges", box, halved(halved(box)));
  std::printf("  %zu cells out of %zu\n", halved(box).cells.size(), box.cells.size());
  print_affine(box);

  parameters.rectangle_size  = {1., 2.};
  parameters.squares         = {{2, 4}};
  const SerialMesh rectangle = rectangle_mesh(parameters);
  print("rectangle, one corner, 8 rounds", rectangle, towards(rectangle, {0., 0., 0.}, 8));
  print("rectangle, all edges", rectangle, halved(rectangle));
  std::printf("  %zu cells out of %zu\n", halved(rectangle).cells.size(), rectangle.cells.size());
  print_affine(rectangle);

  const SerialMesh cylinder = hollow_cylinder_mesh(parameters);
  print("hollow cylinder with flat facets, 8 rounds",
        cylinder,
        towards(cylinder, {0.3, 0., 0.}, 8));
}
