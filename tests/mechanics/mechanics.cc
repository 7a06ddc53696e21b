// What must hold for linear and corotational tetrahedra whatever the mesh: here a box with
// displaced inner vertices.

#include <supple/mesh/mesh_generators.h>
#include <supple/mesh/serial_mesh.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "driver/checks.h"
#include "driver/displacements.h"
#include "driver/elastic_cells.h"

using namespace Supple;

namespace
{
  struct JitteredBox
  {
    SerialMesh mesh;
    std::vector<std::array<double, 3>> positions;
    std::vector<Cell> cells;
    std::vector<bool> inner;

    const double lambda = 2., mu = 1.5, density = 3.;

    JitteredBox()
    {
      MeshParameters parameters;
      parameters.size  = {1., 1.5, 1.};
      parameters.cubes = {{3, 5, 3}};
      mesh             = box_mesh(parameters);

      std::mt19937 generator(1);
      std::uniform_real_distribution<> jitter(-0.06, 0.06);
      for (const auto &vertex : mesh.vertices)
        {
          std::array<double, 3> x{{vertex[0], vertex[1], vertex[2]}};
          const bool is_inner = x[0] > 1e-9 && x[0] < 1. - 1e-9 && x[1] > 1e-9 &&
                                x[1] < 1.5 - 1e-9 && x[2] > 1e-9 && x[2] < 1. - 1e-9;
          if (is_inner)
            for (double &coordinate : x)
              coordinate += jitter(generator);
          inner.push_back(is_inner);
          positions.push_back(x);
        }
      for (const auto &nodes : mesh.cells)
        cells.push_back({nodes, {lambda, mu, density}, true});
    }

    ElasticCells
    all_cells(const bool lumped = false, const double vertex_mass = 0.) const
    {
      const unsigned int n_owned = positions.size();
      return ElasticCells(positions, n_owned, cells, lumped, vertex_mass);
    }

    Nodal
    displacement(const std::array<double, 9> &G, const double waves = 0.) const
    {
      return wavy_displacement(positions, G, waves);
    }

    Nodal
    force(const ElasticCells &cells, const Nodal &u) const
    {
      Nodal f(u.size());
      cells.add_internal_force(u.data(), f);
      return f;
    }

    /** Force with the rotations of the same displacement. */
    Nodal
    own_force(ElasticCells &cells, const RotationMethod method, const Nodal &u) const
    {
      cells.update_rotations(method, u.data());
      return force(cells, u);
    }

    double
    own_energy(ElasticCells &cells, const RotationMethod method, const Nodal &u) const
    {
      cells.update_rotations(method, u.data());
      return cells.sums(u.data(), nullptr).elastic;
    }
  };


  /** x -> Q x for displacements: u -> Q (X + u) - X. */
  Nodal
  turned(const JitteredBox &box, const Nodal &u, const std::array<double, 9> &Q_minus_I)
  {
    Nodal result = u;
    for (std::size_t node = 0; node < box.positions.size(); ++node)
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          result[3 * node + i] += Q_minus_I[3 * i + j] * (box.positions[node][j] + u[3 * node + j]);
    return result;
  }


  std::vector<Matrix3<double>>
  rotation_cases()
  {
    std::mt19937 generator(2);
    std::normal_distribution<> normal;
    std::vector<Matrix3<double>> cases;
    for (unsigned int n = 0; n < 2000; ++n)
      {
        Matrix3<double> F;
        for (double &entry : F.entries)
          entry = normal(generator);
        cases.push_back(F);
      }
    const auto add_diagonal = [&](const double a, const double b, const double c) {
      Matrix3<double> F{};
      F(0, 0) = a;
      F(1, 1) = b;
      F(2, 2) = c;
      cases.push_back(F);
    };
    for (const double scale : {1e-200, 1e-160, 1e-10, 1., 1e10, 1e160, 1e200})
      {
        add_diagonal(scale, scale, scale);
        add_diagonal(-scale, -scale, scale);
        add_diagonal(scale, scale, -scale);
        add_diagonal(-scale, -scale, -scale);
        add_diagonal(scale, scale, 0.);
        add_diagonal(scale, 0., 0.);
        add_diagonal(scale, 1., 1.);
        add_diagonal(scale, 1., -1e-3);
      }
    add_diagonal(0., 0., 0.);
    add_diagonal(std::nan(""), 1., 1.);
    add_diagonal(INFINITY, 1., 1.);
    return cases;
  }


