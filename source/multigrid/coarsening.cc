#include <supple/multigrid/coarsening.h>

#include <supple/base/memory.h>

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
                            const unsigned int patch_size,
                            const std::uint32_t largest_replicated)
    : fine(fine)
    , halo(halo)
    , adjacency(fine.pattern)
  {
    const std::vector<std::uint32_t> first_of = number_aggregates(patch_size);
    find_rows();
    if (distributed())
      find_ghost_rows();
    const bool coarse_distributed = distributed() && coarse.n_nodes > largest_replicated;
    if (coarse_distributed)
      number_known_aggregates();
    else
      renumber(coarse.numbers);
    find_product_columns();
    if (coarse_distributed)
      exchange_entries(first_of);
    find_coarse_pattern();
    estimate_largest_eigenvalue();

    // The load of a row takes in what follows it.
    resize_in_huge_pages(values, 6 * B * column.size() + 2);
    scale.resize(fine.pattern.n_local);
    tentative.resize(fine.pattern.n_local);
    coarse.modes.resize(36 * static_cast<std::size_t>(coarse.numbers.n_owned));
    partial_sums.assign(fine.pattern.n_pieces() - 1,
                        std::vector<NodeValues<6>>(coarse.numbers.n_local()));
  }


  template <unsigned int B>
  std::vector<std::uint32_t>
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

    std::vector<std::uint32_t> first_of(1, 0);
    if (distributed())
      {
        for (const std::uint32_t n : Utilities::MPI::all_gather(halo->communicator(), n_own))
          first_of.push_back(first_of.back() + n);
        first_own = first_of[Utilities::MPI::this_mpi_process(halo->communicator())];
        for (std::uint32_t &a : aggregate_of)
          if (a != no_aggregate)
            a += first_own;
        halo->update(aggregate_of.data());
      }
    else
      first_of.push_back(n_own);
    coarse.n_nodes = first_of.back();
    coarse.numbers = {0, coarse.n_nodes, {}};
    return first_of;
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
          const auto begin = column.begin() + row_start.back();
          if (a != no_aggregate && std::find(begin, column.end(), a) == column.end())
            column.push_back(a);
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
  Coarsening<B>::renumber(NodeNumbers numbers)
  {
    for (std::vector<std::uint32_t> *const list : {&aggregate_of, &column, &product_column})
      for (std::uint32_t &a : *list)
        if (a != no_aggregate)
          a = numbers.local(coarse.numbers.global(a));
    coarse.numbers = std::move(numbers);
    mark.assign(coarse.numbers.n_local(), no_aggregate);
  }


  template <unsigned int B>
  void
  Coarsening<B>::number_known_aggregates()
  {
    NodeNumbers numbers{first_own, n_own, column};
    numbers.complete();
    renumber(std::move(numbers));
  }


  template <unsigned int B>
  void
  Coarsening<B>::exchange_entries(const std::vector<std::uint32_t> &first_of)
  {
    exchange = std::make_unique<BlockExchange>(entries_for_others(first_of), halo->communicator());

    NodeNumbers numbers = coarse.numbers;
    for (const auto &[process, entries] : exchange->received)
      for (const BlockExchange::Entry &entry : entries)
        numbers.ghosts.insert(numbers.ghosts.end(), {entry.row, entry.column});
    numbers.complete();
    renumber(std::move(numbers));

    IndexSet owned(coarse.n_nodes), ghosts(coarse.n_nodes);
    owned.add_range(first_own, first_own + n_own);
    ghosts.add_indices(coarse.numbers.ghosts.begin(), coarse.numbers.ghosts.end());
    coarse.halo = std::make_unique<Halo>(
      std::make_shared<const Utilities::MPI::Partitioner>(owned, ghosts, halo->communicator()), 1);
  }


  template <unsigned int B>
  BlockExchange::Entries
  Coarsening<B>::entries_for_others(const std::vector<std::uint32_t> &first_of) const
  {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for_pairs([&](const std::uint32_t larger, const std::uint32_t smaller) {
      if (larger >= n_own)
        pairs.emplace_back(larger, smaller);
    });
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

    const auto owner = [&](const std::uint32_t a) -> unsigned int {
      return std::upper_bound(first_of.begin(), first_of.end(), a) - first_of.begin() - 1;
    };
    BlockExchange::Entries entries;
    for (const auto &[larger, smaller] : pairs)
      {
        const BlockExchange::Entry entry = {coarse.numbers.global(larger),
                                            coarse.numbers.global(smaller)};
        entries[owner(entry.row)].push_back(entry);
        if (smaller >= n_own && owner(entry.column) != owner(entry.row))
          entries[owner(entry.column)].push_back(entry);
      }
    return entries;
  }


  template <unsigned int B>
  void
  Coarsening<B>::find_product_columns()
  {
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
    const std::uint32_t n = coarse.numbers.n_local();
    std::vector<std::size_t> start(n + 1, 0);
    for_pairs([&](const std::uint32_t larger, std::uint32_t) { ++start[larger + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::uint32_t> smaller(start.back()), contribution(start.back());
    std::vector<std::size_t> end(start.begin(), start.end() - 1);
    std::uint32_t n_contributions = 0;
    for_pairs([&](const std::uint32_t a, const std::uint32_t b) {
      smaller[end[a]]        = b;
      contribution[end[a]++] = n_contributions++;
    });

    std::vector<std::uint32_t> last(n, no_aggregate);
    std::vector<std::vector<std::uint32_t>> rows(n);
    for (std::uint32_t a = 0; a < n; ++a)
      for (std::size_t k = start[a]; k < start[a + 1]; ++k)
        if (smaller[k] != a && last[smaller[k]] != a)
          {
            last[smaller[k]] = a;
            rows[a].push_back(smaller[k]);
          }
    if (distributed())
      add_entries_of_others(rows);
    const SymmetricPattern between_ghosts = set_coarse_pattern(rows);
    if (exchange)
      exchange->find_places(coarse, between_ghosts);

    slots.resize(n_contributions);
    for (std::uint32_t a = 0; a < n; ++a)
      {
        const auto number = [&](const SymmetricPattern &pattern, const std::size_t first) {
          for (std::size_t k = pattern.row_start[a]; k < pattern.row_start[a + 1]; ++k)
            last[pattern.column[k]] = first + k;
        };
        number(coarse.matrix.pattern, 0);
        number(between_ghosts, coarse.matrix.pattern.n_entries());
        last[a] = a; // on the diagonal
        for (std::size_t k = start[a]; k < start[a + 1]; ++k)
          slots[contribution[k]] = last[smaller[k]];
      }
  }


  template <unsigned int B>
  void
  Coarsening<B>::add_entries_of_others(std::vector<std::vector<std::uint32_t>> &rows) const
  {
    const auto add = [&](const std::uint32_t a, const std::uint32_t b) {
      if (a != b)
        rows[std::max(a, b)].push_back(std::min(a, b));
    };
    if (exchange)
      {
        for (const auto &[process, entries] : exchange->received)
          for (const BlockExchange::Entry &entry : entries)
            add(coarse.numbers.local(entry.row), coarse.numbers.local(entry.column));
        return;
      }
    std::vector<std::uint32_t> pairs;
    for (std::uint32_t a = 0; a < rows.size(); ++a)
      for (const std::uint32_t b : rows[a])
        pairs.insert(pairs.end(), {a, b});
    for (const auto &part : Utilities::MPI::all_gather(halo->communicator(), pairs))
      for (std::size_t k = 0; k < part.size(); k += 2)
        add(part[k], part[k + 1]);
  }


  template <unsigned int B>
  SymmetricPattern
  Coarsening<B>::set_coarse_pattern(std::vector<std::vector<std::uint32_t>> &rows)
  {
    SymmetricPattern &pattern = coarse.matrix.pattern, between_ghosts;
    pattern.n_owned           = coarse.numbers.n_owned;
    pattern.n_local           = coarse.numbers.n_local();
    pattern.row_start.assign(1, 0);
    between_ghosts.row_start.assign(1, 0);
    for (auto &row : rows)
      {
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        for (const std::uint32_t a : row)
          (a < pattern.n_owned ? pattern : between_ghosts).column.push_back(a);
        pattern.row_start.push_back(pattern.column.size());
        between_ghosts.row_start.push_back(between_ghosts.column.size());
      }
    resize_in_huge_pages(coarse.matrix.lower, pattern.n_entries() + between_ghosts.n_entries());
    coarse.matrix.diagonal.resize(pattern.n_local);
    return between_ghosts;
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
