// Contact of a body with tools: forces against differences of the barrier's energy, its tangent and
// the distances of all kinds of pairs against differences of forces and gradients, and ways that
// are safe.

#include <supple/forces/barrier.h>
#include <supple/forces/contact.h>
#include <supple/forces/forces.h>
#include <supple/forces/safe_way.h>
#include <supple/scene/read_scene.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <random>
#include <string>

#include "driver/checks.h"

using namespace Supple;

namespace
{
  const std::string cube   = R"(
    subsection Mesh
      set Shape     = box
      set Box size  = 1, 1, 1
      set Box cubes = 2, 2, 2
    end
)";
  const std::string square = R"(
    subsection Mesh
      set Shape             = rectangle
      set Rectangle size    = 1, 1
      set Rectangle squares = 2, 2
    end
)";
  const std::string table  = R"(
    subsection Tool floor
      set Shape    = plane
      set Position = 0; 0.02; 0
      set Normal   = 0.05, 1, 0
    end
)";
  const std::string ball   = R"(
    subsection Tool ball
      set Shape    = sphere
      set Radius   = 0.4
      set Position = 1.37; 0.6; 0
    end
)";

  std::string
  capsule(const std::string &position, const std::string &axis)
  {
    return "subsection Tool needle\n set Shape = capsule\n set Radius = 0.1\n set Position = " +
           position + "\n set Axis = " + axis + "\nend\n";
  }


  /** A body that is somewhat deformed, and tools. */
  struct Touched
  {
    explicit Touched(const std::string &text)
      : parameters(read(text))
      , mesh(make_mesh(parameters, MPI_COMM_WORLD))
      , body(mesh, parameters.material, 1, parameters.file)
      , forces(body,
               parameters.material,
               parameters.corotation,
               parameters.damping,
               parameters.loads,
               parameters.contact,
               parameters.tools,
               parameters.file)
      , configuration(body, forces.elastic().cell_law(), false)
      , contact(*forces.contact())
      , surface(body)
    {
      Vector &u                = configuration.state.displacement;
      const unsigned int n_dim = body.mesh.section.plane() ? 2 : 3;
      for (unsigned int node = 0; node < body.n_owned; ++node)
        for (unsigned int i = 0; i < n_dim; ++i)
          u.local_element(3 * node + i) = 0.01 * std::sin(5. * node + 2. * i);
    }

    static Parameters
    read(const std::string &text)
    {
      std::ofstream("touched.prm") << text << "subsection Contact\n set Reach = 0.05\n"
                                   << " set Stiffness = 1\n set Guard = 0.3\nend\n";
      return read_scene("touched.prm");
    }

    std::vector<ContactPair>
    pairs()
    {
      std::vector<PlacedTool> placed;
      for (const Tool &tool : contact.all_tools())
        placed.push_back(tool.placed(tool.pose(0.)));
      return find_pairs(surface, configuration.displacement().begin(), placed, 0.3);
    }

    const Parameters parameters;
    const Mesh mesh;
    const Body body;
    Forces forces;
    Configuration configuration;
    Contact &contact;
    ContactSurface surface;
  };


  /** How a pair may move, as a name. */
  std::string
  kind_of(const ContactPair &pair)
  {
    static const std::string parts[] = {"", "vertex", "edge", "face"};
    return parts[pair.part->n] + (pair.guards ? "" : " integrated") + ", " +
           std::to_string(pair.n_free) + (pair.is_flat ? " free, plane" : " free");
  }


  void
  test_force(Touched &touched)
  {
    Vector f;
    touched.body.initialize(f);
    touched.contact.add_force(touched.configuration, 0., f.begin());
    double difference = 0.;
    for (unsigned int dof = 0; dof < f.size(); ++dof)
      {
        const auto energy_at = [&](const double step) {
          touched.configuration.state.displacement.local_element(dof) += step;
          const double energy = touched.contact.energy(touched.configuration, 0.);
          touched.configuration.state.displacement.local_element(dof) -= step;
          return energy;
        };
        const double slope = (energy_at(1e-6) - energy_at(-1e-6)) / 2e-6;
        difference         = std::max(difference, std::abs(slope + f.local_element(dof)));
      }
    if (touched.body.mesh.section.plane())
      std::printf(" plane body\n");
    report_larger("  force", f.l2_norm(), 1e-6);
    report("  difference over force", difference / f.l2_norm(), 1e-6);

    // action and reaction, torque and all
    dealii::Tensor<1, 3> force, torque;
    for (unsigned int node = 0; node < touched.body.n_owned; ++node)
      {
        dealii::Tensor<1, 3> x(touched.body.position(node)), here;
        for (unsigned int i = 0; i < 3; ++i)
          {
            x[i] += touched.configuration.displacement().local_element(3 * node + i);
            here[i] = f.local_element(3 * node + i);
          }
        force += here;
        torque += dealii::cross_product_3d(x, here);
      }
    for (const ToolReport &tool : touched.contact.reports(touched.configuration))
      {
        force -= tool.force;
        torque -= tool.torque + dealii::cross_product_3d(tool.place, tool.force);
      }
    report("  sum of forces less that of tools", force.norm() / f.l2_norm(), 1e-12);
    report("  the same of torques", torque.norm() / f.l2_norm(), 1e-12);
  }


  /** Of each kind of pair the worst second derivative of a distance. */
  void
  test_distances(Touched &touched, std::map<std::string, double> &worst)
  {
    constexpr double h                   = 1e-6;
    const std::vector<ContactPair> pairs = touched.pairs();
    for (std::size_t p = 0; p < pairs.size(); ++p)
      {
        const ContactPair &pair = pairs[p];
        const PartMatrix matrix = second_derivative(pair);
        double difference       = 0.;
        bool same               = true;
        for (unsigned int k = 0; k < matrix.cols(); ++k)
          {
            Vector &u              = touched.configuration.state.displacement;
            const unsigned int dof = 3 * pair.part->nodes[k / 3] + k % 3;
            std::array<std::vector<double>, 2> gradients;
            for (unsigned int side = 0; side < 2; ++side)
              {
                u.local_element(dof) += side == 0 ? h : -h;
                const auto moved = touched.pairs();
                u.local_element(dof) -= side == 0 ? h : -h;
                same = same && moved.size() == pairs.size() && moved[p].part == pair.part &&
                       moved[p].n_free == pair.n_free;
                for (unsigned int l = 0; same && l < matrix.rows(); ++l)
                  gradients[side].push_back(moved[p].c[l / 3] * moved[p].normal[l % 3]);
              }
            for (unsigned int l = 0; same && l < matrix.rows(); ++l)
              difference =
                std::max(difference,
                         std::abs((gradients[0][l] - gradients[1][l]) / (2. * h) - matrix(l, k)));
          }
        if (same) // otherwise it is at a place where the kind changes
          {
            double &of_kind = worst[kind_of(pair)];
            of_kind         = std::max(of_kind, difference / std::max(1., matrix.norm()));
          }
      }
  }


  /** The tangent is that of the energy less its negative part, pair by pair. */
  void
  test_tangent(Touched &touched)
  {
    double negative = 0., missing = 0., rest = 0.;
    for (const ContactPair &pair : touched.pairs())
      {
        const Barrier barrier{pair.reach};
        const PartMatrix matrix = barrier_tangent(pair);
        Eigen::VectorXd gradient(matrix.rows());
        for (unsigned int k = 0; k < matrix.rows(); ++k)
          gradient[k] = pair.c[k / 3] * pair.normal[k % 3];
        const Eigen::MatrixXd whole =
          barrier.curvature(pair.gap) * gradient * gradient.transpose() +
          barrier.slope(pair.gap) * second_derivative(pair);
        const Eigen::VectorXd of_matrix =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues();
        const Eigen::VectorXd left =
          Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix - whole).eigenvalues();
        const double size = matrix.norm() + whole.norm() + 1e-300;
        negative          = std::max(negative, -of_matrix.minCoeff() / size);
        missing           = std::max(missing, -left.minCoeff() / size);
        rest = std::max(rest, std::abs((matrix * (matrix - whole)).norm()) / (size * size));
      }
    report("  negative part of the tangent", negative, 1e-12);
    report("  what it takes off is negative", missing, 1e-12);
    report("  and has nothing to do with the rest", rest, 1e-12);

    // add_product() against differences of the force along a way on which no pair bends
    Vector w, product, up, down;
    for (Vector *vector : {&w, &product, &up, &down})
      touched.body.initialize(*vector);
    for (unsigned int dof = 0; dof < w.size(); dof += 3)
      w.local_element(dof) = 1.; // a shift of the body: no edge turns
    touched.contact.update_tangent(Tangent::consistent, touched.configuration, 0., 1.);
    touched.contact.add_product(touched.configuration, {0., 0., 1.}, w.begin(), product.begin());
    for (const double sign : {1., -1.})
      {
        touched.configuration.state.displacement.add(sign * 1e-7, w);
        touched.contact.add_force(touched.configuration, 0., sign > 0. ? up.begin() : down.begin());
        touched.configuration.state.displacement.add(-sign * 1e-7, w);
      }
    down -= up;
    down *= 1. / 2e-7;
    report_larger("  w C w less w B'' w, over C w",
                  (product * w - down * w) / product.l2_norm(),
                  -1e-6);
  }


  /** Ways of vertices, edges and faces past tools that move and turn. */
  void
  test_safe_ways(const std::string &text)
  {
    const Touched touched(text);
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> number(-1., 1.);
    const auto arrow = [&](const double size) {
      return Arrow({size * number(generator), size * number(generator), size * number(generator)});
    };
    double least           = 1.;
    unsigned int n_cut     = 0;
    const Tool &tool       = touched.contact.all_tools()[0];
    const unsigned int max = tool.parameters.shape == ToolParameters::Shape::plane ? 1 : 3;
    for (unsigned int n = 0; n < 3000; ++n)
      {
        const SurfacePart part{1 + n % max, {}, 1., true, {}};
        const Pose from{arrow(0.3), arrow(1.)}, to{from.place + arrow(2.), from.turn + arrow(2.)};
        Corners x, way;
        for (unsigned int v = 0; v < 3; ++v)
          {
            x[v]   = arrow(1.);
            way[v] = arrow(2.);
          }
        const double first = gap_of(part, x, tool.placed(from));
        if (first <= 0.)
          continue;
        const double safe = safe_part(part, x, way, tool, from, to);
        n_cut += safe < 1.;
        for (unsigned int k = 0; k <= 50; ++k)
          {
            const double s = k * safe / 50.;
            Corners there  = x;
            for (unsigned int v = 0; v < 3; ++v)
              there[v] += s * way[v];
            least = std::min(least, gap_of(part, there, tool.placed(between(from, to, s))) / first);
          }
      }
    report_larger("  least gap on the way over that at first", least, 0.);
    report_larger("  ways that are cut", n_cut, 100);
  }
} // namespace