  void
  test_rotations()
  {
    std::printf("Rotations of 2000 random matrices and of extreme ones\n");
    const auto cases = rotation_cases();
    for (const RotationMethod method : {RotationMethod::polar, RotationMethod::gram_schmidt})
      {
        double defect = 0., determinant_error = 0., trace_loss = 0.;
        for (const Matrix3<double> &F : cases)
          {
            Matrix3<Pack> packed;
            for (unsigned int k = 0; k < 9; ++k)
              packed.entries[k] = Pack(F.entries[k]);
            const Matrix3<Pack> rotated = rotation(method, packed);
            Matrix3<double> R;
            for (unsigned int k = 0; k < 9; ++k)
              R.entries[k] = rotated.entries[k][n_lanes - 1];
            defect            = std::max(defect, std::sqrt(orthogonality_defect(R)));
            determinant_error = std::max(determinant_error, std::abs(determinant(R) - 1.));

            const double size = std::sqrt(norm_square(F));
            if (std::isfinite(size) && size > 0.)
              trace_loss = std::max(trace_loss,
                                    (trace(transposed_product(nearest_rotation(F), F)) -
                                     trace(transposed_product(R, F))) /
                                      size);
          }
        const bool polar = method == RotationMethod::polar;
        report(polar ? "  polar |R^T R - I|" : "  gram-schmidt |R^T R - I|", defect, 1e-10);
        report(polar ? "  polar |det R - 1|" : "  gram-schmidt |det R - 1|",
               determinant_error,
               1e-10);
        if (polar)
          report("  polar falls short of the largest trace(R^T F) / |F| by", trace_loss, 1e-10);
      }
  }


  void
  test_patch(const JitteredBox &box)
  {
    std::printf("Patch test: constant strain, inner forces over boundary forces\n");
    const std::array<double, 9> G = {{0.02, 0.01, -0.03, 0.015, -0.01, 0.02, 0.01, 0.005, 0.03}};
    for (const RotationMethod method : {RotationMethod::none, RotationMethod::polar})
      {
        ElasticCells cells = box.all_cells();
        const Nodal u      = box.displacement(G);
        if (method != RotationMethod::none)
          cells.update_rotations(method, u.data());
        const Nodal f = box.force(cells, u);
        double inner = 0., boundary = 0.;
        for (std::size_t node = 0; node < box.positions.size(); ++node)
          for (unsigned int i = 0; i < 3; ++i)
            (box.inner[node] ? inner : boundary) += f[3 * node + i] * f[3 * node + i];
        report(method == RotationMethod::none ? "  none" : "  polar",
               std::sqrt(inner / boundary),
               1e-13);

        // The same stress in all cells, and for linear elasticity the one of Hooke's law.
        const auto states = cells.states(u.data());
        double low = 1e300, high = 0.;
        for (const CellState &state : states)
          {
            low  = std::min(low, state.von_mises_stress);
            high = std::max(high, state.von_mises_stress);
          }
        std::printf("  von Mises stress %.10f, spread at most 1e-12: %s\n",
                    high,
                    high - low <= 1e-12 * high ? "yes" : "no");
      }
  }


  void
  test_rigid_rotation(const JitteredBox &box)
  {
    std::printf("Rigid rotation by 10 to 180 degrees\n");
    double polar = 0., gram_schmidt = 0., volume = 0., angle_error = 0.;
    for (const double degrees : {10., 50., 90., 135., 179., 180.})
      {
        const Nodal u      = box.displacement(rigid_rotation(degrees * M_PI / 180.));
        ElasticCells cells = box.all_cells();
        gram_schmidt =
          std::max(gram_schmidt, norm(box.own_force(cells, RotationMethod::gram_schmidt, u)));
        polar = std::max(polar, norm(box.own_force(cells, RotationMethod::polar, u)));
        const ElasticCells::Sums sums = cells.sums(u.data(), nullptr);
        volume                        = std::max(
          {volume, std::abs(sums.max_volume_ratio - 1.), std::abs(sums.min_volume_ratio - 1.)});
        for (const CellState &state : cells.states(u.data()))
          angle_error = std::max(angle_error, std::abs(state.rotation_angle - degrees));
      }
    report("  polar force", polar, 1e-12);
    report("  gram-schmidt force", gram_schmidt, 1e-12);
    report("  change of volume", volume, 1e-12);
    report("  error of the rotation angle in degrees", angle_error, 1e-5);
  }


