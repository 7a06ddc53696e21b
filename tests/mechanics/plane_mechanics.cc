// What must hold for the triangles of plane bodies whatever the mesh: here a rectangle with
// displaced inner vertices, in plane strain, plane stress and around an axis.

#include <supple/mesh/mesh_generators.h>
#include <supple/mesh/serial_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "driver/checks.h"
#include "driver/elastic_cells.h"

using namespace Supple;

namespace
{
  /** [2, 3] x [-1, 0.5], for plane stress and plane strain 0.4 thick. */
  struct JitteredRectangle
  {
    std::vector<std::array<double, 3>> positions;
    std::vector<Cell> cells;
    std::vector<bool> inner;
    Section section;

    const double lambda = 2., mu = 1.5, density = 3.;

    explicit JitteredRectangle(const Geometry geometry)
    {
      section.geometry  = geometry;
      section.thickness = geometry == Geometry::axisymmetric ? 1. : 0.4;

      MeshParameters parameters;
      parameters.rectangle_origin = {2., -1.};
      parameters.rectangle_size   = {1., 1.5};
      parameters.squares          = {{5, 7}};
      parameters.split            = MeshParameters::Split::alternating;
      const SerialMesh mesh       = rectangle_mesh(parameters);

      std::mt19937 generator(1);
      std::uniform_real_distribution<> jitter(-0.05, 0.05);
      for (const auto &vertex : mesh.vertices)
        {
          std::array<double, 3> x{{vertex[0], vertex[1], 0.}};
          const bool is_inner =
            x[0] > 2. + 1e-9 && x[0] < 3. - 1e-9 && x[1] > -1. + 1e-9 && x[1] < 0.5 - 1e-9;
          for (unsigned int i = 0; i < 2 && is_inner; ++i)
            x[i] += jitter(generator);
          inner.push_back(is_inner);
          positions.push_back(x);
        }
      for (const auto &nodes : mesh.cells)
        cells.push_back({nodes, {lambda, mu, density}, true});
    }

    ElasticCells
    triangles(const bool lumped = false) const
    {
      const unsigned int n_owned = positions.size();
      return ElasticCells(positions, n_owned, cells, lumped, 0., section);
    }

    /** u = G x + t sin(...) in the plane. */
    Nodal
    displacement(const std::array<double, 4> &G, const double waves = 0.) const
    {
      Nodal u;
      for (const auto &x : positions)
        {
          for (unsigned int i = 0; i < 2; ++i)
            u.push_back(G[2 * i] * x[0] + G[2 * i + 1] * x[1] +
                        waves * std::sin(3. * x[1 - i] + 2. * x[i] + i));
          u.push_back(0.);
        }
      return u;
    }

    Nodal
    force(const ElasticCells &triangles, const Nodal &u) const
    {
      Nodal f(u.size());
      triangles.add_internal_force(u.data(), f);
      return f;
    }

    double
    own_energy(ElasticCells &triangles, const RotationMethod method, const Nodal &u) const
    {
      triangles.update_rotations(method, u.data());
      return triangles.sums(u.data(), nullptr).elastic;
    }
  };


  /** Rotation minus the identity. */
  std::array<double, 4>
  turn(const double angle)
  {
    return {{std::cos(angle) - 1., -std::sin(angle), std::sin(angle), std::cos(angle) - 1.}};
  }


  std::vector<Matrix3<double>>
  rotation_cases()
  {
    std::mt19937 generator(2);
    std::normal_distribution<> normal;
    std::vector<Matrix3<double>> cases;
    const auto add = [&](const double a, const double b, const double c, const double d) {
      cases.push_back({{{a, b, 0., c, d, 0., 0., 0., 1.}}});
    };
    for (unsigned int n = 0; n < 2000; ++n)
      add(normal(generator), normal(generator), normal(generator), normal(generator));
    for (const double scale : {1e-300, 1e-160, 1e-10, 1., 1e160, 1e300})
      for (const double a : {-1., 0., 1.})
        for (const double d : {-1., 0., 1.})
          {
            add(a * scale, 0., 0., d * scale);
            add(0., a * scale, d * scale, 0.);
            add(a * scale, 0., 0., d);
          }
    add(std::nan(""), 1., 1., 1.);
    add(INFINITY, 1., 1., 1.);
    return cases;
  }


