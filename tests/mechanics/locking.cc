// What must hold for bodies whose patches of cells resist to changes of volume, whatever the mesh:
// here boxes and rectangles with displaced inner vertices and a Poisson ratio of 0.499.

#include <supple/mechanics/volumetric_patches.h>
#include <supple/mesh/edge_middles.h>
#include <supple/mesh/mesh_generators.h>
#include <supple/mesh/patches.h>
#include <supple/mesh/refinement.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <random>

#include "driver/checks.h"
#include "driver/elastic_cells.h"

using namespace Supple;

namespace
{
  SerialMesh
  regular_mesh(const Geometry geometry, const bool quadratic)
  {
    MeshParameters parameters;
    parameters.rectangle_origin = {2., -1.};
    parameters.rectangle_size   = {1., 1.5};
    parameters.squares          = {{5, 7}};
    parameters.split            = MeshParameters::Split::alternating;
    parameters.size             = {1., 1.5, 1.};
    if (quadratic)
      parameters.cubes = {{2, 3, 2}};
    else
      parameters.cubes = {{3, 5, 3}};
    return geometry == Geometry::solid ? box_mesh(parameters) : rectangle_mesh(parameters);
  }


  /** Cells and patches of one process. */
  class PatchedBody
  {
  public:
    PatchedBody(const Geometry geometry,
                const VolumeMeasure measure,
                const double poisson,
                const bool quadratic = false)
      : dimension(geometry == Geometry::solid ? 3 : 2)
      , axisymmetric(geometry == Geometry::axisymmetric)
      , measure(measure)
    {
      SerialMesh mesh = regular_mesh(geometry, quadratic);
      move_inner_vertices(mesh);
      if (quadratic)
        add_middle_nodes(mesh);

      material               = {0., 1.5, 1.};
      material.lambda        = 2. * material.mu * poisson / (1. - 2. * poisson);
      const auto patch_of    = make_patches(mesh);
      const unsigned int n_p = *std::max_element(patch_of.begin(), patch_of.end()) + 1;
      std::vector<Cell> list, plain_list;
      std::vector<PatchCell> patch_cells;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          list.push_back(
            {mesh.cells[c], quadratic ? material.without_lambda() : material.deviatoric(), true});
          plain_list.push_back({mesh.cells[c], material, true});
          if (quadratic)
            {
              list.back().middles = plain_list.back().middles = middles_of_cell(mesh, c);
              patch_cells.push_back({{}, patch_of[c], material.lambda});
              continue;
            }
          const auto vertices = mesh.cell_vertices(c);
          patch_cells.push_back({{vertices.begin(), vertices.end()}, patch_of[c], material.bulk()});
        }
      const Section section{geometry, 0.4};
      const unsigned int n = positions.size();
      cells = std::make_unique<ElasticCells>(positions, n, list, true, 0., section, 1u, quadratic);
      plain =
        std::make_unique<ElasticCells>(positions, n, plain_list, true, 0., section, 1u, quadratic);
      patches =
        std::make_unique<VolumetricPatches>(*cells->cells,
                                            patch_cells,
                                            n,
                                            measure,
                                            std::make_shared<dealii::Utilities::MPI::Partitioner>(
                                              (quadratic ? 4 : 1) * n_p));
    }

    /** u = G x + t sin(...), in the plane if the body is. */
    Nodal
    displacement(const std::array<double, 9> &G, const double waves = 0.) const
    {
      Nodal u;
      for (const auto &x : positions)
        for (unsigned int i = 0; i < 3; ++i)
          u.push_back(i >= dimension
                        ? 0.
                        : G[3 * i] * x[0] + G[3 * i + 1] * x[1] + G[3 * i + 2] * x[2] +
                            waves * std::sin(3. * x[(i + 1) % dimension] + 2. * x[i] + i));
      return u;
    }

    void
    follow(const Nodal &u)
    {
      cells->update_rotations(RotationMethod::polar, u.data());
      patches->update(cells->rotations.current, u.data());
    }

    Nodal
    force(const Nodal &u) const
    {
      Nodal f(u.size());
      patches->subtract_force(u.data(), f.data());
      std::transform(f.begin(), f.end(), f.begin(), std::negate<>());
      cells->add_internal_force(u.data(), f);
      return f;
    }

    Nodal
    own_force(const Nodal &u)
    {
      follow(u);
      return force(u);
    }

    double
    own_energy(const Nodal &u)
    {
      follow(u);
      return cells->sums(u.data(), nullptr).elastic + patches->energy(u.data());
    }

