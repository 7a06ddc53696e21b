#include <supple/linear_algebra/block_factorization.h>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <limits>
#include <utility>

namespace Supple
{
  namespace
  {
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    using Row = Lanes<double, 3>;

    Row
    make_row(const double a, const double b, const double c)
    {
      return Row{a, b, c, 0.};
    }


    Row
    load_row(const double *from)
    {
      return make_row(from[0], from[1], from[2]);
    }


    /** Counts per item to where each item's list starts. */
    void
    sum_up(std::vector<std::size_t> &counts)
    {
      std::size_t sum = 0;
      for (std::size_t &count : counts)
        sum += std::exchange(count, sum);
    }


    /** The inverse of a symmetric 3x3 matrix by L D L^T. @return whether it is positive definite */
    template <class Block>
    bool
    invert(const Block &A, Block &inverse)
    {
      const double d0  = A.rows[0][0];
      const double l10 = A.rows[1][0] / d0, l20 = A.rows[2][0] / d0;
      const double d1  = A.rows[1][1] - l10 * A.rows[1][0];
      const double l21 = (A.rows[2][1] - l20 * A.rows[1][0]) / d1;
      const double d2  = A.rows[2][2] - l20 * A.rows[2][0] - l21 * l21 * d1;
      if (!(d0 > 0. && d1 > 0. && d2 > 0.))
        return false;
      // A^-1 = W^T D^-1 W with W = L^-1
      const double w20 = l10 * l21 - l20;
      const double e0 = 1. / d0, e1 = 1. / d1, e2 = 1. / d2;
      const double b00 = e0 + l10 * l10 * e1 + w20 * w20 * e2;
      const double b10 = -l10 * e1 - w20 * l21 * e2, b20 = w20 * e2;
      const double b11 = e1 + l21 * l21 * e2, b21 = -l21 * e2;
      inverse.rows[0] = make_row(b00, b10, b20);
      inverse.rows[1] = make_row(b10, b11, b21);
      inverse.rows[2] = make_row(b20, b21, e2);
      return true;
    }


    /** A^T x, for the rows of A */
    template <class Block>
    Row
    transposed_product(const Block &A, const Row &x)
    {
      return A.rows[0] * x[0] + A.rows[1] * x[1] + A.rows[2] * x[2];
    }


    double
    sum_of_lanes(const Row &row)
    {
      return (row[0] + row[1]) + row[2];
    }
  } // namespace


  BlockFactorization::BlockFactorization(const SymmetricPattern &pattern)
    : n(pattern.n_owned)
    , inverse_diagonal(n)
    , row_of_A(n, Block{})
    , solution(n)
  {
    find_order(pattern);
    find_entries(pattern);
    find_factors();
    L.resize(factors.size());
  }


