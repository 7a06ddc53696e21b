// Levels of multigrid on any number of processes, distributed or whole on each: the coarse matrix
// is P^T A P, the restriction is the prolongation's transpose, and ghosts have what their owners
// have.

#include <supple/multigrid/coarsening.h>
#include <supple/run/problem.h>
#include <supple/scene/read_scene.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <fstream>

#include "driver/checks.h"

using namespace Supple;

namespace
{
  const MPI_Comm communicator = MPI_COMM_WORLD;

  double
  sum(const double part)
  {
    return dealii::Utilities::MPI::sum(part, communicator);
  }


  void
  report_on_first(const char *what, const double value, const double limit)
  {
    const double largest = dealii::Utilities::MPI::max(value, communicator);
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      report(what, largest, limit);
  }


  /** Values that change from node to node, and with the seed. */
  template <unsigned int B>
  std::vector<NodeValues<B>>
  some_values(const std::size_t n_local,
              const std::size_t n_owned,
              const double first,
              const double seed)
  {
    std::vector<NodeValues<B>> values(n_local);
    for (std::size_t node = 0; node < n_owned; ++node)
      for (unsigned int i = 0; i < B; ++i)
        values[node].lanes[i] = std::sin(seed * (B * (first + node) + i) + seed);
    return values;
  }


  template <unsigned int B>
  double
  product(const std::vector<NodeValues<B>> &x,
          const std::vector<NodeValues<B>> &y,
          const std::size_t n)
  {
    double part = 0.;
    for (std::size_t node = 0; node < n; ++node)
      for (unsigned int i = 0; i < B; ++i)
        part += double(x[node].lanes[i]) * y[node].lanes[i];
    return part;
  }


  /** x.A x over all processes; a level that each has the whole of counts once. */
  template <unsigned int B>
  double
  energy(const BlockSmoother<B> &A, const Halo *halo, std::vector<NodeValues<B>> x)
  {
    if (halo != nullptr)
      halo->update(x.data());
    std::vector<NodeValues<B>> y(x.size());
    A.vmult(y.data(), x.data());
    const double part = product(x, y, A.pattern.n_owned);
    return halo != nullptr ? sum(part) : part;
  }


  template <unsigned int B>
  void
  check(Coarsening<B> &coarsening,
        const BlockSmoother<B> &fine,
        const Halo *fine_halo,
        const double factor)
  {
    const CoarseLevel &coarse     = coarsening.coarse;
    const SymmetricPattern &nodes = fine.pattern;
    const std::size_t n           = coarse.numbers.n_owned;
    auto x = some_values<6>(coarse.numbers.n_local(), n, coarse.numbers.first_own, 0.37);
    std::vector<NodeValues<B>> Px(nodes.n_local);
    coarsening.add_correction(Px.data(), x.data());

    std::vector<NodeValues<B>> of_owners = Px;
    if (fine_halo != nullptr)
      fine_halo->update(of_owners.data());
    double difference = 0.;
    for (std::size_t node = 0; node < nodes.n_local; ++node)
      for (unsigned int i = 0; i < B; ++i)
        difference =
          std::max<double>(difference, std::abs(Px[node].lanes[i] - of_owners[node].lanes[i]));
    report_on_first("P x at ghosts, difference from their owners", difference, 1e-5);

    BlockSmoother<6> coarse_matrix(coarse.matrix.pattern);
    coarse_matrix.set(coarse.matrix.view(), factor);
    const double whole = energy(fine, fine_halo, Px);
    report_on_first("x.A_coarse x, relative difference from P x.A P x",
                    std::abs(energy(coarse_matrix, coarse.halo.get(), x) / whole - 1.),
                    1e-4);

    const auto r = some_values<B>(nodes.n_local, nodes.n_owned, 1., 0.73);
    std::vector<NodeValues<6>> restricted(coarse.numbers.n_local());
    coarsening.restrict_residual(restricted.data(), r.data());
    const double part = product(restricted, x, n), fine_part = product(r, Px, nodes.n_owned);
    const double left  = coarse.halo ? sum(part) : part,
                 right = fine_halo != nullptr ? sum(fine_part) : fine_part;
    const double size  = std::sqrt(whole);
    report_on_first("P^T r.x, difference from r.P x",
                    std::abs(left - right) / std::max(size, std::abs(right)),
                    1e-4);
  }


  /** Two steps to coarser levels. */
  void
  check_levels(const Body &body,
               const SymmetricBlockMatrix &matrix,
               const std::uint32_t largest_replicated)
  {
    const MatrixView<3> view{matrix.pattern, matrix.lower.data(), matrix.diagonal.data()};
    const double factor = 1e-6;
    BlockSmoother<3> fine(matrix.pattern);
    fine.set(view, factor);
    std::vector<double> modes(18 * std::size_t(body.n_owned), 0.);
    for (std::size_t node = 0; node < body.n_owned; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const auto &X                              = body.positions[node];
          modes[18 * node + 6 * i + i]               = 1.;
          modes[18 * node + 6 * i + 3 + (i + 1) % 3] = X[(i + 2) % 3];
          modes[18 * node + 6 * i + 3 + (i + 2) % 3] = -X[(i + 1) % 3];
        }
    const Halo halo(body.partitioner, 3);
    Coarsening<3> first(fine, &halo, 0, largest_replicated);
    first.refresh(view, factor, modes);
    check(first, fine, &halo, factor);

    BlockSmoother<6> second_fine(first.coarse.matrix.pattern);
    second_fine.set(first.coarse.matrix.view(), factor);
    Coarsening<6> second(second_fine, first.coarse.halo.get(), 4, largest_replicated);
    second.refresh(first.coarse.matrix.view(), factor, first.coarse.modes);
    check(second, second_fine, first.coarse.halo.get(), factor);
  }
} // namespace


int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
  if (is_first)
    std::ofstream("bar.prm")
      << "subsection Mesh\n  set Box size = 4, 12, 4\n  set Box cubes = 8, 24, 8\nend\n"
         "subsection Constraints\n  set Clamped boundaries = 3\nend\n";
  MPI_Barrier(communicator);
  Problem problem(read_scene("bar.prm"), communicator);
  ImplicitOperator &A = problem.implicit_operator;
  A.assemble(0.07);
  for (const std::uint32_t largest_replicated : {0u, 1000000u})
    {
      if (is_first)
        std::printf("%s\n", largest_replicated == 0 ? "distributed" : "whole on each process");
      check_levels(problem.body, A.matrix(), largest_replicated);
    }
}
