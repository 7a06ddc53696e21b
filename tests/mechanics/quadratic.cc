// What must hold for quadratic tetrahedra whatever the mesh: here a box with displaced inner
// vertices, with straight edges and with curved ones.

#include <supple/mechanics/quadratic_cells.h>
#include <supple/mesh/edge_middles.h>
#include <supple/mesh/mesh_generators.h>
#include <supple/mesh/refinement.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>

#include "driver/checks.h"
#include "driver/displacements.h"
#include "driver/elastic_cells.h"

using namespace Supple;

namespace
{
  using Matrix = std::array<double, 9>;


  /** Vertices first and middles behind them: so the nodes of a cell do not ascend, and a part of
   * the blocks stand in the matrix transposed. */
  struct QuadraticBox
  {
    SerialMesh mesh;
    std::vector<std::array<double, 3>> positions;
    std::vector<Cell> cells;
    std::vector<bool> inner;

    const double lambda = 2., mu = 1.5, density = 3.;

    explicit QuadraticBox(const bool curved)
    {
      MeshParameters parameters;
      parameters.size  = {1., 1.5, 1.};
      parameters.cubes = {{2, 3, 2}};
      mesh             = box_mesh(parameters);
      std::mt19937 generator(1);
      std::uniform_real_distribution<> jitter(-0.06, 0.06);
      for (auto &vertex : mesh.vertices)
        move(vertex, jitter, generator);
      add_middles(mesh, middle_of_edge);
      std::uniform_real_distribution<> bulge(-0.02, 0.02);
      for (auto &middle : mesh.middles)
        if (curved)
          move(middle.place, bulge, generator);
      for (const auto &vertex : mesh.vertices)
        add_node(vertex);
      for (const auto &middle : mesh.middles)
        add_node(middle.place);
      for (const auto &nodes : mesh.cells)
        {
          cells.push_back({nodes, {lambda, mu, density}, true});
          for (unsigned int e = 0; e < 6; ++e)
            cells.back().middles[e] =
              mesh.vertices.size() +
              mesh.middle(nodes[tetrahedron_edges[e][0]], nodes[tetrahedron_edges[e][1]]);
        }
    }

    static bool
    is_inner(const dealii::Point<3> &x)
    {
      return x[0] > 1e-9 && x[0] < 1. - 1e-9 && x[1] > 1e-9 && x[1] < 1.5 - 1e-9 && x[2] > 1e-9 &&
             x[2] < 1. - 1e-9;
    }

    static void
    move(dealii::Point<3> &x, std::uniform_real_distribution<> &distance, std::mt19937 &generator)
    {
      for (unsigned int i = 0; i < 3 && is_inner(x); ++i)
        x[i] += distance(generator);
    }

    void
    add_node(const dealii::Point<3> &x)
    {
      inner.push_back(is_inner(x));
      positions.push_back({{x[0], x[1], x[2]}});
    }

    ElasticCells
    all_cells(const bool lumped = false, const unsigned int n_threads = 1) const
    {
      const unsigned int n_owned = positions.size();
      return ElasticCells(positions, n_owned, cells, lumped, 0., Section(), n_threads, true);
    }

    Nodal
    displacement(const Matrix &G, const double waves = 0.) const
    {
      return wavy_displacement(positions, G, waves);
    }

    /** Numbers that look random. */
    Nodal
    direction(const double seed) const
    {
      Nodal w;
      for (std::size_t dof = 0; dof < 3 * positions.size(); ++dof)
        w.push_back(std::sin(seed + 1.7 * dof * dof));
      return w;
    }

    /** With the rotations of the same displacement. */
    Nodal
    force(ElasticCells &elastic, const Nodal &u) const
    {
      Nodal f(u.size());
      elastic.update_rotations(RotationMethod::polar, u.data());
      elastic.add_internal_force(u.data(), f);
      return f;
    }

    double
    energy(ElasticCells &elastic, const Nodal &u) const
    {
      elastic.update_rotations(RotationMethod::polar, u.data());
      return elastic.sums(u.data(), nullptr).elastic;
    }
  };


  const Matrix stretch = {{0.1, 0.05, 0., -0.02, -0.04, 0.03, 0., 0.06, 0.05}};


  Nodal
  moved(const Nodal &u, const double step, const Nodal &w)
  {
    Nodal result = u;
    for (std::size_t dof = 0; dof < u.size(); ++dof)
      result[dof] += step * w[dof];
    return result;
  }


  double
  product(const Nodal &a, const Nodal &b)
  {
    double sum = 0.;
    for (std::size_t dof = 0; dof < a.size(); ++dof)
      sum += a[dof] * b[dof];
    return sum;
  }


  double
  largest(const Nodal &v)
  {
    double value = 0.;
    for (const double x : v)
      value = std::max(value, std::abs(x));
    return value;
  }


  Nodal
  difference(const Nodal &a, const Nodal &b)
  {
    return moved(a, -1., b);
  }