    Nodal
    tangent_product(const Nodal &w) const
    {
      Nodal y(w.size());
      cells->add_frozen_product(w.data(), y.data());
      cells->add_turning_product(w.data(), y.data());
      patches->add_product(1., w.data(), y.data());
      return y;
    }

    const unsigned int dimension;
    const bool axisymmetric;
    const VolumeMeasure measure;
    IsotropicMaterial material;
    std::vector<std::array<double, 3>> positions;
    std::vector<bool> inner;
    std::unique_ptr<ElasticCells> cells, plain; ///< without and with resistance of their own
    std::unique_ptr<VolumetricPatches> patches;

  private:
    void
    move_inner_vertices(const SerialMesh &mesh)
    {
      std::map<unsigned int, bool> on_surface;
      for (const auto &face : mesh.boundary)
        for (const unsigned int v : mesh.face_vertices(face))
          on_surface[v] = true;
      std::mt19937 generator(1);
      std::uniform_real_distribution<> jitter(-0.05, 0.05);
      for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
        {
          inner.push_back(!on_surface[v]);
          positions.push_back({{mesh.vertices[v][0], mesh.vertices[v][1], mesh.vertices[v][2]}});
          for (unsigned int i = 0; i < dimension && inner.back(); ++i)
            positions.back()[i] += jitter(generator);
        }
    }

    /** Behind the vertices, in the middles of the moved edges. */
    void
    add_middle_nodes(SerialMesh &mesh)
    {
      add_middles(mesh, middle_of_edge);
      for (const auto &middle : mesh.middles)
        {
          const auto &[v, w] = middle.ends;
          positions.push_back({});
          for (unsigned int i = 0; i < 3; ++i)
            positions.back()[i] = 0.5 * (positions[v][i] + positions[w][i]);
          inner.push_back(is_inside(middle.place));
        }
    }

    static bool
    is_inside(const dealii::Point<3> &x)
    {
      constexpr std::array<double, 3> size = {{1., 1.5, 1.}};
      bool inside                          = true;
      for (unsigned int i = 0; i < 3; ++i)
        inside = inside && x[i] > 1e-9 && x[i] < size[i] - 1e-9;
      return inside;
    }