  void
  test_resultants(const JitteredBox &box,
                  const Nodal &u,
                  const Nodal &f,
                  const RotationMethod method)
  {
    double net = 0., moment = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        double sum = 0., turn = 0.;
        const unsigned i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (std::size_t node = 0; node < box.positions.size(); ++node)
          {
            const auto x = [&](const unsigned int d) {
              return box.positions[node][d] + u[3 * node + d];
            };
            sum += f[3 * node + i];
            turn += x(i1) * f[3 * node + i2] - x(i2) * f[3 * node + i1];
          }
        net    = std::max(net, std::abs(sum));
        moment = std::max(moment, std::abs(turn));
      }
    report("  net force", net / norm(f), 1e-13);
    if (method == RotationMethod::polar)
      report("  net moment", moment / norm(f), 1e-13);
    else
      report_larger("  gram-schmidt net moment", moment / norm(f), 1e-4);
  }


  void
  test_turned(const JitteredBox &box, const Nodal &u, const RotationMethod method)
  {
    ElasticCells cells   = box.all_cells();
    const Nodal u_turned = turned(box, u, rigid_rotation(2.));
    const double energy  = box.own_energy(cells, method, u);
    report("  change of the energy when the deformed body is turned",
           std::abs(box.own_energy(cells, method, u_turned) / energy - 1.),
           1e-13);

    // The whole scene turned: body at rest and displacement.
    JitteredBox other = box;
    const Nodal rest  = turned(box, Nodal(u.size()), rigid_rotation(2.));
    Nodal moved       = u_turned;
    for (std::size_t dof = 0; dof < u.size(); ++dof)
      {
        other.positions[dof / 3][dof % 3] += rest[dof];
        moved[dof] -= rest[dof];
      }
    ElasticCells turned_cells = other.all_cells();
    const double change = std::abs(other.own_energy(turned_cells, method, moved) / energy - 1.);
    if (method == RotationMethod::polar)
      report("  change of the energy when the scene is turned", change, 1e-13);
    else
      report_larger("  gram-schmidt change of the energy when the scene is turned", change, 1e-4);
  }


  void
  test_energy(const JitteredBox &box)
  {
    std::printf("Force against differences of the elastic energy, largely deformed\n");
    const std::array<double, 9> G = rigid_rotation(1.);
    for (const RotationMethod method : {RotationMethod::polar, RotationMethod::gram_schmidt})
      {
        ElasticCells cells = box.all_cells();
        const Nodal u      = box.displacement(G, 0.15);
        const Nodal f      = box.own_force(cells, method, u);
        double difference  = 0.;
        for (std::size_t dof = 0; dof < u.size(); dof += 5)
          {
            const double h = 1e-5;
            Nodal up = u, down = u;
            up[dof] += h;
            down[dof] -= h;
            const double slope =
              (box.own_energy(cells, method, up) - box.own_energy(cells, method, down)) / (2. * h);
            difference = std::max(difference, std::abs(slope - f[dof]));
          }
        if (method == RotationMethod::polar)
          report("  polar force, difference over force", difference / norm(f), 1e-8);
        else
          report_larger("  gram-schmidt has no energy: difference over force",
                        difference / norm(f),
                        1e-4);
        test_resultants(box, u, f, method);
        test_turned(box, u, method);
      }
  }


  void
  test_stiffness(const JitteredBox &box)
  {
    std::printf("Operator against differences of the force with rotations held\n");
    const Nodal u      = box.displacement(rigid_rotation(0.7), 0.1);
    const Nodal w      = box.displacement({{0.3, 0.1, 0.2, -0.4, 0.5, 0.1, 0.2, 0.2, -0.3}}, 0.4);
    ElasticCells cells = box.all_cells();
    cells.update_rotations(RotationMethod::polar, u.data());

    Nodal product(u.size());
    cells.add_frozen_product(w.data(), product.data());
    Nodal shifted = u;
    std::transform(u.begin(), u.end(), w.begin(), shifted.begin(), std::plus<>());
    const Nodal f0 = box.force(cells, u), f1 = box.force(cells, shifted);
    Nodal error(u.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      error[i] = f1[i] - f0[i] - product[i];
    report("  K' w from the cells", norm(error) / norm(product), 1e-13);

    const SymmetricPattern pattern = full_pattern(box.positions.size());
    for (const bool lumped : {false, true})
      {
        ElasticCells massive = box.all_cells(lumped);
        massive.update_rotations(RotationMethod::polar, u.data());
        massive.connect(pattern);
        SymmetricBlockMatrix A(pattern);
        massive.add_tangent(2., 3., 3., A);
        Nodal by_matrix(u.size()), by_cells(u.size()), mass(u.size());
        A.vmult(by_matrix.data(), w.data());
        massive.cells->add_mass_product(w.data(), mass.data());
        for (std::size_t i = 0; i < u.size(); ++i)
          error[i] = by_matrix[i] - 2. * mass[i] - 3. * product[i];
        report(lumped ? "  2 M + 3 K' as a matrix, lumped mass"
                      : "  2 M + 3 K' as a matrix, consistent mass",
               norm(error) / norm(by_matrix),
               1e-13);

        SymmetricScalarMatrix M(pattern);
        massive.add_mass(M);
        M.vmult(by_matrix.data(), w.data());
        for (std::size_t i = 0; i < u.size(); ++i)
          error[i] = by_matrix[i] - mass[i];
        report("  M as a matrix", norm(error) / norm(mass), 1e-13);
      }
  }


  /** The smallest and the largest eigenvalue of K'. */
  std::pair<double, double>
  extreme_eigenvalues(ElasticCells &cells, const SymmetricPattern &pattern)
  {
    cells.connect(pattern);
    SymmetricBlockMatrix A(pattern);
    cells.add_tangent(0., 1., 1., A);
    const unsigned int n = 3 * pattern.n_owned;
    Eigen::MatrixXd K(n, n);
    Nodal unit(n), column(n);
    for (unsigned int j = 0; j < n; ++j)
      {
        unit[j] = 1.;
        A.vmult(column.data(), unit.data());
        for (unsigned int i = 0; i < n; ++i)
          K(i, j) = column[i];
        unit[j] = 0.;
      }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(K, Eigen::EigenvaluesOnly);
    return {eigen.eigenvalues().minCoeff(), eigen.eigenvalues().maxCoeff()};
  }


  void
  test_tangent(const JitteredBox &box)
  {
    std::printf("Consistent tangent against differences of the force with rotations that follow\n");
    const Nodal w = box.displacement({{0.3, 0.1, 0.2, -0.4, 0.5, 0.1, 0.2, 0.2, -0.3}}, 0.4);
    const SymmetricPattern pattern = full_pattern(box.positions.size());
    for (const double squeezed : {1.2, 0.7})
      {
        std::array<double, 9> G = rigid_rotation(0.7);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            G[3 * i + j] = squeezed * (G[3 * i + j] + (i == j)) - (i == j);
        const Nodal u      = box.displacement(G, 0.1);
        ElasticCells cells = box.all_cells();

        const double h = 1e-5;
        Nodal up = u, down = u, product(u.size()), error(u.size());
        for (std::size_t i = 0; i < u.size(); ++i)
          {
            up[i] += h * w[i];
            down[i] -= h * w[i];
          }
        const Nodal f_up   = box.own_force(cells, RotationMethod::polar, up);
        const Nodal f_down = box.own_force(cells, RotationMethod::polar, down);
        cells.update_rotations(RotationMethod::polar, u.data());
        cells.update_tangent(Tangent::consistent, u.data());
        cells.add_frozen_product(w.data(), product.data());
        cells.add_turning_product(w.data(), product.data());
        for (std::size_t i = 0; i < u.size(); ++i)
          error[i] = (f_up[i] - f_down[i]) / (2. * h) - product[i];
        report(squeezed > 1. ? "  stretched" : "  squeezed", norm(error) / norm(product), 1e-8);

        cells.connect(pattern);
        SymmetricBlockMatrix A(pattern);
        cells.add_tangent(0., 1., 1., A);
        A.vmult(error.data(), w.data());
        for (std::size_t i = 0; i < u.size(); ++i)
          error[i] -= product[i];
        report("  as a matrix", norm(error) / norm(product), 1e-13);

        const auto consistent = extreme_eigenvalues(cells, pattern);
        cells.update_tangent(Tangent::definite, u.data());
        const auto definite = extreme_eigenvalues(cells, pattern);
        report("  definite: smallest over largest eigenvalue, with a minus sign",
               std::max(0., -definite.first / definite.second),
               1e-13);
        if (squeezed < 1.)
          report_larger("  consistent: the same", -consistent.first / consistent.second, 1e-4);
      }
  }


  void
  test_momentum(const JitteredBox &box)
  {
    std::printf("Momenta and energy of a body that turns about the axis (1, 2, 3)\n");
    for (const bool lumped : {false, true})
      {
        const ElasticCells cells = box.all_cells(lumped);
        const Nodal v            = box.displacement({{0., -3., 2., 3., 0., -1., -2., 1., 0.}});
        const Nodal u(v.size());
        const ElasticCells::Sums sums = cells.sums(u.data(), v.data());
        std::printf("  %s: p %.10f %.10f %.10f, l %.10f %.10f %.10f, kinetic %.10f\n",
                    lumped ? "lumped" : "consistent",
                    sums.linear_momentum[0],
                    sums.linear_momentum[1],
                    sums.linear_momentum[2],
                    sums.angular_momentum[0],
                    sums.angular_momentum[1],
                    sums.angular_momentum[2],
                    sums.kinetic);
        std::vector<double> mass(box.positions.size());
        cells.cells->add_nodal_mass(mass.data());
        double total = 0.;
        for (const double m : mass)
          total += m;
        std::printf("  mass %.10f\n", total);
      }
  }
} // namespace


int
main()
{
  const JitteredBox box;
  test_rotations();
  test_patch(box);
  test_rigid_rotation(box);
  test_energy(box);
  test_stiffness(box);
  test_tangent(box);
  test_momentum(box);
}
