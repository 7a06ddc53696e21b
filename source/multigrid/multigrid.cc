#include <supple/multigrid/multigrid.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <utility>

namespace Supple
{
  namespace
  {
    // Measured on the bar (benchmarks/bar).
    constexpr unsigned int patch_size           = 15; // nodes in an aggregate of a coarse level
    constexpr unsigned int largest_inverse      = 80; // nodes of a level that is inverted
    constexpr unsigned int largest_level_number = 20;

    // Up to how many nodes each process has the whole of a level: what has more pays for messages
    // to be distributed, but processes with a few nodes alone could not make aggregates of them
    // (benchmarks/ranks).
    constexpr unsigned int replicated_nodes = 300, nodes_of_process = 4;


    std::uint32_t
    largest_replicated(const Halo &halo)
    {
      const unsigned int n_processes = dealii::Utilities::MPI::n_mpi_processes(halo.communicator());
      return std::max(replicated_nodes, nodes_of_process * n_processes);
    }
  } // namespace


  Multigrid::Level::Level(const CoarseLevel &level)
    : coarse(level)
    , smoother(level.matrix.pattern)
    , x(level.matrix.pattern.n_local)
    , b(level.matrix.pattern.n_local)
    , residual(level.matrix.pattern.n_local)
  {
  }


  Multigrid::Multigrid(const SymmetricBlockMatrix &A,
                       std::shared_ptr<const dealii::Utilities::MPI::Partitioner> dofs)
    : Cycle(A, std::move(dofs))
  {
  }


  void
  Multigrid::build(const std::vector<double> &modes)
  {
    finest.set_scale();
    refresh_finest();
    levels.clear();
    coarsening =
      std::make_unique<Coarsening<3>>(finest.smoother(), &halo, 0, largest_replicated(halo));
    coarsening->refresh(finest.view(), finest.scale(), modes);
    refresh_coarse_levels(true);
  }


  void
  Multigrid::refresh(const std::vector<double> &modes)
  {
    finest.set_scale();
    refresh_finest();
    coarsening->refresh(finest.view(), finest.scale(), modes);
    refresh_coarse_levels(false);
  }


  void
  Multigrid::refresh_finest()
  {
    finest.refresh();
  }


  void
  Multigrid::refresh_coarse_levels(const bool build)
  {
    const CoarseLevel *next = &coarsening->coarse;
    bool positive           = true;
    for (std::size_t l = 0; next != nullptr && next->n_nodes > 0; ++l)
      {
        if (build)
          levels.push_back(std::make_unique<Level>(*next));
        Level &level = *levels[l];
        positive     = level.smoother.set(next->matrix.view(), scale()) && positive;
        next         = nullptr;
        if (level.coarse.n_nodes <= largest_inverse)
          invert(level);
        else
          {
            if (build && l < largest_level_number)
              level.coarsening = std::make_unique<Coarsening<6>>(level.smoother,
                                                                 level.coarse.halo.get(),
                                                                 patch_size,
                                                                 largest_replicated(halo));
            if (level.coarsening)
              {
                level.coarsening->refresh(level.coarse.matrix.view(), scale(), level.coarse.modes);
                next = &level.coarsening->coarse;
              }
          }
      }
    require_positive(positive, halo);
  }


  void
  Multigrid::invert(Level &level)
  {
    const SymmetricPattern &pattern = level.coarse.matrix.pattern;
    const unsigned int n            = 6 * pattern.n_owned;
    Eigen::MatrixXd full            = Eigen::MatrixXd::Zero(n, n);
    const auto write = [&](const std::size_t i, const std::size_t j, const auto &block) {
      for (unsigned int a = 0; a < 6; ++a)
        for (unsigned int b = 0; b < 6; ++b)
          full(6 * i + a, 6 * j + b) = scale() * block.row[a][b];
    };
    for (std::size_t i = 0; i < pattern.n_owned; ++i)
      {
        write(i, i, level.coarse.matrix.diagonal[i]);
        for (std::size_t k = pattern.row_start[i]; k < pattern.row_start[i + 1]; ++k)
          write(i, pattern.column[k], level.coarse.matrix.lower[k]);
      }
    const Eigen::LLT<Eigen::MatrixXd> factorization(full); // of the lower half
    require_positive(factorization.info() == Eigen::Success, halo);
    level.inverse = factorization.solve(Eigen::MatrixXd::Identity(n, n)).cast<float>();
    level.right_hand_side.resize(n);
    level.solution.resize(n);
  }


  void
  Multigrid::cycle(const std::size_t l)
  {
    Level &level = *levels[l];
    if (level.inverse.size() > 0)
      {
        for (std::size_t node = 0; node < level.b.size(); ++node)
          for (unsigned int i = 0; i < 6; ++i)
            level.right_hand_side[6 * node + i] = level.b[node].lanes[i];
        level.solution.noalias() = level.inverse * level.right_hand_side;
        for (std::size_t node = 0; node < level.b.size(); ++node)
          for (unsigned int i = 0; i < 6; ++i)
            level.x[node].lanes[i] = level.solution[6 * node + i];
        return;
      }
    const Halo *const level_halo = level.coarse.halo.get();
    level.smoother.forward(level.x.data(), level.residual.data(), level.b.data());
    if (level_halo != nullptr)
      {
        level_halo->update(level.x.data());
        level.smoother.subtract_remote(level.residual.data(), level.x.data());
      }
    if (l + 1 < levels.size())
      {
        Level &coarser = *levels[l + 1];
        level.coarsening->restrict_residual(coarser.b.data(), level.residual.data());
        cycle(l + 1);
        level.coarsening->add_correction(level.x.data(), coarser.x.data());
      }
    if (level_halo != nullptr)
      level.smoother.subtract_remote(level.b.data(), level.x.data());
    level.smoother.backward(level.x.data(), level.b.data());
  }


  void
  Multigrid::apply(NodeValues<3> *z, NodeValues<3> *product, const NodeValues<3> *r)
  {
    finest.descend(z, r);
    if (!levels.empty())
      {
        coarsening->restrict_residual(levels[0]->b.data(), finest.residual().data());
        cycle(0);
        coarsening->add_correction(z, levels[0]->x.data());
      }
    finest.ascend(z, product, r);
  }
} // namespace Supple