    static std::array<unsigned int, 6>
    middles_of_cell(const SerialMesh &mesh, const std::size_t cell)
    {
      std::array<unsigned int, 6> middles;
      const auto &nodes = mesh.cells[cell];
      for (unsigned int e = 0; e < 6; ++e)
        middles[e] = mesh.vertices.size() +
                     mesh.middle(nodes[tetrahedron_edges[e][0]], nodes[tetrahedron_edges[e][1]]);
      return middles;
    }
  };


  /** Rotation about an axis, in the plane that along z, minus the identity; by rows. */
  std::array<double, 9>
  rigid_rotation(const PatchedBody &body, const double angle)
  {
    const bool solid = body.dimension == 3;
    const Eigen::Vector3d axis(solid ? 1. / 3. : 0., solid ? 2. / 3. : 0., solid ? 2. / 3. : 1.);
    const Eigen::Matrix3d Q =
      Eigen::AngleAxisd(angle, axis).toRotationMatrix() - Eigen::Matrix3d::Identity();
    std::array<double, 9> G;
    for (unsigned int k = 0; k < 9; ++k)
      G[k] = Q(k / 3, k % 3);
    return G;
  }


  void
  test_patch(PatchedBody &body)
  {
    const Nodal u = body.displacement({{0.02, 0.01, -0.03, 0.015, -0.01, 0.02, 0.01, 0.005, 0.03}});
    const Nodal f = body.own_force(u);
    double inner = 0., boundary = 0.;
    for (std::size_t node = 0; node < body.positions.size(); ++node)
      for (unsigned int i = 0; i < body.dimension; ++i)
        (body.inner[node] ? inner : boundary) += f[3 * node + i] * f[3 * node + i];
    report("constant strain, inner forces over boundary forces",
           std::sqrt(inner / boundary),
           1e-12);

    const auto stress  = body.patches->mean_stress(u.data());
    const auto extreme = std::minmax_element(stress.begin(), stress.end());
    report("constant strain, spread of the mean stress",
           (*extreme.second - *extreme.first) / std::abs(*extreme.first),
           1e-11);

    double rigid = 0.;
    for (const double degrees : {10., 90., 179., 180.})
      rigid = std::max(rigid,
                       norm(body.own_force(
                         body.displacement(rigid_rotation(body, degrees * M_PI / 180.)))));
    report("rigid rotation, force over the bulk modulus", rigid / body.material.bulk(), 1e-13);
  }


  void
  test_energy(PatchedBody &body, const Nodal &u)
  {
    const Nodal f     = body.own_force(u);
    double difference = 0.;
    for (std::size_t dof = 0; dof < u.size(); dof += 7)
      {
        if (dof % 3 >= body.dimension)
          continue;
        const double h = 1e-5;
        Nodal up = u, down = u;
        up[dof] += h;
        down[dof] -= h;
        const double slope = (body.own_energy(up) - body.own_energy(down)) / (2. * h);
        difference         = std::max(difference, std::abs(slope - f[dof]));
      }
    report("force against differences of the energy", difference / norm(f), 1e-8);
  }


  void
  test_resultants(PatchedBody &body, const Nodal &u)
  {
    const Nodal f = body.own_force(u);
    double net = 0., moment = 0.;
    for (unsigned int i = 0; i < 3; ++i)
      {
        double sum = 0., turn = 0.;
        const unsigned int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        for (std::size_t node = 0; node < body.positions.size(); ++node)
          {
            const auto x = [&](const unsigned int d) {
              return body.positions[node][d] + u[3 * node + d];
            };
            sum += f[3 * node + i];
            turn += x(i1) * f[3 * node + i2] - x(i2) * f[3 * node + i1];
          }
        net    = std::max(net, std::abs(sum));
        moment = std::max(moment, std::abs(turn));
      }
    report("net force", net / norm(f), 1e-13);
    report("net moment", moment / norm(f), 1e-13);

    const double energy = body.own_energy(u);
    const auto Q        = rigid_rotation(body, 2.);
    Nodal turned        = u;
    for (std::size_t node = 0; node < body.positions.size(); ++node)
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          turned[3 * node + i] += Q[3 * i + j] * (body.positions[node][j] + u[3 * node + j]);
    report("change of the energy when the deformed body is turned",
           std::abs(body.own_energy(turned) / energy - 1.),
           1e-12);
  }


  /** Column by column, without z in the plane. */
  template <class Product>
  Eigen::MatrixXd
  dense(const PatchedBody &body, const Product &product)
  {
    const unsigned int dim = body.dimension, n = dim * body.positions.size();
    const auto place = [&](const unsigned int k) { return 3 * (k / dim) + k % dim; };
    Eigen::MatrixXd K(n, n);
    Nodal unit(3 * body.positions.size());
    for (unsigned int j = 0; j < n; ++j)
      {
        unit[place(j)]     = 1.;
        const Nodal column = product(unit);
        for (unsigned int i = 0; i < n; ++i)
          K(i, j) = column[place(i)];
        unit[place(j)] = 0.;
      }
    return K;
  }


  void
  test_tangent(PatchedBody &body, const Nodal &u)
  {
    const Nodal w  = body.displacement({{0.3, 0.1, 0.2, -0.4, 0.5, 0.1, 0.2, 0.2, -0.3}}, 0.4);
    const double h = 1e-6;
    Nodal up = u, down = u, error(u.size());
    for (std::size_t i = 0; i < u.size(); ++i)
      {
        up[i] += h * w[i];
        down[i] -= h * w[i];
      }
    const Nodal f_up = body.own_force(up), f_down = body.own_force(down);
    body.follow(u);
    const auto set_tangent = [&](const Tangent tangent) {
      const MeanStress mean_stress{body.measure, body.patches->mean_stress(u.data())};
      body.cells->update_tangent(tangent, u.data(), &mean_stress);
    };
    set_tangent(Tangent::consistent);
    const Nodal product = body.tangent_product(w);
    for (std::size_t i = 0; i < u.size(); ++i)
      error[i] = (f_up[i] - f_down[i]) / (2. * h) - product[i];
    report("consistent tangent against differences of the force",
           norm(error) / norm(product),
           1e-7);

    const SymmetricPattern pattern = full_pattern(body.positions.size());
    body.cells->connect(pattern);
    SymmetricBlockMatrix A(pattern);
    body.cells->add_tangent(0., 1., 1., A);
    A.vmult(error.data(), w.data());
    body.patches->add_product(1., w.data(), error.data());
    for (std::size_t i = 0; i < u.size(); ++i)
      error[i] -= product[i];
    report("as a matrix and patches", norm(error) / norm(product), 1e-13);

    set_tangent(Tangent::definite);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
      dense(body, [&](const Nodal &x) { return body.tangent_product(x); }), Eigen::EigenvaluesOnly);
    report("definite tangent: smallest over largest eigenvalue, with a minus sign",
           std::max(0., -eigen.eigenvalues().minCoeff() / eigen.eigenvalues().maxCoeff()),
           1e-13);
  }


  /** Modes of a free body at rest: six rigid ones, then softer ones than those of plain cells, but
   * not by much. */
  void
  test_modes(const bool quadratic)
  {
    std::printf("Modes of a free box %sat a Poisson ratio of 0.3\n",
                quadratic ? "of quadratic cells " : "");
    PatchedBody body(Geometry::solid, VolumeMeasure::trace, 0.3, quadratic);
    const Eigen::MatrixXd K = dense(body, [&](const Nodal &x) { return body.tangent_product(x); });
    const Eigen::MatrixXd K_plain = dense(body, [&](const Nodal &x) {
      Nodal y(x.size());
      body.plain->add_frozen_product(x.data(), y.data());
      return y;
    });
    const Eigen::MatrixXd M       = dense(body, [&](const Nodal &x) {
      Nodal y(x.size());
      body.cells->cells->add_mass_product(x.data(), y.data());
      return y;
    });
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(K, M), plain(K_plain, M);
    const Eigen::VectorXd cured = modes.eigenvalues(), locked = plain.eigenvalues();
    std::printf("  %ld rigid modes\n", (cured.array() < 1e-9 * cured[12]).count());
    double lowest = 1., highest = 0.;
    for (unsigned int k = 6; k < 18; ++k)
      {
        lowest  = std::min(lowest, cured[k] / locked[k]);
        highest = std::max(highest, cured[k] / locked[k]);
      }
    std::printf("  modes 7 to 18 against plain cells: within 15 %%: %s, never stiffer: %s\n",
                std::sqrt(lowest) > 0.85 ? "yes" : "no",
                highest <= 1. + 1e-9 ? "yes" : "no");
  }


  void
  test_patch_making()
  {
    std::printf("Patches of a box of two materials\n");
    MeshParameters parameters;
    parameters.cubes = {{4, 6, 4}};
    SerialMesh mesh  = box_mesh(parameters);
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      mesh.materials[c] = c % 96 < 48;
    const auto patch_of = make_patches(mesh);
    std::map<unsigned int, unsigned int> size, material;
    bool mixed = false;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      {
        ++size[patch_of[c]];
        mixed = mixed ||
                material.emplace(patch_of[c], mesh.materials[c]).first->second != mesh.materials[c];
      }
    unsigned int smallest = 1000, largest = 0;
    for (const auto &[patch, n] : size)
      {
        smallest = std::min(smallest, n);
        largest  = std::max(largest, n);
      }
    std::printf("  none has two materials: %s; at least four cells: %s; at most sixteen: %s\n",
                mixed ? "no" : "yes",
                smallest >= 4 ? "yes" : "no",
                largest <= 16 ? "yes" : "no");
    std::printf("  six to ten cells on average: %s\n",
                mesh.cells.size() > 6 * size.size() && mesh.cells.size() < 10 * size.size() ? "yes"
                                                                                            : "no");
  }
} // namespace