  void
  test_rotations()
  {
    std::printf("Rotations of 2000 random matrices and of extreme ones\n");
    for (const RotationMethod method : {RotationMethod::polar, RotationMethod::gram_schmidt})
      {
        double defect = 0., determinant_error = 0., trace_loss = 0., out_of_plane = 0.;
        for (const Matrix3<double> &F : rotation_cases())
          {
            Matrix3<Pack> packed;
            for (unsigned int k = 0; k < 9; ++k)
              packed.entries[k] = Pack(F.entries[k]);
            const Matrix3<Pack> rotated = rotation_in_plane(method, packed);
            Matrix3<double> R;
            for (unsigned int k = 0; k < 9; ++k)
              R.entries[k] = rotated.entries[k][n_lanes - 1];
            defect            = std::max(defect, std::sqrt(orthogonality_defect(R)));
            determinant_error = std::max(determinant_error, std::abs(determinant(R) - 1.));
            out_of_plane      = std::max(
              {out_of_plane, std::abs(R(0, 2)), std::abs(R(2, 1)), std::abs(R(2, 2) - 1.)});

            // The largest trace(R^T F) in the plane, over the size of F.
            const double size = std::max(
              {std::abs(F(0, 0)), std::abs(F(0, 1)), std::abs(F(1, 0)), std::abs(F(1, 1))});
            const double largest =
              std::hypot(F(0, 0) / size + F(1, 1) / size, F(1, 0) / size - F(0, 1) / size);
            if (std::isfinite(size) && size > 0.)
              trace_loss =
                std::max(trace_loss,
                         largest - (R(0, 0) * (F(0, 0) / size) + R(1, 0) * (F(1, 0) / size) +
                                    R(0, 1) * (F(0, 1) / size) + R(1, 1) * (F(1, 1) / size)));
          }
        std::printf("%s\n", method == RotationMethod::polar ? " polar" : " gram-schmidt");
        report("|R^T R - I|", defect, 1e-15);
        report("|det R - 1|", determinant_error, 1e-15);
        report("out of the plane", out_of_plane, 0.);
        if (method == RotationMethod::polar)
          report("short of the largest trace(R^T F) by", trace_loss, 1e-15);
      }
  }


  /** Constant strain that is in equilibrium: all around an axis without shear. */
  void
  test_patch(const JitteredRectangle &body)
  {
    const bool axisymmetric       = body.section.axisymmetric();
    const std::array<double, 4> G = axisymmetric
                                      ? std::array<double, 4>{{0.02, 0., 0., -0.03}}
                                      : std::array<double, 4>{{0.02, 0.01, 0.015, -0.03}};
    for (const RotationMethod method : {RotationMethod::none, RotationMethod::polar})
      {
        ElasticCells triangles = body.triangles();
        const Nodal u          = body.displacement(G);
        if (method != RotationMethod::none)
          triangles.update_rotations(method, u.data());
        const Nodal f = body.force(triangles, u);
        double inner = 0., boundary = 0.;
        for (std::size_t dof = 0; dof < f.size(); ++dof)
          (body.inner[dof / 3] ? inner : boundary) += f[dof] * f[dof];
        report("inner forces over boundary forces", std::sqrt(inner / boundary), 1e-13);

        double low = 1e300, high = 0.;
        for (const CellState &state : triangles.states(u.data()))
          {
            low  = std::min(low, state.von_mises_stress);
            high = std::max(high, state.von_mises_stress);
          }
        const ElasticCells::Sums sums = triangles.sums(u.data(), nullptr);
        std::printf(
          "  von Mises stress %.10f, spread at most 1e-12: %s; volume ratio %.10f, energy %.10f\n",
          high,
          high - low <= 1e-12 * high ? "yes" : "no",
          sums.max_volume_ratio,
          sums.elastic);
      }
  }