  void
  test_shape_functions()
  {
    std::puts("Shape functions: derivatives sum up to nothing, products to their shares");
    double slopes = 0., shares = 0., whole = 0., lumped = 0.;
    for (unsigned int q = 0; q < Quadratic::n_points; ++q)
      for (unsigned int k = 0; k < 4; ++k)
        for (unsigned int l = 0; l < 4; ++l)
          {
            double sum = 0.; // over nodes of dN_a/dL_k - dN_a/dL_l
            for (unsigned int a = 0; a < Quadratic::n_nodes; ++a)
              sum += Quadratic::slope(a, k, q) - Quadratic::slope(a, l, q);
            slopes = std::max(slopes, std::abs(sum));
          }
    for (unsigned int a = 0; a < Quadratic::n_nodes; ++a)
      {
        double sum = 0.;
        for (unsigned int b = 0; b < Quadratic::n_nodes; ++b)
          sum += Quadratic::product(a, b);
        shares = std::max(shares, std::abs(sum - Quadratic::share(a, false)));
        whole += sum;
        lumped += Quadratic::share(a, true);
      }
    report("derivatives", slopes, 1e-15);
    report("row sums", shares, 1e-16);
    report("all", std::abs(whole - 1.), 1e-15);
    report("all, lumped", std::abs(lumped - 1.), 1e-15);
  }


