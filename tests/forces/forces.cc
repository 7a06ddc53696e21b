// Forces by their interface: against differences of their energies, in the operator, and in static
// equilibrium; among them a link between two vertices that share no cell, which the program has
// not.

#include <supple/mechanics/corotational.h>
#include <supple/mechanics/law_sweeps.h>
#include <supple/mechanics/selection.h>
#include <supple/observe/diagnostics.h>
#include <supple/scene/read_scene.h>
#include <supple/time/create_integrator.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>

#include "driver/checks.h"

using namespace Supple;

namespace
{
  /** A spring of no length at rest, and a damper beside it, between two nodes. */
  class Link : public Force
  {
  public:
    Link(const unsigned int one, const unsigned int other)
      : nodes{{one, other}}
    {
    }

    std::string
    name() const override
    {
      return "link";
    }

    EnergyAccount
    account() const override
    {
      return EnergyAccount::elastic;
    }

    bool
    is_load() const override
    {
      return false;
    }

    bool
    is_linear() const override
    {
      return true;
    }

    bool
    has_tangent() const override
    {
      return true;
    }

    void
    add_force(const Configuration &configuration, double, double *f) const override
    {
      pull(stiffness, configuration.displacement().begin(), f);
      if (configuration.state.has_velocity())
        pull(damping, configuration.velocity().begin(), f);
    }

    double
    energy(const Configuration &configuration, double) const override
    {
      return 0.5 * stiffness * square(configuration.displacement().begin());
    }

    /** So that it can be found in the balance. */
    double
    dissipated(const Configuration &, double) const override
    {
      return 3.;
    }

    double
    largest_step(const Configuration &, const Vector &) const override
    {
      ++asked;
      return 0.5;
    }

    void
    add_couplings(Couplings &pairs) const override
    {
      pairs.push_back(nodes);
    }

    void
    connect(const SymmetricPattern &pattern) override
    {
      place = pattern.position(std::max(nodes[0], nodes[1]), std::min(nodes[0], nodes[1]));
    }

    void
    add_product(const Configuration &,
                const TangentFactors &factors,
                const double *w,
                double *y) const override
    {
      pull(-factors.displacement * stiffness - factors.velocity * damping, w, y);
    }

    void
    add_tangent(const Configuration &,
                const TangentFactors &factors,
                SymmetricBlockMatrix &A) const override
    {
      const double k = factors.displacement * stiffness + factors.velocity * damping;
      for (unsigned int i = 0; i < 3; ++i)
        {
          for (const unsigned int node : nodes)
            A.diagonal[9 * node + 4 * i] += k;
          A.lower[9 * place + 4 * i] -= k;
        }
    }

    mutable unsigned int asked = 0;

  private:
    void
    pull(const double factor, const double *w, double *f) const
    {
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double difference = w[3 * nodes[1] + i] - w[3 * nodes[0] + i];
          f[3 * nodes[0] + i] += factor * difference;
          f[3 * nodes[1] + i] -= factor * difference;
        }
    }

    double
    square(const double *w) const
    {
      double sum = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        sum += std::pow(w[3 * nodes[1] + i] - w[3 * nodes[0] + i], 2);
      return sum;
    }

