// The inner loops of a step on the bar, each by itself: nanoseconds a tetrahedron and bytes a
// second, beside the bandwidth of the triad a = b + s c on arrays of as many bytes, measured in the
// same run.
//
//   kernels [--benchmark_... of Google Benchmark] SCENE.prm [Section/Entry=value]...

#include <supple/multigrid/block_smoother.h>
#include <supple/run/problem.h>
#include <supple/scene/read_scene.h>

#include <deal.II/base/mpi.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <iostream>

namespace
{
  using namespace Supple;

  struct Bar
  {
    Problem problem;
    const Body &body;
    Effort &effort;
    ImplicitOperator &A;
    BlockSmoother<3> smoother;
    Vector force, x, y;
    std::vector<NodeValues<3>> z, b, r, change, product;

    Bar(const std::string &scene, const std::vector<Override> &changes)
      : problem(read_scene(scene, changes), MPI_COMM_WORLD)
      , body(problem.body)
      , effort(problem.effort)
      , A(problem.implicit_operator)
      , smoother(A.matrix().pattern)
      , z(body.n_local)
      , b(body.n_local)
      , r(body.n_local)
      , change(body.n_local)
      , product(body.n_local)
    {
      for (Vector *vector : {&force, &x, &y})
        body.initialize(*vector);
      Vector &u = problem.configuration.state.displacement;
      for (unsigned int dof = 0; dof < 3 * body.n_owned; ++dof)
        {
          x.local_element(dof) = std::sin(0.1 * dof);
          u.local_element(dof) = 1e-3 * std::cos(0.01 * dof);
        }
      problem.constraints.set_zero(u);
      for (std::size_t node = 0; node < body.n_owned; ++node)
        b[node].lanes = Lanes<float, 3>{1.f, 2.f, 3.f, 0.f};
      update_rotations();
      A.assemble(problem.parameters.time.step);
      const SymmetricBlockMatrix &matrix = A.matrix();
      smoother.set({matrix.pattern, matrix.lower.data(), matrix.diagonal.data()},
                   1. / matrix.diagonal[0]);
    }

    void
    update_rotations()
    {
      problem.configuration.update_rotations(effort);
    }

    void
    set_force()
    {
      problem.forces.set_force(force, problem.configuration, 0., effort);
    }

    double
    n_cells() const
    {
      return body.cell_nodes.size();
    }

    /** What the matrix is read with, its numbers of @p size bytes each. */
    double
    matrix_bytes(const double size) const
    {
      const SymmetricPattern &pattern = A.matrix().pattern;
      return pattern.n_entries() * (9. * size + sizeof(std::uint32_t)) +
             pattern.n_owned * (9. * size + sizeof(std::size_t));
    }
  };


  template <class Action>
  void
  measure(const char *name, const double bytes, const double n_cells, const Action &action)
  {
    benchmark::RegisterBenchmark(name, [=](benchmark::State &state) {
      for (auto _ : state)
        action();
      using benchmark::Counter;
      if (bytes > 0.)
        state.counters["GB/s"] = Counter(1e-9 * bytes, Counter::kIsIterationInvariantRate);
      state.counters["ns/tet"] =
        Counter(1e-9 * n_cells, Counter::kIsIterationInvariantRate | Counter::kInvert);
    })->Unit(benchmark::kMicrosecond);
  }


  void
  measure_triad(const double bytes, const double n_cells)
  {
    const std::size_t n = bytes / (3 * sizeof(double));
    auto a              = std::make_shared<std::vector<double>>(n, 1.);
    auto b              = std::make_shared<std::vector<double>>(n, 2.);
    auto c              = std::make_shared<std::vector<double>>(n, 3.);
    measure("triad", bytes, n_cells, [=] {
      double *const to        = a->data();
      const double *const one = b->data(), *const two = c->data();
      for (std::size_t i = 0; i < n; ++i)
        to[i] = one[i] + 3. * two[i];
      benchmark::ClobberMemory();
    });
  }


  void
  measure_cells(Bar &bar)
  {
    const double n = bar.n_cells();
    measure("rotation", 0., n, [&] { bar.update_rotations(); });
    measure("force", 0., n, [&] { bar.set_force(); });
    measure("assembly", 0., n, [&] { bar.A.assemble(bar.problem.parameters.time.step); });
    measure("rotation, force, assembly", 0., n, [&] {
      bar.update_rotations();
      bar.set_force();
      bar.A.assemble(bar.problem.parameters.time.step);
    });
    const auto tangent = [&](const Tangent kind) {
      bar.problem.forces.update_tangent(kind, bar.problem.configuration, 0., bar.effort);
      bar.A.assemble(bar.problem.parameters.time.step);
    };
    measure("consistent tangent", 0., n, [=] { tangent(Tangent::consistent); });
    measure("definite tangent", 0., n, [=] { tangent(Tangent::definite); });
  }


  void
  measure_matrix(Bar &bar)
  {
    const double n       = bar.n_cells();
    const double vectors = bar.body.n_owned * 2. * 3. * sizeof(double);
    const double lanes   = bar.body.n_owned * 2. * sizeof(NodeValues<3>);
    measure("product", bar.matrix_bytes(sizeof(double)) + vectors, n, [&] {
      bar.A.vmult(bar.y, bar.x);
    });
    measure("product, single precision", bar.matrix_bytes(sizeof(float)) + lanes, n, [&] {
      bar.smoother.vmult(bar.r.data(), bar.b.data());
    });
    measure("forward sweep", bar.matrix_bytes(sizeof(float)) + 1.5 * lanes, n, [&] {
      bar.smoother.forward(bar.z.data(), bar.r.data(), bar.b.data());
    });
    measure("backward sweep", bar.matrix_bytes(sizeof(float)) + 1.5 * lanes, n, [&] {
      bar.r = bar.b;
      bar.smoother.backward(bar.z.data(), bar.r.data());
    });
    measure("backward sweep with the product",
            bar.matrix_bytes(sizeof(float)) + 3. * lanes,
            n,
            [&] {
              bar.r = bar.b;
              bar.smoother.backward(
                bar.z.data(), bar.r.data(), bar.b.data(), bar.change.data(), bar.product.data());
            });
  }
} // namespace


int
main(int argc, char **argv)
{
  benchmark::Initialize(&argc, argv);
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc < 2)
    {
      std::cerr << "kernels [--benchmark_...] SCENE.prm [Section/Entry=value]...\n";
      return 1;
    }
  std::vector<Supple::Override> changes;
  for (int k = 2; k < argc; ++k)
    changes.push_back({argv[k]});
  Bar bar(argv[1], changes);
  std::cerr << bar.n_cells() << " cells, " << bar.body.n_owned << " vertices\n";
  measure_triad(bar.matrix_bytes(sizeof(double)), bar.n_cells());
  measure_cells(bar);
  measure_matrix(bar);
  benchmark::RunSpecifiedBenchmarks();
}
