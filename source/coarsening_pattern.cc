#include <supple/coarsening.h>
#include <supple/huge_pages.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace Supple
{
  using namespace dealii;

  template <unsigned int B>
  Coarsening<B>::Coarsening(const BlockSmoother<B> &fine,
                            const Halo *halo,
                            const unsigned int patch_size)
    : fine(fine)
    , halo(halo)
    , adjacency(fine.pattern)
  {
    number_aggregates(patch_size);
    find_rows();
    if (distributed())
      find_ghost_rows();
    find_product_columns();
    find_coarse_pattern();
    estimate_largest_eigenvalue();

    // The load of a row takes in what follows it.
    resize_in_huge_pages(values, 6 * B * column.size() + 2);
    scale.resize(fine.pattern.n_local);
    tentative.resize(fine.pattern.n_local);
    resize_in_huge_pages(matrix.lower, matrix.pattern.n_entries());
    matrix.diagonal.resize(n_coarse);
    coarse_modes.resize(36 * static_cast<std::size_t>(n_coarse));
    partial_sums.assign(fine.pattern.n_pieces() - 1, std::vector<NodeValues<6>>(n_coarse));
  }


  template <unsigned int B>
  void
  Coarsening<B>::number_aggregates(const unsigned int patch_size)
  {
    aggregate_of = aggregate(fine, adjacency, patch_size, n_own);
    aggregate_of.resize(fine.pattern.n_local, no_aggregate);

    member_start.assign(n_own + 1, 0);
    for (const std::uint32_t a : aggregate_of)
      if (a != no_aggregate)
        ++member_start[a + 1];
    std::partial_sum(member_start.begin(), member_start.end(), member_start.begin());
    member.resize(member_start.back());
    std::vector<std::uint32_t> end = member_start;
    for (std::uint32_t node = 0; node < aggregate_of.size(); ++node)
      if (aggregate_of[node] != no_aggregate)
        member[end[aggregate_of[node]]++] = node;

    first_own = 0;
    n_coarse  = n_own;
    if (distributed())
      {
        const auto counts = Utilities::MPI::all_gather(halo->communicator(), n_own);
        const auto own    = counts.begin() + Utilities::MPI::this_mpi_process(halo->communicator());
        first_own         = std::accumulate(counts.begin(), own, 0u);
        n_coarse          = std::accumulate(own, counts.end(), first_own);
        for (std::uint32_t &a : aggregate_of)
          if (a != no_aggregate)
            a += first_own;
        halo->update(aggregate_of.data());
      }
    mark.assign(n_coarse, no_aggregate);
  }


  /** P has a node's own aggregate and those of its neighbours. */
  template <unsigned int B>
  void
  Coarsening<B>::find_rows()
  {
    row_start.assign(1, 0);
    for (std::uint32_t node = 0; node < fine.pattern.n_owned; ++node)
      {
        const auto add = [&](const std::uint32_t a) {
          if (a != no_aggregate && mark[a] != node)
            {
              mark[a] = node;
              column.push_back(a);
            }
        };
        add(aggregate_of[node]);
        for (std::uint32_t k = adjacency.start[node]; k < adjacency.start[node + 1]; ++k)
          add(aggregate_of[adjacency.neighbor[k]]);
        std::sort(column.begin() + row_start.back(), column.end());
        longest_row = std::max<std::uint32_t>(longest_row, column.size() - row_start.back());
        row_start.push_back(column.size());
      }
    smoothed.resize(longest_row);
  }


  template <unsigned int B>
  void
  Coarsening<B>::find_ghost_rows()
  {
    const std::uint32_t n_owned = fine.pattern.n_owned, n_local = fine.pattern.n_local;
    longest_row            = Utilities::MPI::max(longest_row, halo->communicator());
    const std::size_t size = longest_row * sizeof(std::uint32_t);
    ghost_records.assign(n_local * size, char(-1)); // no_aggregate, where the row has ended
    for (std::uint32_t node = 0; node < n_owned; ++node)
      if (row_start[node + 1] > row_start[node])
        std::memcpy(ghost_records.data() + node * size,
                    column.data() + row_start[node],
                    (row_start[node + 1] - row_start[node]) * sizeof(std::uint32_t));
    halo->update(ghost_records.data(), size);
    for (std::uint32_t node = n_owned; node < n_local; ++node)
      {
        std::vector<std::uint32_t> row(longest_row);
        if (size > 0) // somewhere there is a row
          std::memcpy(row.data(), ghost_records.data() + node * size, size);
        std::copy_if(row.begin(), row.end(), std::back_inserter(column), [](const auto a) {
          return a != no_aggregate;
        });
        row_start.push_back(column.size());
      }
    ghost_records.resize(n_local * longest_row * 6 * B * sizeof(std::int16_t));
  }


  template <unsigned int B>
  void
  Coarsening<B>::find_product_columns()
  {
    std::fill(mark.begin(), mark.end(), no_aggregate);
    product_start.assign(1, 0);
    std::size_t longest = 0;
    for (std::uint32_t row = 0; row < fine.pattern.n_local; ++row)
      {
        const auto add = [&](const std::size_t node) {
          for (std::uint32_t q = row_start[node]; q < row_start[node + 1]; ++q)
            if (mark[column[q]] != row)
              {
                mark[column[q]] = row;
                product_column.push_back(column[q]);
              }
        };
        if (row < fine.pattern.n_owned)
          add(row);
        for (std::size_t k = fine.pattern.row_start[row]; k < fine.pattern.row_start[row + 1]; ++k)
          add(fine.pattern.column[k]);
        longest = std::max(longest, product_column.size() - product_start.back());
        product_start.push_back(product_column.size());
      }
    product.resize(longest);
  }


  template <unsigned int B>
  template <class Action>
  void
  Coarsening<B>::for_pairs(const Action &action) const
  {
    for (std::size_t row = 0; row < fine.pattern.n_local; ++row)
      for (std::uint32_t q = row_start[row]; q < row_start[row + 1]; ++q)
        for (std::uint32_t f = product_start[row]; f < product_start[row + 1]; ++f)
          action(std::max(column[q], product_column[f]), std::min(column[q], product_column[f]));
  }


  template <unsigned int B>
  void
  Coarsening<B>::find_coarse_pattern()
  {
    // All pairs, sorted by the larger aggregate.
    std::vector<std::size_t> start(n_coarse + 1, 0);
    for_pairs([&](const std::uint32_t larger, std::uint32_t) { ++start[larger + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::uint32_t> smaller(start.back()), contribution(start.back());
    std::vector<std::size_t> end(start.begin(), start.end() - 1);
    std::uint32_t n_contributions = 0;
    for_pairs([&](const std::uint32_t a, const std::uint32_t b) {
      smaller[end[a]]        = b;
      contribution[end[a]++] = n_contributions++;
    });

    std::vector<std::uint32_t> last(n_coarse, no_aggregate);
    std::vector<std::vector<std::uint32_t>> rows(n_coarse);
    for (std::uint32_t a = 0; a < n_coarse; ++a)
      for (std::size_t k = start[a]; k < start[a + 1]; ++k)
        if (smaller[k] != a && last[smaller[k]] != a)
          {
            last[smaller[k]] = a;
            rows[a].push_back(smaller[k]);
          }
    if (distributed())
      merge_patterns(rows);

    SymmetricPattern &pattern = matrix.pattern;
    pattern.n_owned = pattern.n_local = n_coarse;
    pattern.row_start.assign(1, 0);
    slots.resize(n_contributions);
    for (std::uint32_t a = 0; a < n_coarse; ++a)
      {
        std::sort(rows[a].begin(), rows[a].end());
        for (const std::uint32_t b : rows[a])
          {
            last[b] = pattern.column.size();
            pattern.column.push_back(b);
          }
        pattern.row_start.push_back(pattern.column.size());
        last[a] = a; // on the diagonal
        for (std::size_t k = start[a]; k < start[a + 1]; ++k)
          slots[contribution[k]] = last[smaller[k]];
      }
  }


  template <unsigned int B>
  void
  Coarsening<B>::merge_patterns(std::vector<std::vector<std::uint32_t>> &rows) const
  {
    std::vector<std::uint32_t> pairs;
    for (std::uint32_t a = 0; a < rows.size(); ++a)
      for (const std::uint32_t b : rows[a])
        pairs.insert(pairs.end(), {a, b});
    rows.assign(rows.size(), {});
    for (const auto &part : Utilities::MPI::all_gather(halo->communicator(), pairs))
      for (std::size_t k = 0; k < part.size(); k += 2)
        rows[part[k]].push_back(part[k + 1]);
    for (auto &row : rows)
      {
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
      }
  }


  /** A few steps of the power method are enough: w depends little on it. */
  template <unsigned int B>
  void
  Coarsening<B>::estimate_largest_eigenvalue()
  {
    const unsigned int n_steps = 10;
    std::vector<NodeValues<B>> x(fine.pattern.n_local), y(fine.pattern.n_local);
    std::uint32_t random = 1;
    for (std::size_t node = 0; node < fine.pattern.n_owned; ++node)
      for (unsigned int i = 0; i < B; ++i)
        {
          random           = 1664525u * random + 1013904223u;
          x[node].lanes[i] = static_cast<float>(random >> 8) / (1u << 24) - 0.5f;
        }
    largest_eigenvalue = 1.;
    for (unsigned int step = 0; step <= n_steps; ++step)
      {
        if (halo != nullptr)
          halo->update(x.data());
        fine.vmult(y.data(), x.data());
        double square = 0.;
        for (std::size_t node = 0; node < fine.pattern.n_owned; ++node)
          {
            x[node].lanes = fine.solve_diagonal(node, y[node].lanes);
            for (unsigned int i = 0; i < B; ++i)
              square += double(x[node].lanes[i]) * x[node].lanes[i];
          }
        if (distributed())
          square = Utilities::MPI::sum(square, halo->communicator());
        const float inverse_norm = square > 0. ? 1. / std::sqrt(square) : 0.;
        for (std::size_t node = 0; node < fine.pattern.n_owned; ++node)
          x[node].lanes *= inverse_norm;
        if (step > 0 && square > 0.) // x had the norm 1
          largest_eigenvalue = std::sqrt(square);
      }
  }


  template class Coarsening<3>;
  template class Coarsening<6>;
} // namespace Supple