int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::map<Geometry, const char *> names = {{Geometry::solid, "Tetrahedra"},
                                                  {Geometry::plane_strain, "Plane strain"},
                                                  {Geometry::axisymmetric, "Axisymmetric"}};
  test_patch_making();
  test_modes(false);
  test_modes(true);
  for (const auto &[geometry, name] : names)
    for (const VolumeMeasure measure : {VolumeMeasure::trace, VolumeMeasure::determinant})
      {
        std::printf("%s, %s\n", name, measure == VolumeMeasure::trace ? "trace" : "determinant");
        PatchedBody body(geometry, measure, 0.499);
        if (!body.axisymmetric)
          test_patch(body);
        const auto bent = body.axisymmetric
                            ? std::array<double, 9>{{0.1, 0.05, 0., -0.2, -0.1, 0., 0., 0., 0.}}
                            : rigid_rotation(body, 1.);
        const Nodal u   = body.displacement(bent, 0.05);
        test_energy(body, u);
        if (!body.axisymmetric)
          test_resultants(body, u);
        test_tangent(body, u);
      }
  for (const VolumeMeasure measure : {VolumeMeasure::trace, VolumeMeasure::determinant})
    {
      std::printf("Quadratic tetrahedra, %s\n",
                  measure == VolumeMeasure::trace ? "trace" : "determinant");
      PatchedBody body(Geometry::solid, measure, 0.499, true);
      test_patch(body);
      const Nodal u = body.displacement(rigid_rotation(body, 1.), 0.03);
      test_energy(body, u);
      test_resultants(body, u);
      test_tangent(body, u);
    }
}
