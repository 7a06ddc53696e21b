// What must hold for every law of the list, whatever the deformation: here of single cells, a fifth
// of them inside out, and of a box of linear, quadratic, plane and axisymmetric cells.

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <sstream>

#include "driver/checks.h"
#include "driver/law_of_cells.h"

using namespace Supple;

namespace
{
  using Matrix   = Eigen::Matrix3d;
  using Tangent9 = Eigen::Matrix<double, 9, 9>;

  constexpr IsotropicMaterial material = {4., 1.5, 1.};
  constexpr double size                = 4. + 2. * 1.5;


  std::vector<std::string>
  names()
  {
    std::vector<std::string> list;
    std::istringstream text(names_of_laws());
    for (std::string name; std::getline(text, name, '|');)
      list.push_back(name);
    return list;
  }


  /** The cell of the corners 0, e_x, e_y, e_z: its gradients are those unit vectors, so that forces
   * and displacements of the last three nodes are the columns of P/6 and F - I. */
  struct UnitCell : LawOfCells
  {
    explicit UnitCell(const std::string &name)
      : LawOfCells(name,
                   {{{0., 0., 0.}}, {{1., 0., 0.}}, {{0., 1., 0.}}, {{0., 0., 1.}}},
                   {{{{0, 1, 2, 3}}, material, true}})
    {
    }

    static Nodal
    nodal(const Matrix &G)
    {
      Nodal u(12, 0.);
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int i = 0; i < 3; ++i)
          u[3 * (j + 1) + i] = G(i, j);
      return u;
    }