    static constexpr double stiffness = 2e5, damping = 300.;
    const std::array<unsigned int, 2> nodes;
    std::size_t place = 0;
  };


  Parameters
  scene(const std::string &time)
  {
    std::ofstream("scene.prm") << R"(
      subsection Mesh
        set Box size = 1, 2, 1
        set Box cubes = 2, 4, 2
      end
      subsection Material
        set Young modulus = 1e6
        set Density = 1000
      end
      subsection Constraints
        set Clamped boundaries = 2
      end
      subsection Loads
        set Gravity = 0; 0; -9.81*(1 + t)
        set Body force = 100; 0; 50*x
        set Traction = 0; 300; 0
        set Traction on = 3
        set Pressure = 500
        set Pressure on = 1
        set Pressure follows = false
      end
)" << time;
    return read_scene("scene.prm");
  }


  /** The parts of a problem, with a link between two corners. */
  struct LinkedBody
  {
    explicit LinkedBody(const Parameters &scene)
      : parameters(scene)
      , dynamic(parameters.time.problem == TimeParameters::Problem::dynamic)
      , mesh(make_mesh(parameters, MPI_COMM_WORLD))
      , body(mesh, parameters.material, 1, parameters.file)
      , constraints(body, parameters.constraints, parameters.motions, parameters.file)
      , forces(body,
               parameters.material,
               parameters.corotation,
               parameters.damping,
               parameters.loads,
               parameters.contact,
               parameters.tools,
               parameters.file)
      , link(add_link())
      , configuration(body, forces.elastic().cell_law(), dynamic)
      , A(body,
          constraints,
          forces,
          configuration,
          parameters.damping,
          parameters.corotation,
          dynamic,
          effort)
      , solver(LinearSolver::create(A,
                                    parameters.solver,
                                    parameters.time.matrix_use(),
                                    parameters.file,
                                    effort))
    {
    }

    Link &
    add_link()
    {
      const Selection selection(body);
      auto owned  = std::make_unique<Link>(selection.nearest_vertex({0., 2., 0.}).first,
                                          selection.nearest_vertex({1., 1., 1.}).first);
      Link &added = *owned;
      forces.add(std::move(owned));
      return added;
    }

    Model
    model()
    {
      return {body,
              constraints,
              forces,
              configuration,
              A,
              *solver,
              parameters.time,
              parameters.damping,
              parameters.material,
              parameters.file,
              effort};
    }

    void
    bend()
    {
      State &state = configuration.state;
      for (unsigned int node = 0; node < body.n_owned; ++node)
        {
          const auto x                                   = body.position(node);
          state.displacement.local_element(3 * node)     = 0.1 * std::sin(x[1]) * x[1];
          state.displacement.local_element(3 * node + 1) = -0.05 * x[0] * x[1];
          state.displacement.local_element(3 * node + 2) = 0.2 * x[1] * x[1];
          if (dynamic)
            for (unsigned int i = 0; i < 3; ++i)
              state.velocity.local_element(3 * node + i) = std::cos(3. * node + i) * x[1];
        }
      configuration.update_rotations(effort);
    }

    const Parameters parameters;
    const bool dynamic;
    Effort effort;
    const Mesh mesh;
    const Body body;
    const Constraints constraints;
    Forces forces;
    Link &link;
    Configuration configuration;
    ImplicitOperator A;
    const std::unique_ptr<LinearSolver> solver;
  };


  void
  test_energy()
  {
    std::printf("All forces against differences of the energy\n");
    LinkedBody linked(
      scene("subsection Damping\n set Mass factor = 0\n set Stiffness factor = 0\n"
            "end\nsubsection Time\n set Problem = static\nend\n"));
    linked.bend();
    Vector f;
    linked.body.initialize(f);
    linked.forces.set_force(f, linked.configuration, 1., linked.effort);
    double difference = 0.;
    for (unsigned int dof = 0; dof < f.size(); dof += 7)
      {
        const auto energy_at = [&](const double step) {
          linked.configuration.state.displacement.local_element(dof) += step;
          linked.configuration.update_rotations(linked.effort);
          const double energy = linked.forces.energy(linked.configuration, 1., 1.);
          linked.configuration.state.displacement.local_element(dof) -= step;
          return energy;
        };
        const double slope = (energy_at(1e-6) - energy_at(-1e-6)) / 2e-6;
        difference         = std::max(difference, std::abs(slope + f.local_element(dof)));
      }
    report("  difference over force", difference / f.l2_norm(), 1e-7);
  }


  void
  test_operator()
  {
    std::printf("The operator against differences of the forces, with rotations held\n");
    LinkedBody linked(
      scene("subsection Time\n set Method = implicit midpoint\nend\nsubsection Damping\n"
            " set Mass factor = 0.5\n set Stiffness factor = 0.01\nend\n"));
    linked.bend();
    const double gamma = 0.03, h = 1e-4, mass_factor = linked.parameters.damping.mass_factor;
    linked.forces.update_tangent(Tangent::frozen, linked.configuration, 0., linked.effort);
    linked.A.assemble(gamma);

    Vector w, product, expected, mass, up, down;
    for (Vector *vector : {&w, &product, &expected, &mass, &up, &down})
      linked.body.initialize(*vector);
    for (unsigned int dof = 0; dof < w.size(); ++dof)
      w.local_element(dof) = std::sin(1. + dof);
    linked.constraints.set_zero(w);
    linked.A.vmult(product, w);
    linked.A.mass_vmult(mass, w);

    // dt f/du and df/dv along gamma w and w
    State &state = linked.configuration.state;
    for (const double sign : {1., -1.})
      {
        state.displacement.add(sign * h * gamma, w);
        state.velocity.add(sign * h, w);
        linked.forces.set_force(sign > 0. ? up : down, linked.configuration, 0., linked.effort);
        state.displacement.add(-sign * h * gamma, w);
        state.velocity.add(-sign * h, w);
      }
    expected = down;
    expected -= up;
    expected *= gamma / (2. * h);
    expected.add(1. + gamma * mass_factor, mass);
    linked.constraints.set_zero(expected);
    expected -= product;
    report("  A w", expected.l2_norm() / product.l2_norm(), 1e-8);

    linked.A.stiffness_vmult(product, w);
    expected = 0.;
    linked.forces.add_product(linked.configuration, {0., 0., 1.}, w.begin(), expected.begin());
    linked.constraints.set_zero(expected);
    expected -= product;
    report("  K w", expected.l2_norm() / product.l2_norm(), 1e-12);
  }


  /** A body that pressure pushes on, in static equilibrium or on its way there. */
  Parameters
  pressed(const std::string &mesh, const std::string &pressure, const std::string &boundaries)
  {
    std::ofstream("pressed.prm") << mesh << R"(
      subsection Material
        set Young modulus = 1e6
      end
      subsection Time
        set Problem = static
      end
      subsection Loads
)"
                                 << "set Pressure = " << pressure
                                 << "\nset Pressure on = " << boundaries << "\nend\n";
    return read_scene("pressed.prm");
  }


  /** Along one direction: the operator, the derivative of the forces, and both as quadratic forms.
   */
  void
  compare_stiffness(const Parameters &parameters, const bool is_symmetric, const double part)
  {
    LinkedBody loaded(parameters);
    Vector w, product, from_matrix, expected, down;
    for (Vector *vector : {&w, &product, &from_matrix, &expected, &down})
      loaded.body.initialize(*vector);
    Vector &u                = loaded.configuration.state.displacement;
    const unsigned int n_dim = loaded.body.mesh.section.plane() ? 2 : 3;
    for (unsigned int node = 0; node < loaded.body.n_owned; ++node)
      for (unsigned int i = 0; i < n_dim; ++i)
        {
          u.local_element(3 * node + i) = 0.1 * std::sin(5. * node + 2. * i);
          w.local_element(3 * node + i) = std::cos(3. * node + i);
        }
    const auto forces_at = [&](const double step, Vector &f) {
      u.add(step, w);
      loaded.configuration.update_rotations(loaded.effort);
      loaded.forces.set_force(f, loaded.configuration, 1., loaded.effort, part);
      u.add(-step, w);
    };
    forces_at(1e-5, expected);
    forces_at(-1e-5, down);
    expected -= down;
    expected *= -1. / 2e-5;

    loaded.configuration.update_rotations(loaded.effort);
    loaded.forces.update_tangent(
      Tangent::consistent, loaded.configuration, 1., loaded.effort, part);
    loaded.forces.add_product(loaded.configuration, {0., 0., 1.}, w.begin(), product.begin());
    loaded.A.assemble_stiffness();
    loaded.A.vmult(from_matrix, w);
    from_matrix -= product;
    report("  matrix and product", from_matrix.l2_norm() / product.l2_norm(), 1e-12);
    report("  w K w", std::abs((product * w) / (expected * w) - 1.), 1e-7);
    expected -= product;
    const double difference = expected.l2_norm() / product.l2_norm();
    if (is_symmetric)
      report("  K w", difference, 1e-7);
    else
      report_larger("  K w, without its skew part", difference, 1e-4);
  }


  void
  test_stiffness_of_pressure()
  {
    std::printf("The operator with pressure that follows, against differences of the forces\n");
    const std::string box  = R"(
      subsection Mesh
        set Box size = 1, 2, 1
        set Box cubes = 2, 3, 2
      end
)";
    const std::string ring = R"(
      subsection Mesh
        set Shape = rectangle
        set Rectangle origin = 1, 0
        set Rectangle size = 1, 2
        set Rectangle squares = 2, 4
      end
      subsection Plane
        set Model = )";
    std::printf(" all around\n");
    compare_stiffness(pressed(box, "1e6", "0, 1, 2, 3, 4, 5"), true, 1.);
    std::printf(" all around, a part of it\n");
    compare_stiffness(pressed(box, "1e6", "0, 1, 2, 3, 4, 5"), true, 0.3);
    std::printf(" that varies, on two sides\n");
    compare_stiffness(pressed(box, "1e6*(1 + x*y + t)", "1, 3"), false, 1.);
    for (const std::string model : {"plane strain", "axisymmetric"})
      {
        std::printf(" all around, %s\n", model.c_str());
        compare_stiffness(pressed(ring + model + "\nend\n", "1e6", "0, 1, 2, 3"), true, 1.);
      }
  }


  void
  test_work_of_pressure()
  {
    std::printf("The work of pressure that follows, against many short ways\n");
    LinkedBody loaded(pressed("", "1e6*(1 + y)", "1, 3"));
    loaded.bend();
    Vector &u        = loaded.configuration.state.displacement;
    const Vector end = u;
    Vector start = end, loads = end;
    start *= -0.5;
    Vector way = end;
    way -= start;
    const double work    = loaded.forces.work_along(loaded.configuration, 1., start);
    const unsigned int n = 1000;
    double sum           = 0.;
    for (unsigned int k = 0; k < n; ++k)
      {
        u = start;
        u.add((k + 0.5) / n, way);
        loaded.forces.set_loads(loads, loaded.configuration, 1.);
        sum += (loads * way) / n;
      }
    report("  difference", std::abs(work / sum - 1.), 1e-6);
  }


  void
  test_equilibrium()
  {
    std::printf("Static equilibrium with the link\n");
    LinkedBody linked(
      scene("subsection Damping\n set Mass factor = 0\n set Stiffness factor = 0\n"
            "end\nsubsection Time\n set Problem = static\n set Steps = 2\nend\n"));
    const auto integrator = create_integrator(linked.model());
    Diagnostics diagnostics(linked.configuration, linked.forces, true);
    Measurement last = diagnostics.measure(0, 0., 0., StepReport());
    for (unsigned int step = 1; !integrator->finished(); ++step)
      {
        const StepReport step_report = integrator->advance(true);
        last                         = diagnostics.measure(step, step_report.time, 0., step_report);
        linked.configuration.accept();
      }
    Vector f, loads;
    linked.body.initialize(f);
    linked.body.initialize(loads);
    linked.forces.set_force(f, linked.configuration, 1., linked.effort);
    linked.forces.set_loads(loads, linked.configuration, 1.);
    linked.constraints.set_zero(f);
    report("  what is out of balance over the loads", f.l2_norm() / loads.l2_norm(), 1e-7);
    std::printf("  the link bounds corrections: %s\n", linked.link.asked > 1 ? "yes" : "no");

    std::printf("  dissipated in two steps %.6f\n", last.dissipated);
    const double all     = linked.forces.energy(linked.configuration, 1., 0.);
    const double of_link = linked.link.energy(linked.configuration, 1.);
    report("  elastic energy, the link's with it", std::abs(last.elastic / all - 1.), 1e-12);
    report_larger("  part of the link", of_link / all, 0.01);
  }


  /** Remembers two numbers of each cell. */
  class Remembering : public LawSweeps<Corotational>
  {
  public:
    using LawSweeps<Corotational>::LawSweeps;

    unsigned int
    n_internal_variables() const override
    {
      return 2;
    }
  };


  double
  difference(const Vector &a, const Vector &b)
  {
    Vector d = a;
    d -= b;
    return d.linfty_norm();
  }


  void
  test_configuration()
  {
    std::printf("What a configuration gives back\n");
    LinkedBody linked(scene(""));
    const Remembering law(Corotational{RotationMethod::polar}, *linked.body.cells);
    Configuration configuration(linked.body, law, true);
    const auto turn = [&](const double size) {
      for (unsigned int node = 0; node < linked.body.n_owned; ++node)
        configuration.state.displacement.local_element(3 * node) =
          size * linked.body.position(node)[1];
      for (std::size_t k = 0; k < configuration.internal.size(); ++k)
        configuration.internal[k] = Pack(size + k);
      configuration.update_rotations(linked.effort);
    };
    turn(0.5);
    const State state        = configuration.state;
    const double entry       = configuration.rotations.current[1].entries[1][0];
    const auto same_rotation = [&] {
      return std::abs(configuration.rotations.current[1].entries[1][0] - entry);
    };
    configuration.begin_step(0.);
    turn(0.9);
    report_larger("  another state has other rotations", same_rotation(), 0.01);
    configuration.reject(linked.effort);
    report("  displacement of the start",
           difference(configuration.displacement(), state.displacement),
           0.);
    report("  rotations of the start", same_rotation(), 0.);
    report("  internal variables of the start", std::abs(configuration.internal[3][0] - 3.5), 0.);

    configuration.rotations.kept = configuration.rotations.current;
    const nlohmann::json saved   = configuration.save_cells();
    turn(0.2);
    configuration.rotations.kept.clear();
    configuration.state = state;
    configuration.load_cells(saved, linked.effort);
    report("  rotations, from what was saved", same_rotation(), 0.);
    report("  kept rotations", std::abs(configuration.rotations.kept[1].entries[1][0] - entry), 0.);
    report("  internal variables", std::abs(configuration.internal[3][0] - 3.5), 0.);
  }
} // namespace


int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_energy();
  test_operator();
  test_stiffness_of_pressure();
  test_work_of_pressure();
  test_equilibrium();
  test_configuration();
}