  void
  test_states(const QuadraticBox &box, const bool curved)
  {
    ElasticCells elastic = box.all_cells();
    const Nodal bent     = box.displacement(stretch, 0.05);
    const double size    = largest(box.force(elastic, bent));

    report("rigid turn: force",
           largest(box.force(elastic, box.displacement(rigid_rotation(2.)))) / size,
           1e-13);
    report("rigid turn: energy",
           box.energy(elastic, box.displacement(rigid_rotation(2.))) / box.energy(elastic, bent),
           1e-14);

    Nodal f      = box.force(elastic, box.displacement(stretch));
    double inner = 0.;
    for (std::size_t node = 0; node < box.inner.size(); ++node)
      for (unsigned int i = 0; i < 3 && box.inner[node]; ++i)
        inner = std::max(inner, std::abs(f[3 * node + i]));
    // The rule of four points is inexact on curved cells, by the square of the bulge.
    report("constant stress: force at inner nodes", inner / largest(f), curved ? 0.05 : 1e-13);

    f = box.force(elastic, bent);
    std::array<double, 3> sum{}, moment{};
    double lever = 0.;
    for (std::size_t node = 0; node < box.positions.size(); ++node)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const auto x = [&](const unsigned int d) {
            return box.positions[node][d % 3] + bent[3 * node + d % 3];
          };
          const double part = x(i + 1) * f[3 * node + (i + 2) % 3];
          sum[i] += f[3 * node + i];
          moment[i] += part - x(i + 2) * f[3 * node + (i + 1) % 3];
          lever += std::abs(part);
        }
    report("sum of forces", largest({sum.begin(), sum.end()}) / size, 1e-13);
    report("net moment", largest({moment.begin(), moment.end()}) / lever, 1e-15);
  }


  void
  test_derivatives(const QuadraticBox &box)
  {
    ElasticCells elastic = box.all_cells();
    const Nodal u = box.displacement(stretch, 0.05), w = box.direction(1.);
    constexpr double h = 1e-6;
    const double slope =
      (box.energy(elastic, moved(u, h, w)) - box.energy(elastic, moved(u, -h, w))) / (2. * h);
    report("force and derivative of the energy",
           std::abs(slope / product(box.force(elastic, u), w) - 1.),
           1e-7);

    Nodal change =
      difference(box.force(elastic, moved(u, h, w)), box.force(elastic, moved(u, -h, w)));
    for (double &x : change)
      x /= 2. * h;
    elastic.update_rotations(RotationMethod::polar, u.data());
    elastic.update_tangent(Tangent::consistent, u.data());
    Nodal Kw(u.size());
    elastic.add_frozen_product(w.data(), Kw.data());
    elastic.add_turning_product(w.data(), Kw.data());
    report("tangent and derivative of the force", norm(difference(Kw, change)) / norm(Kw), 1e-7);
  }


  void
  test_matrices(const QuadraticBox &box)
  {
    const unsigned int n = box.positions.size();
    ElasticCells elastic = box.all_cells();
    const Nodal u = box.displacement(stretch, 0.05), w = box.direction(2.), z = box.direction(3.);
    elastic.update_rotations(RotationMethod::polar, u.data());
    elastic.update_tangent(Tangent::consistent, u.data());
    const SymmetricPattern pattern = full_pattern(n);
    elastic.connect(pattern);
    SymmetricBlockMatrix A(pattern);
    elastic.add_tangent(0.7, 0.5, 0.5, A);
    Nodal Aw(3 * n), Az(3 * n), products(3 * n);
    A.vmult(Aw.data(), w.data());
    A.vmult(Az.data(), z.data());
    elastic.add_frozen_product(w.data(), products.data());
    elastic.add_turning_product(w.data(), products.data());
    for (double &x : products)
      x *= 0.5;
    Nodal Mw(3 * n);
    elastic.cells->add_mass_product(w.data(), Mw.data());
    products = moved(products, 0.7, Mw);
    report("matrix and products", norm(difference(Aw, products)) / norm(Aw), 1e-14);
    report("symmetry", std::abs(product(Aw, z) / product(Az, w) - 1.), 1e-12);

    SymmetricScalarMatrix M(pattern);
    elastic.add_mass(M);
    Nodal product_of_matrix(3 * n);
    M.vmult(product_of_matrix.data(), w.data());
    report("mass matrix and product", norm(difference(product_of_matrix, Mw)) / norm(Mw), 1e-14);
  }


  /** P^T A P against its matrix, with P that gives middles the mean of their ends. */
  void
  test_vertices(const QuadraticBox &box, const bool lumped)
  {
    const unsigned int n = box.positions.size(), n_vertices = box.mesh.vertices.size();
    ElasticCells elastic = box.all_cells(lumped);
    const Nodal u        = box.displacement(stretch, 0.05);
    elastic.update_rotations(RotationMethod::polar, u.data());
    elastic.update_tangent(Tangent::definite, u.data());
    const SymmetricPattern on_nodes = full_pattern(n), on_vertices = full_pattern(n_vertices);
    elastic.connect(on_nodes);
    SymmetricBlockMatrix A(on_nodes), A_vertices(on_vertices);
    elastic.add_tangent(0.7, 0.5, 0.5, A);
    std::vector<std::uint32_t> number(n);
    for (std::uint32_t node = 0; node < n; ++node)
      number[node] = node;
    const CellSlots slots(*elastic.cells, on_vertices, number);
    elastic.law->add_vertex_tangent(elastic.rotations, 0.7, 0.5, 0.5, slots, A_vertices);

    Nodal w(box.direction(4.)), Aw(3 * n), restricted(3 * n_vertices), direct(3 * n_vertices);
    const auto middle = [&](const std::size_t m) { return 3 * (n_vertices + m); };
    for (std::size_t m = 0; m < box.mesh.middles.size(); ++m)
      for (unsigned int i = 0; i < 3; ++i)
        w[middle(m) + i] =
          0.5 * (w[3 * box.mesh.middles[m].ends[0] + i] + w[3 * box.mesh.middles[m].ends[1] + i]);
    A.vmult(Aw.data(), w.data());
    A_vertices.vmult(direct.data(), w.data());
    std::copy(Aw.begin(), Aw.begin() + 3 * n_vertices, restricted.begin());
    for (std::size_t m = 0; m < box.mesh.middles.size(); ++m)
      for (const std::size_t end : box.mesh.middles[m].ends)
        for (unsigned int i = 0; i < 3; ++i)
          restricted[3 * end + i] += 0.5 * Aw[middle(m) + i];
    report(lumped ? "matrix on the vertices, lumped" : "matrix on the vertices",
           norm(difference(restricted, direct)) / norm(direct),
           1e-14);
  }


  void
  test_masses(const QuadraticBox &box)
  {
    double volume = 0.;
    for (std::size_t cell = 0; cell < box.mesh.cells.size(); ++cell)
      volume += quadratic_volume(box.mesh, cell);
    report("volume", std::abs(volume / 1.5 - 1.), 1e-3);
    for (const bool lumped : {false, true})
      {
        const ElasticCells elastic = box.all_cells(lumped);
        std::vector<double> mass(box.positions.size());
        elastic.cells->add_nodal_mass(mass.data());
        double sum = 0., product_error = 0.;
        for (const double of_node : mass)
          sum += of_node;
        const Nodal one(3 * mass.size(), 1.);
        Nodal M1(one.size());
        elastic.cells->add_mass_product(one.data(), M1.data());
        for (std::size_t dof = 0; dof < one.size(); ++dof)
          product_error = std::max(product_error, std::abs(M1[dof] - mass[dof / 3]));
        report(lumped ? "mass, lumped" : "mass", std::abs(sum / (3. * volume) - 1.), 1e-14);
        report("masses of nodes", product_error, 1e-15);
      }
  }


  /** More threads than one change the order of sums alone. */
  void
  test_threads(const QuadraticBox &box)
  {
    ElasticCells alone = box.all_cells(), shared = box.all_cells(false, 2);
    const Nodal u = box.displacement(stretch, 0.05);
    const Nodal f = box.force(alone, u);
    report("force on two threads", norm(difference(f, box.force(shared, u))) / norm(f), 1e-14);
  }
} // namespace


int
main()
{
  test_shape_functions();
  for (const bool curved : {false, true})
    {
      const QuadraticBox box(curved);
      std::puts(curved ? "Curved edges" : "Straight edges");
      test_states(box, curved);
      test_derivatives(box);
      test_matrices(box);
      test_vertices(box, false);
      test_vertices(box, true);
      test_masses(box);
      test_threads(box);
    }
}