    static Matrix
    columns(const Nodal &f)
    {
      Matrix P;
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int i = 0; i < 3; ++i)
          P(i, j) = 6. * f[3 * (j + 1) + i];
      return P;
    }

    double
    density(const Matrix &F)
    {
      return 6. * energy(nodal(F - Matrix::Identity()));
    }

    Matrix
    stress(const Matrix &F)
    {
      return columns(force(nodal(F - Matrix::Identity())));
    }

    Tangent9
    second_derivative(const Matrix &F, const Tangent kind)
    {
      update_tangent(nodal(F - Matrix::Identity()), kind);
      Tangent9 K;
      for (unsigned int c = 0; c < 9; ++c)
        {
          Matrix unit        = Matrix::Zero();
          unit(c % 3, c / 3) = 1.;
          const Matrix P     = columns(product(nodal(unit)));
          K.col(c)           = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(P.data());
        }
      return K;
    }
  };


  Matrix
  random_matrix(std::mt19937 &generator)
  {
    std::normal_distribution<> normal;
    return Matrix::NullaryExpr([&] { return normal(generator); });
  }


  Matrix
  random_rotation(std::mt19937 &generator)
  {
    const Matrix Q = random_matrix(generator).householderQr().householderQ();
    return Q.determinant() > 0. ? Q : Matrix(-Q);
  }


  /** Every fifth one inside out. */
  Matrix
  random_deformation(std::mt19937 &generator, const unsigned int k)
  {
    Matrix F = Matrix::Identity() + 0.4 * random_matrix(generator);
    if ((F.determinant() < 0.) != (k % 5 == 0))
      F.row(k % 3) *= -1.;
    return F;
  }


  /** The least sum of two stretches, the smallest of a cell inside out being negative: where it is
   * nothing rotations are not unique. */
  double
  least_sum(const Matrix &F)
  {
    const Eigen::Vector3d s = F.jacobiSvd().singularValues();
    return s[1] + (F.determinant() < 0. ? -s[2] : s[2]);
  }


  Eigen::VectorXd
  modes(const Tangent9 &K)
  {
    return Eigen::SelfAdjointEigenSolver<Tangent9>(K, Eigen::EigenvaluesOnly).eigenvalues();
  }


  void
  test_derivatives(const std::string &name)
  {
    UnitCell cell(name);
    std::mt19937 generator(1);
    double of_energy = 0., of_force = 0., asymmetry = 0., least = 0., same = 0.;
    constexpr double h      = 1e-5;
    unsigned int n_inverted = 0, n_definite = 0;
    for (unsigned int k = 0; k < 400; ++k)
      {
        const Matrix F = random_deformation(generator, k), D = random_matrix(generator);
        if (least_sum(F) < 0.05)
          continue;
        n_inverted += F.determinant() < 0.;
        const Matrix P      = cell.stress(F);
        const double change = (cell.density(F + h * D) - cell.density(F - h * D)) / (2. * h);
        of_energy           = std::max(of_energy,
                             std::abs(change - P.cwiseProduct(D).sum()) /
                               ((P.norm() + 1e-3 * size) * D.norm()));

        const Tangent9 K = cell.second_derivative(F, Tangent::consistent);
        const Matrix dP  = (cell.stress(F + h * D) - cell.stress(F - h * D)) / (2. * h);
        const auto of_D  = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(D.data());
        const auto of_P  = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(dP.data());
        of_force  = std::max(of_force, (of_P - K * of_D).norm() / ((K * of_D).norm() + size));
        asymmetry = std::max(asymmetry, (K - K.transpose()).norm() / K.norm());
        const Tangent9 D9  = cell.second_derivative(F, Tangent::definite);
        const double scale = D9.norm();
        least              = std::min(least, modes(D9).minCoeff() / scale);
        if (modes(K).minCoeff() > 1e-3 * scale)
          {
            ++n_definite;
            same = std::max(same, (D9 - K).norm() / scale);
          }
      }
    report("derivative of the energy", of_energy, 2e-7);
    report("derivative of the stress", of_force, 2e-7);
    report("asymmetry of the tangent", asymmetry, 1e-13);
    report("least mode of the definite tangent, from below", -least, 1e-13);
    report("definite ones where the exact one is definite", same, 1e-12);
    report_larger("inverted of 400", n_inverted, 60);
    report_larger("definite of 400", n_definite, 10);
  }


  void
  test_frames(const std::string &name)
  {
    UnitCell cell(name);
    std::mt19937 generator(2);
    double of_energy = 0., of_stress = 0., of_space = 0.;
    for (unsigned int k = 0; k < 200; ++k)
      {
        const Matrix F = random_deformation(generator, k), Q = random_rotation(generator);
        if (least_sum(F) < 0.05)
          continue;
        const Matrix P = cell.stress(F);
        const double W = cell.density(F);
        of_energy      = std::max(of_energy, std::abs(cell.density(Q * F) - W) / (W + size));
        of_stress = std::max(of_stress, (cell.stress(Q * F) - Q * P).norm() / (P.norm() + size));
        of_space  = std::max(of_space, (cell.stress(F * Q) - P * Q).norm() / (P.norm() + size));
      }
    report("energy in another frame", of_energy, 1e-12);
    report("stress in another frame", of_stress, 1e-12);
    report("stress of a body turned at rest", of_space, 1e-12);
  }


  Matrix
  hooke(const Matrix &G)
  {
    const Matrix e = 0.5 * (G + G.transpose());
    return 2. * material.mu * e + material.lambda * e.trace() * Matrix::Identity();
  }


  void
  test_small_strains(const std::string &name)
  {
    UnitCell cell(name);
    std::mt19937 generator(3);
    double of_stress = 0., of_energy = 0., of_tangent = 0.;
    for (unsigned int k = 0; k < 20; ++k)
      {
        const Matrix G = random_matrix(generator), I = Matrix::Identity();
        const double h   = 1e-5;
        const Matrix P   = (cell.stress(I + h * G) - cell.stress(I - h * G)) / (2. * h);
        const double W   = 0.5 * hooke(G).cwiseProduct(G).sum();
        const double own = 0.5 * (cell.density(I + h * G) + cell.density(I - h * G)) / (h * h);
        of_stress        = std::max(of_stress, (P - hooke(G)).norm() / hooke(G).norm());
        of_energy        = std::max(of_energy, std::abs(own / W - 1.));
      }
    const Tangent9 K = cell.second_derivative(Matrix::Identity(), Tangent::consistent);
    for (unsigned int c = 0; c < 9; ++c)
      {
        Matrix unit        = Matrix::Zero();
        unit(c % 3, c / 3) = 1.;
        const Matrix P     = hooke(unit);
        of_tangent =
          std::max(of_tangent,
                   (K.col(c) - Eigen::Map<const Eigen::Matrix<double, 9, 1>>(P.data())).norm());
      }
    report("small strains: stress of Hooke's law", of_stress, 1e-8);
    report("small strains: its energy", of_energy, 1e-7);
    report("at rest: its tangent", of_tangent / size, 1e-14);
    report("at rest: stress", cell.stress(Matrix::Identity()).norm() / size, 1e-15);
  }


  /** Flat, mirrored and far away. */
  void
  test_extremes(const std::string &name)
  {
    UnitCell cell(name);
    Matrix flat = Matrix::Identity(), line = Matrix::Zero();
    flat(2, 2)           = 0.;
    line(0, 0)           = 1.;
    unsigned int n_wrong = 0;
    for (const Matrix &F : {Matrix(Matrix::Zero()),
                            flat,
                            line,
                            Matrix(-Matrix::Identity()),
                            Matrix(1e4 * Matrix::Identity()),
                            Matrix(1e-9 * Matrix::Identity())})
      n_wrong += !(std::isfinite(cell.density(F)) && cell.stress(F).allFinite() &&
                   cell.second_derivative(F, Tangent::consistent).allFinite() &&
                   cell.second_derivative(F, Tangent::definite).allFinite());
    report("deformations without finite numbers", n_wrong, 0.);
  }


  /** A body of any kind of cells: force and energy, tangent and force, matrix and products. */
  void
  test_body(LawOfCells &body, const char *kind)
  {
    std::mt19937 generator(4);
    std::normal_distribution<> normal;
    Nodal u(body.n_dofs()), w(body.n_dofs()), f(body.n_dofs());
    for (std::size_t dof = 0; dof < u.size(); ++dof)
      if (body.is_free(dof))
        {
          u[dof] = 0.03 * normal(generator);
          w[dof] = normal(generator);
        }
    constexpr double h = 1e-6;
    const auto moved   = [&](const double by) {
      Nodal x = u;
      for (std::size_t dof = 0; dof < x.size(); ++dof)
        x[dof] += by * w[dof];
      return x;
    };
    const auto dot = [](const Nodal &a, const Nodal &b) {
      return std::inner_product(a.begin(), a.end(), b.begin(), 0.);
    };
    const Nodal force   = body.force(u);
    const double change = (body.energy(moved(h)) - body.energy(moved(-h))) / (2. * h);
    std::printf("  %s:\n", kind);
    report("  force and energy", std::abs(change / dot(force, w) - 1.), 2e-7);

    const Nodal above = body.force(moved(h)), below = body.force(moved(-h));
    body.update_tangent(u, Tangent::consistent);
    const Nodal Kw = body.product(w);
    double stray   = 0.;
    for (std::size_t dof = 0; dof < u.size(); ++dof)
      if (body.is_free(dof))
        stray = std::max(stray, std::abs((above[dof] - below[dof]) / (2. * h) - Kw[dof]));
    report("  tangent and force", stray / norm(Kw), 2e-7);
    report("  matrix and product", body.matrix_stray(w, Kw), 1e-13);
    body.update_tangent(u, Tangent::definite);
    report("  matrix and product, definite", body.matrix_stray(w, body.product(w)), 1e-13);
    report_larger("  definite energy of a change", dot(body.product(w), w), 0.);
  }


  void
  test_bodies(const std::string &name)
  {
    for (const BodyOfLaw kind : {BodyOfLaw::linear,
                                 BodyOfLaw::quadratic,
                                 BodyOfLaw::plane_strain,
                                 BodyOfLaw::axisymmetric})
      {
        const char *const words[] = {"linear cells",
                                     "quadratic cells",
                                     "plane strain",
                                     "axisymmetric"};
        LawOfCells body           = body_of_law(name, kind, material);
        test_body(body, words[static_cast<unsigned int>(kind)]);
      }
  }
} // namespace


int
main()
{
  for (const std::string &name : names())
    {
      std::printf("%s\n", name.c_str());
      test_derivatives(name);
      test_frames(name);
      test_small_strains(name);
      test_extremes(name);
      if (name != "corotational")
        test_bodies(name);
    }
}
