// Microseconds a step of backward Euler with the rotations frozen in each step, without output: by
// a bare loop over the same forces, matrix and solver, and by the program's integrator, which is
// SUNDIALS's. They take turns, so that a busy machine is busy for both.
//
//   overhead SCENE.prm [repetitions [integrator | loop]]

#include <supple/run/problem.h>
#include <supple/scene/read_scene.h>
#include <supple/time/create_integrator.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

namespace
{
  using namespace Supple;

  /** The problem of a scene, and steps of it by one of the two. */
  struct Run
  {
    Problem problem;

    explicit Run(const std::string &scene)
      : problem(read_scene(scene), MPI_COMM_WORLD)
    {
      const Parameters &parameters = problem.parameters;
      if (parameters.damping.any() || problem.constraints.move() ||
          parameters.loads.pressure != "0" || parameters.time.method != TimeMethod::backward_euler)
        throw std::runtime_error(
          "the bare loop knows backward Euler without damping, motions and pressure");
      problem.configuration.update_rotations(problem.effort);
    }

    virtual ~Run() = default;

    virtual void
    step() = 0;

    /** [us] a step, and phase by phase. */
    std::vector<double>
    measure()
    {
      problem.effort             = Effort();
      const unsigned int n_steps = problem.parameters.time.n_steps;
      const auto start           = std::chrono::steady_clock::now();
      for (unsigned int k = 0; k < n_steps; ++k)
        step();
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      std::vector<double> result                  = {1e6 * seconds.count() / n_steps};
      for (const double phase : problem.effort.seconds)
        result.push_back(1e6 * phase / n_steps);
      return result;
    }
  };


  /** (M + dt^2 K') (v1 - v0) = dt (f - f_int(u0 + dt v0)),  u1 = u0 + dt v1 */
  struct BareLoop : Run
  {
    double time      = 0.;
    bool is_prepared = false;
    Vector force, increment;

    explicit BareLoop(const std::string &scene)
      : Run(scene)
    {
      for (Vector *vector : {&force, &increment})
        problem.body.initialize(*vector);
    }

    void
    step() override
    {
      const double dt              = problem.parameters.time.step;
      Configuration &configuration = problem.configuration;
      Vector &u = configuration.state.displacement, &v = configuration.state.velocity;
      if (!is_prepared || problem.forces.change_operator())
        {
          problem.implicit_operator.assemble(dt);
          problem.solver->prepare(u);
          is_prepared = true;
        }
      u.add(dt, v);
      time += dt;
      problem.forces.set_force(force, configuration, time, problem.effort);
      force *= dt;
      problem.constraints.set_zero(force);
      problem.solver->solve(increment, force);
      v += increment;
      u.add(dt, increment);
      configuration.update_rotations(problem.effort);
    }
  };


  struct ByIntegrator : Run
  {
    const std::unique_ptr<TimeIntegrator> integrator;

    explicit ByIntegrator(const std::string &scene)
      : Run(scene)
      , integrator(create_integrator(problem.model()))
    {
    }

    void
    step() override
    {
      integrator->advance(false);
    }
  };


  /** Of several runs of the steps, the one with the median time. */
  std::vector<double>
  median(std::vector<std::vector<double>> measured)
  {
    std::sort(measured.begin(), measured.end());
    return measured[measured.size() / 2];
  }


  void
  print(const char *name, const std::vector<double> &values)
  {
    std::printf("| %s |", name);
    double rest = values[0];
    for (std::size_t i = 1; i < 6; ++i)
      rest -= values[i];
    for (std::size_t i = 0; i < 6; ++i)
      std::printf(" %.1f |", values[i]);
    std::printf(" %.1f |\n", rest);
  }


  void
  compare(const std::string &scene, const unsigned int n_repetitions, const std::string &which)
  {
    BareLoop loop(scene);
    ByIntegrator integrator(scene);
    std::vector<std::vector<double>> by_loop, by_integrator;
    for (unsigned int k = 0; k < n_repetitions; ++k)
      {
        if (which != "integrator")
          by_loop.push_back(loop.measure());
        if (which != "loop")
          by_integrator.push_back(integrator.measure());
      }
    if (!which.empty())
      return;
    std::printf(
      "| %u cells | us a step | rotations | forces | assembly | factorization | solution | rest |\n"
      "|---|---|---|---|---|---|---|---|\n",
      loop.problem.mesh.n_cells);
    print("bare loop", median(by_loop));
    print("SUNDIALS", median(by_integrator));
    std::vector<double> differences;
    for (unsigned int k = 0; k < n_repetitions; ++k)
      differences.push_back(by_integrator[k][0] - by_loop[k][0]);
    std::sort(differences.begin(), differences.end());
    std::printf(
      "\nmore: %.1f us a step (median of %u; a quarter is below %.1f, a quarter above %.1f); ",
      differences[n_repetitions / 2],
      n_repetitions,
      differences[n_repetitions / 4],
      differences[3 * n_repetitions / 4]);
    std::printf("apart: %.1e m\n",
                largest_vertex_distance(loop.problem.configuration.displacement(),
                                        integrator.problem.configuration.displacement()));
  }
} // namespace


int
main(int argc, char **argv)
{
  int n_names = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_names, argv, 1);
  if (argc < 2)
    {
      std::fprintf(stderr, "usage: %s SCENE.prm [repetitions [integrator | loop]]\n", argv[0]);
      return 1;
    }
  try
    {
      compare(argv[1], argc > 2 ? std::stoul(argv[2]) : 21, argc > 3 ? argv[3] : "");
    }
  catch (const std::exception &error)
    {
      std::fprintf(stderr, "%s\n", error.what());
      return 1;
    }
}