  void
  test_rigid_motion(const JitteredRectangle &body)
  {
    double force = 0., volume = 0., angle_error = 0., energy = 0.;
    ElasticCells triangles = body.triangles();
    const Nodal bent       = body.displacement({{0.1, 0.2, 0.3, 0.1}}, 0.2);
    const double before    = body.own_energy(triangles, RotationMethod::polar, bent);
    for (const double degrees : {10., 50., 90., 135., 179., 180., 270., 359.})
      {
        const auto Q  = turn(degrees * M_PI / 180.);
        const Nodal u = body.displacement(Q);
        for (const RotationMethod method : {RotationMethod::gram_schmidt, RotationMethod::polar})
          {
            triangles.update_rotations(method, u.data());
            force = std::max(force, norm(body.force(triangles, u)));
          }
        const ElasticCells::Sums sums = triangles.sums(u.data(), nullptr);
        volume                        = std::max(
          {volume, std::abs(sums.max_volume_ratio - 1.), std::abs(sums.min_volume_ratio - 1.)});
        for (const CellState &state : triangles.states(u.data()))
          angle_error =
            std::max(angle_error,
                     std::abs(state.rotation_angle - std::min(degrees, 360. - degrees)));

        Nodal turned = bent;
        for (std::size_t node = 0; node < body.positions.size(); ++node)
          for (unsigned int i = 0; i < 2; ++i)
            for (unsigned int j = 0; j < 2; ++j)
              turned[3 * node + i] += Q[2 * i + j] * (body.positions[node][j] + bent[3 * node + j]);
        energy =
          std::max(energy,
                   std::abs(body.own_energy(triangles, RotationMethod::polar, turned) / before -
                            1.));
      }
    report("force of a turned body", force, 1e-12);
    report("change of its volume", volume, 1e-12);
    report("error of the rotation angle in degrees", angle_error, 1e-5);
    report("change of the energy of a deformed body that is turned", energy, 1e-13);
  }


  void
  test_energy(const JitteredRectangle &body)
  {
    for (const bool inverted : {false, true})
      {
        // Inverted: mirrored at the line y = 0, with waves so that no cell is a mere reflection.
        const Nodal u          = inverted ? body.displacement({{0.2, 0.3, 0., -2.3}}, 0.1)
                                          : body.displacement(turn(1.), 0.15);
        ElasticCells triangles = body.triangles();
        triangles.update_rotations(RotationMethod::polar, u.data());
        const unsigned int n_inverted = triangles.sums(u.data(), nullptr).inverted;
        const Nodal f                 = body.force(triangles, u);
        double difference             = 0.;
        for (std::size_t dof = 0; dof < u.size(); ++dof)
          {
            if (dof % 3 == 2)
              continue;
            const double h = 1e-5;
            Nodal up = u, down = u;
            up[dof] += h;
            down[dof] -= h;
            const double slope = (body.own_energy(triangles, RotationMethod::polar, up) -
                                  body.own_energy(triangles, RotationMethod::polar, down)) /
                                 (2. * h);
            difference = std::max(difference, std::abs(slope - f[dof]));
          }
        std::printf(" largely deformed, %u of %zu cells inverted\n", n_inverted, body.cells.size());
        report("polar force against differences of the energy",
               difference / norm(f),
               inverted ? 1e-7 : 1e-8);

        double along_x = 0., along_y = 0., moment = 0.;
        for (std::size_t node = 0; node < body.positions.size(); ++node)
          {
            const double *force = &f[3 * node];
            along_x += force[0];
            along_y += force[1];
            moment += (body.positions[node][0] + u[3 * node]) * force[1] -
                      (body.positions[node][1] + u[3 * node + 1]) * force[0];
          }
        report("net force along y", std::abs(along_y) / norm(f), 1e-13);
        if (!body.section.axisymmetric())
          {
            report("net force along x", std::abs(along_x) / norm(f), 1e-13);
            report("net moment", std::abs(moment) / norm(f), 1e-13);
          }
      }
  }