int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string slanted  = capsule("0.55; 1.075; 0.4", "0.3, 0.9, 0.2");
  const std::string lying    = capsule("-0.3; 1.07; 0.3", "1.5, 0.02, 0.45");
  const std::string in_plane = capsule("0.6; 1.075; 0", "0.3, 0.9, 0");

  std::printf("The barrier against differences\n");
  const Barrier barrier{0.3};
  double slope = 0., curvature = 0.;
  for (double gap = 0.01; gap < 0.4; gap += 0.013)
    {
      const double h = 1e-6;
      slope          = std::max(slope,
                       std::abs((barrier.value(gap + h) - barrier.value(gap - h)) / (2. * h) -
                                barrier.slope(gap)) /
                         (1. - barrier.slope(gap)));
      curvature      = std::max(curvature,
                           std::abs((barrier.slope(gap + h) - barrier.slope(gap - h)) / (2. * h) -
                                    barrier.curvature(gap)) /
                             (1. + barrier.curvature(gap)));
    }
  report("  slope", slope, 1e-7);
  report("  curvature", curvature, 1e-7);

  std::map<std::string, double> distances;
  for (const std::string &scene : {cube + table,
                                   cube + ball,
                                   cube + slanted,
                                   cube + lying,
                                   square + table,
                                   square + ball,
                                   square + in_plane})
    {
      Touched touched(scene);
      std::printf("The force of %s against differences of the energy\n",
                  touched.parameters.tools[0].name.c_str());
      test_force(touched);
      test_tangent(touched);
      test_distances(touched, distances);
    }
  std::printf("Second derivatives of distances against differences\n");
  for (const auto &[kind, difference] : distances)
    report(("  " + kind).c_str(), difference, 1e-6);

  for (const std::string &scene : {cube + table, cube + ball, cube + slanted})
    {
      std::printf("Safe ways\n");
      test_safe_ways(scene);
    }
}