  void
  BlockFactorization::find_order(const SymmetricPattern &pattern)
  {
    std::vector<Eigen::Triplet<double, int>> couplings;
    for (unsigned int i = 0; i < n; ++i)
      {
        couplings.emplace_back(i, i, 1.);
        for (std::size_t k = pattern.row_start[i]; k < pattern.row_start[i + 1]; ++k)
          {
            couplings.emplace_back(i, pattern.column[k], 1.);
            couplings.emplace_back(pattern.column[k], i, 1.);
          }
      }
    Eigen::SparseMatrix<double, Eigen::ColMajor, int> graph(n, n);
    graph.setFromTriplets(couplings.begin(), couplings.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(graph, order);
    node.assign(order.indices().data(), order.indices().data() + n);
    row_of.resize(n);
    for (std::uint32_t row = 0; row < n; ++row)
      row_of[node[row]] = row;
  }


  void
  BlockFactorization::find_entries(const SymmetricPattern &pattern)
  {
    const auto for_each = [&](const auto &action) {
      for (unsigned int i = 0; i < n; ++i)
        for (std::size_t k = pattern.row_start[i]; k < pattern.row_start[i + 1]; ++k)
          {
            const std::uint32_t one = row_of[i], other = row_of[pattern.column[k]];
            action(std::max(one, other), Entry{std::min(one, other), one < other, k});
          }
    };
    entry_start.assign(n + 1, 0);
    for_each([&](const std::uint32_t row, const Entry &) { ++entry_start[row]; });
    sum_up(entry_start);
    entries.resize(pattern.row_start[n]);
    std::vector<std::size_t> next = entry_start;
    for_each([&](const std::uint32_t row, const Entry &entry) { entries[next[row]++] = entry; });
  }


  void
  BlockFactorization::find_factors()
  {
    std::vector<std::uint32_t> parent(n, none), seen_by(n, none);
    std::vector<std::uint32_t> columns;
    factor_start.assign(1, 0);
    column_start.assign(n + 1, 0);
    for (std::uint32_t row = 0; row < n; ++row)
      {
        columns.clear();
        seen_by[row] = row;
        for (std::size_t k = entry_start[row]; k < entry_start[row + 1]; ++k)
          for (std::uint32_t i = entries[k].column; seen_by[i] != row; i = parent[i])
            {
              if (parent[i] == none)
                parent[i] = row;
              seen_by[i] = row;
              columns.push_back(i);
            }
        std::sort(columns.begin(), columns.end());
        for (const std::uint32_t column : columns)
          factors.push_back({column, column_start[column]++});
        factor_start.push_back(factors.size());
      }
    sum_up(column_start);
    factor_row.resize(factors.size());
    for (std::uint32_t row = 0; row < n; ++row)
      for (std::size_t k = factor_start[row]; k < factor_start[row + 1]; ++k)
        {
          factors[k].place += column_start[factors[k].column];
          factor_row[factors[k].place] = row;
        }
  }


  void
  BlockFactorization::spread(const SymmetricBlockMatrix &A, const std::uint32_t row)
  {
    for (std::size_t k = entry_start[row]; k < entry_start[row + 1]; ++k)
      {
        const Entry &entry  = entries[k];
        const double *block = &A.lower[9 * entry.position];
        Block &to           = row_of_A[entry.column];
        for (unsigned int i = 0; i < 3; ++i)
          if (entry.transposed)
            to.rows[i] = make_row(block[i], block[3 + i], block[6 + i]);
          else
            to.rows[i] = load_row(block + 3 * i);
      }
  }


  /** With y_i = L_ki D_i, the block (k, j) of A = L D L^T is y_j + sum_{i<j} y_i L_ji^T. */
  bool
  BlockFactorization::factorize_row(const SymmetricBlockMatrix &A, const std::uint32_t row)
  {
    spread(A, row);
    Block diagonal;
    const double *const own = &A.diagonal[9 * node[row]];
    for (unsigned int i = 0; i < 3; ++i)
      diagonal.rows[i] = load_row(own + 3 * i);
    for (std::size_t k = factor_start[row]; k < factor_start[row + 1]; ++k)
      {
        const auto [column, place] = factors[k];
        const Block y              = row_of_A[column];
        row_of_A[column]           = Block{};
        for (std::size_t p = column_start[column]; p < place; ++p)
          {
            const Block &L_ji = L[p];
            Block &to         = row_of_A[factor_row[p]];
            for (unsigned int r = 0; r < 3; ++r)
              to.rows[r] -= transposed_product(L_ji, y.rows[r]);
          }
        // L_ki = y_i D_i^-1; the rows of its transpose are the columns of L_ki
        const Block &inverse = inverse_diagonal[column];
        Block &L_ki          = L[place];
        for (unsigned int r = 0; r < 3; ++r)
          {
            const Row l = transposed_product(inverse, y.rows[r]);
            for (unsigned int c = 0; c < 3; ++c)
              L_ki.rows[c][r] = l[c];
          }
        for (unsigned int c = 0; c < 3; ++c)
          L_ki.rows[c][3] = 0.;
        for (unsigned int r = 0; r < 3; ++r)
          diagonal.rows[r] -=
            y.rows[r][0] * L_ki.rows[0] + y.rows[r][1] * L_ki.rows[1] + y.rows[r][2] * L_ki.rows[2];
      }
    return invert(diagonal, inverse_diagonal[row]);
  }


  bool
  BlockFactorization::factorize(const SymmetricBlockMatrix &A)
  {
    for (std::uint32_t row = 0; row < n; ++row)
      if (!factorize_row(A, row))
        return false;
    return true;
  }


  void
  BlockFactorization::solve(double *x, const double *b)
  {
    for (std::uint32_t row = 0; row < n; ++row)
      solution[row] = load_row(b + 3 * node[row]);
    for (std::uint32_t i = 0; i < n; ++i)
      {
        const Row value = solution[i];
        for (std::size_t p = column_start[i]; p < column_start[i + 1]; ++p)
          solution[factor_row[p]] -= transposed_product(L[p], value);
        solution[i] = transposed_product(inverse_diagonal[i], value);
      }
    for (std::uint32_t i = n; i-- > 0;)
      {
        Row sums[3] = {};
        for (std::size_t p = column_start[i]; p < column_start[i + 1]; ++p)
          for (unsigned int c = 0; c < 3; ++c)
            sums[c] += L[p].rows[c] * solution[factor_row[p]];
        for (unsigned int c = 0; c < 3; ++c)
          solution[i][c] -= sum_of_lanes(sums[c]);
      }
    for (std::uint32_t row = 0; row < n; ++row)
      for (unsigned int c = 0; c < 3; ++c)
        x[3 * node[row] + c] = solution[row][c];
  }
} // namespace Supple