  void
  test_operator(const JitteredRectangle &body)
  {
    const Nodal u = body.displacement(turn(0.7), 0.1);
    const Nodal w = body.displacement({{0.3, 0.1, 0.2, -0.4}}, 0.4);
    for (const bool lumped : {false, true})
      {
        ElasticCells triangles = body.triangles(lumped);
        triangles.update_rotations(RotationMethod::polar, u.data());
        Nodal product(u.size()), error(u.size()), shifted = u;
        triangles.add_frozen_product(w.data(), product.data());
        std::transform(u.begin(), u.end(), w.begin(), shifted.begin(), std::plus<>());
        const Nodal f0 = body.force(triangles, u), f1 = body.force(triangles, shifted);
        for (std::size_t i = 0; i < u.size(); ++i)
          error[i] = f1[i] - f0[i] - product[i];
        report("K' w against differences of the force", norm(error) / norm(product), 1e-13);

        const SymmetricPattern pattern = full_pattern(body.positions.size());
        triangles.connect(pattern);
        SymmetricBlockMatrix A(pattern);
        triangles.add_tangent(2., 3., 3., A);
        Nodal by_matrix(u.size()), mass(u.size());
        A.vmult(by_matrix.data(), w.data());
        triangles.cells->add_mass_product(w.data(), mass.data());
        for (std::size_t i = 0; i < u.size(); ++i)
          error[i] = by_matrix[i] - 2. * mass[i] - 3. * product[i];
        report(lumped ? "2 M + 3 K' as a matrix, lumped mass"
                      : "2 M + 3 K' as a matrix, consistent mass",
               norm(error) / norm(by_matrix),
               1e-13);

        SymmetricScalarMatrix M(pattern);
        triangles.add_mass(M);
        M.vmult(by_matrix.data(), w.data());
        for (std::size_t i = 0; i < u.size(); ++i)
          error[i] = by_matrix[i] - mass[i];
        report("M as a matrix", norm(error) / norm(mass), 1e-13);
      }
  }


  /** Against integrals over the rectangle, the consistent ones exact: of density times v^2/2 for
   * v = (0, x), and of x in a load. */
  void
  test_mass(const JitteredRectangle &body)
  {
    const bool axisymmetric = body.section.axisymmetric();
    const double height = 1.5, factor = axisymmetric ? 2. * M_PI : 0.4;
    const auto moment = [&](const double power) { // integral of x^power over the body
      const double n = power + 1. + (axisymmetric ? 1. : 0.);
      return factor * height * (std::pow(3., n) - std::pow(2., n)) / n;
    };
    const Nodal rest(3 * body.positions.size()), v = body.displacement({{0., 0., 1., 0.}});
    for (const bool lumped : {false, true})
      {
        const ElasticCells triangles  = body.triangles(lumped);
        const ElasticCells::Sums sums = triangles.sums(rest.data(), v.data());
        std::vector<double> mass(body.positions.size());
        triangles.cells->add_nodal_mass(mass.data());
        double total = 0.;
        for (const double m : mass)
          total += m;
        report("mass", std::abs(total / (body.density * moment(0.)) - 1.), 1e-13);
        report("momentum along y",
               std::abs(sums.linear_momentum[1] / (body.density * moment(1.)) - 1.),
               1e-13);
        report("kinetic energy",
               std::abs(sums.kinetic / (0.5 * body.density * moment(2.)) - 1.),
               lumped ? 1e-2 : 1e-13);
      }
    Nodal load(rest.size());
    body.triangles().cells->add_load(v.data(), load.data());
    double along_y = 0.;
    for (std::size_t dof = 1; dof < load.size(); dof += 3)
      along_y += load[dof];
    report("load", std::abs(along_y / moment(1.) - 1.), 1e-13);
  }
} // namespace


int
main()
{
  test_rotations();
  for (const auto &[name, geometry] : {std::make_pair("Plane strain", Geometry::plane_strain),
                                       std::make_pair("Plane stress", Geometry::plane_stress),
                                       std::make_pair("Axisymmetric", Geometry::axisymmetric)})
    {
      std::printf("%s\n", name);
      const JitteredRectangle body(geometry);
      test_patch(body);
      if (geometry != Geometry::axisymmetric)
        test_rigid_motion(body);
      test_energy(body);
      test_operator(body);
      test_mass(body);
    }
}
