// The error in space by recovery: linear fields are recovered exactly in each material, uniform
// strain has no error, and the number of processes does not matter.

#include <supple/observe/probe_errors.h>
#include <supple/observe/space_error.h>
#include <supple/run/problem.h>
#include <supple/scene/read_scene.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <functional>

#include "driver/checks.h"

using namespace Supple;

namespace
{
  const MPI_Comm world = MPI_COMM_WORLD;


  bool
  is_first()
  {
    return dealii::Utilities::MPI::this_mpi_process(world) == 0;
  }


  void
  print(const char *text)
  {
    if (is_first())
      std::printf("%s\n", text);
  }


  void
  report_on_first(const char *what, const double value, const double limit)
  {
    const double largest = dealii::Utilities::MPI::max(value, world);
    if (is_first())
      report(what, largest, limit);
  }


  const std::string block = R"(
      subsection Mesh
        set Box size = 2, 1, 1
        set Box cubes = 6, 4, 3
        set Layers = 0.5, 0.5
        set Map = x + 0.06*sin(20*y + 9*z)*(x*(2-x) > 1e-9); y + 0.06*sin(8*x + 5*z)*(y*(1-y) > 1e-9); z
      end
      subsection Material
        set Young modulus = 1000
        set Poisson ratio = 0.3
        set By id = 1: 5000, 0.2, 1000
      end
      subsection Constraints
        set Clamped boundaries = 0
      end
)";

  const std::string plate = R"(
      subsection Mesh
        set Shape = rectangle
        set Rectangle origin = 1, 0
        set Rectangle size = 2, 1
        set Rectangle squares = 6, 4
        set Map = x + 0.06*sin(20*y)*(x < 2.999)*(x > 1.001); y + 0.06*sin(8*x)*(y*(1-y) > 1e-9); 0
      end
      subsection Material
        set Young modulus = 1000
        set Poisson ratio = 0.3
      end
      subsection Constraints
        set Clamped boundaries = 0
      end
)";


  Parameters
  scene(const std::string &text, const std::vector<std::string> &overrides = {})
  {
    if (is_first())
      std::ofstream("scene.prm") << text << "subsection Time\n set Problem = static\nend\n";
    MPI_Barrier(world);
    std::vector<Override> list;
    for (const std::string &override : overrides)
      list.push_back({override, "test"});
    const Parameters parameters = read_scene("scene.prm", list);
    MPI_Barrier(world);
    return parameters;
  }


  using Displacement = std::function<std::array<double, 3>(const dealii::Point<3> &)>;

  void
  displace(Problem &problem, const Displacement &displacement)
  {
    for (unsigned int node = 0; node < problem.body.n_owned; ++node)
      {
        const std::array<double, 3> u = displacement(problem.body.position(node));
        for (unsigned int i = 0; i < 3; ++i)
          problem.configuration.state.displacement.local_element(3 * node + i) = u[i];
      }
    problem.configuration.update_rotations(problem.effort);
  }


  double
  linear(const std::array<double, 3> &x, const unsigned int material, const unsigned int k)
  {
    return 3. + (1. + material) * k + (2. + k) * x[0] - (1. + 3. * material) * x[1] + k * x[2];
  }


  void
  test_recovery(const std::string &text)
  {
    const Problem problem(scene(text), world);
    const Body &body           = problem.body;
    const unsigned int n_nodes = body.cells->n_nodes;
    const Recovery recovery(body);
    std::vector<Octet> values(body.cell_nodes.size(), Octet{});
    for (std::size_t c = 0; c < values.size(); ++c)
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int k = 0; k < 8; ++k)
          values[c].lanes[k] +=
            linear(body.positions[body.cell_nodes[c][a]], body.cell_material[c], k) / n_nodes;
    const Recovery::Field field = recovery.recover(values);

    double difference = 0., mean = 0.;
    for (std::size_t c = 0; c < values.size(); ++c)
      {
        const Octet product = recovery.product(field, field, c);
        const Octet bias    = recovery.difference_at(field, c, 0);
        for (unsigned int k = 0; k < 8; ++k)
          {
            double sum = 0.;
            for (unsigned int a = 0; a < n_nodes; ++a)
              {
                const double value =
                  linear(body.positions[body.cell_nodes[c][a]], body.cell_material[c], k) -
                  values[c].lanes[k];
                sum += value * value * recovery.volume(c) / (n_nodes * (n_nodes + 1));
              }
            difference = std::max(difference, std::abs(product.lanes[k] / sum - 1.));
            mean = std::max(mean, std::abs(bias.lanes[k]) / std::sqrt(sum / recovery.volume(c)));
          }
      }
    report_on_first("integral of the square over the right one, difference from 1",
                    difference,
                    1e-11);
    report_on_first("mean of the difference", mean, 1e-12);
  }


  void
  test_uniform_strain()
  {
    const Displacement large = [](const auto &x) -> std::array<double, 3> {
      return {{0.3 * x[0] + 0.5 * x[1], 0.4 * x[0] - 0.2 * x[1] + 0.6 * x[2], 0.1 * x[2]}};
    };
    const Displacement flat = [](const auto &x) -> std::array<double, 3> {
      return {{0.02 * x[0] + 0.05 * x[1], 0.03 * x[0] - 0.04 * x[1], 0.}};
    };
    const Displacement round = [](const auto &x) -> std::array<double, 3> {
      return {{0.02 * x[0], -0.03 * x[1], 0.}};
    };
    const Displacement bent = [](const auto &x) -> std::array<double, 3> {
      return {{0.1 * x[0] * x[1], 0.2 * x[1] * x[1] - 0.1 * x[0] * x[2], 0.3 * x[1] * x[2]}};
    };
    struct Case
    {
      const char *name;
      std::string text;
      std::vector<std::string> overrides;
      Displacement displacement;
    };
    const std::string patches   = "Material/Volumetric locking cure=patches";
    const std::string quadratic = "Mesh/Order=2", straight = "Mesh/Map=x; y; z";
    for (const Case &one : std::vector<Case>{
           {"linear, two materials", block, {"Corotation/Rotation=none"}, large},
           {"corotational, two materials", block, {}, large},
           {"patches, trace", block, {patches, "Material/Volume change=trace"}, large},
           {"patches, determinant", block, {patches}, large},
           {"quadratic cells, two materials", block, {quadratic, straight}, large},
           {"quadratic cells, patches, determinant", block, {quadratic, straight, patches}, large},
           {"quadratic cells, linear strain",
            block,
            {quadratic, straight, "Corotation/Rotation=none"},
            bent},
           {"quadratic cells, linear strain, patches",
            block,
            {quadratic, straight, "Corotation/Rotation=none", patches},
            bent},
           {"plane strain", plate, {}, flat},
           {"plane strain, patches", plate, {patches, "Material/Poisson ratio=0.499"}, flat},
           {"plane stress", plate, {"Plane/Model=plane stress"}, flat},
           {"around an axis", plate, {"Plane/Model=axisymmetric"}, round}})
      {
        Problem problem(scene(one.text, one.overrides), world);
        displace(problem, one.displacement);
        SpaceError space_error(problem.configuration, problem.forces.elastic());
        const EnergyError &error = space_error.estimate();
        print(one.name);
        report_on_first("error in the energy norm", error.relative_norm(), 1e-12);
        report_on_first("error of the work", error.of_work(), 1e-12);
      }
  }


  EnergyError
  error_of_bent_block(const MPI_Comm communicator, const std::vector<std::string> &overrides)
  {
    Problem problem(scene(block, overrides), communicator);
    displace(problem, [](const auto &x) -> std::array<double, 3> {
      return {{0.1 * x[0] * x[1], -0.2 * x[0] * x[0], 0.1 * std::sin(3. * x[0]) * x[2]}};
    });
    SpaceError space_error(problem.configuration, problem.forces.elastic());
    return space_error.estimate();
  }


  void
  test_processes()
  {
    for (const bool patches : {false, true})
      {
        const std::vector<std::string> overrides = {patches
                                                      ? "Material/Volumetric locking cure=patches"
                                                      : "Material/Volumetric locking cure=none",
                                                    "Material/Poisson ratio=0.45"};
        const EnergyError all   = error_of_bent_block(world, overrides);
        const EnergyError alone = error_of_bent_block(MPI_COMM_SELF, overrides);
        print(patches ? "bent, patches: all processes beside each by itself"
                      : "bent: all processes beside each by itself");
        report_on_first("eta^2", std::abs(all.square / alone.square - 1.), 1e-12);
        report_on_first("error of the work", std::abs(all.of_work() / alone.of_work() - 1.), 1e-12);
        report_on_first("jumps over recovery",
                        std::abs(*all.lock_ratio / *alone.lock_ratio - 1.),
                        1e-12);
        if (is_first())
          std::printf("  energy norm %.10f, work %.10f, frequency %.10f, ratio %.10f\n",
                      all.relative_norm(),
                      all.of_work(),
                      all.of_frequency(),
                      *all.lock_ratio);
      }
  }
} // namespace


int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  print("A linear field in each of two materials, tetrahedra");
  test_recovery(block);
  print("A linear field, triangles");
  test_recovery(plate);
  print("Uniform strain");
  test_uniform_strain();
  print("Processes");
  test_processes();
}
