#include <supple/multigrid/block_smoother.h>

#include <supple/base/memory.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace Supple
{
  template <unsigned int B>
  BlockSmoother<B>::BlockSmoother(const SymmetricPattern &pattern)
    : pattern(pattern)
    , diagonal(B * static_cast<std::size_t>(pattern.n_owned))
    , inverse(B * static_cast<std::size_t>(pattern.n_owned))
  {
    // The load of a row takes in what follows it.
    resize_in_huge_pages(lower, B * B * pattern.n_entries() + 8);
    find_remote_couplings();
  }


  template <unsigned int B>
  void
  BlockSmoother<B>::find_remote_couplings()
  {
    std::vector<std::uint32_t> nodes;
    const auto for_nodes = [this](const auto &action) {
      pattern.for_outer_entries(
        [&](const std::size_t row, const std::size_t begin, const std::size_t end) {
          for (std::size_t k = begin; k < end; ++k)
            action(pattern.column[k], row < pattern.n_owned ? row : pattern.column[k]);
        });
    };
    for_nodes([&](const std::uint32_t column, const std::uint32_t row) {
      nodes.push_back(column);
      nodes.push_back(row);
    });
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const std::uint32_t node : nodes)
      remote.push_back({node, NodeValues<B>()});
    const auto place = [&](const std::uint32_t node) {
      return std::uint32_t(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin());
    };
    for_nodes([&](const std::uint32_t column, const std::uint32_t row) {
      remote_index.push_back({{place(column), place(row)}});
    });
  }


  template <unsigned int B>
  bool
  BlockSmoother<B>::set(const MatrixView<B> &A, const double factor)
  {
    pattern.for_pieces([&](const Piece &piece) {
      set_lower(pattern.row_start[piece.begin], pattern.row_start[piece.end], A.lower, factor);
    });
    set_lower(pattern.row_start[pattern.n_owned], pattern.n_entries(), A.lower, factor);
    sum_remote_couplings();
    return pattern.sum_over_pieces(
             [&](const Piece &piece) { return set_diagonal(piece, A, factor) ? 0. : 1.; }) == 0.;
  }


  template <unsigned int B>
  void
  BlockSmoother<B>::set_lower(const std::size_t begin,
                              const std::size_t end,
                              const double *values,
                              const double factor)
  {
    constexpr unsigned int row_size = MatrixView<B>::row_size;
    for (std::size_t row = B * begin; row < B * end; ++row)
      for (unsigned int j = 0; j < B; ++j)
        lower[B * row + j] = static_cast<float>(factor * values[row_size * row + j]);
  }


  template <unsigned int B>
  void
  BlockSmoother<B>::sum_remote_couplings()
  {
    for (RemoteSum &entry : remote)
      entry.sum.lanes = Lanes<float, B>{};
    auto index = remote_index.begin();
    pattern.for_outer_entries(
      [&](const std::size_t row, const std::size_t begin, const std::size_t end) {
        for (std::size_t k = begin; k < end; ++k, ++index)
          for (unsigned int i = 0; i < B; ++i)
            for (unsigned int j = 0; j < B; ++j)
              {
                const float half = 0.5f * std::abs(lower[B * (B * k + i) + j]);
                remote[(*index)[0]].sum.lanes[j] += half;
                if (row < pattern.n_owned)
                  remote[(*index)[1]].sum.lanes[i] += half;
              }
      });
  }


  namespace
  {
    template <unsigned int B>
    using Block = Eigen::Matrix<double, B, B>;


    /** Inverts a symmetric matrix; false if it is not positive definite. */
    bool
    invert(const Block<3> &D, Block<3> &inverse)
    {
      inverse = D.inverse();
      return D(0, 0) > 0. && D(0, 0) * D(1, 1) > D(0, 1) * D(1, 0) && D.determinant() > 0.;
    }


    bool
    invert(const Block<6> &D, Block<6> &inverse)
    {
      const Eigen::LLT<Block<6>> factor(D);
      inverse = factor.solve(Block<6>::Identity());
      return factor.info() == Eigen::Success;
    }


    /** Of D with a diagonal scaled to one; zero where D is not positive definite. */
    template <unsigned int B>
    double
    smallest_scaled_eigenvalue(const Block<B> &D)
    {
      const Eigen::Matrix<double, B, 1> scale = D.diagonal().cwiseSqrt().cwiseInverse();
      const Block<B> scaled                   = scale.asDiagonal() * D * scale.asDiagonal();
      const Eigen::SelfAdjointEigenSolver<Block<B>> solver(scaled, Eigen::EigenvaluesOnly);
      return std::max(0., solver.eigenvalues()[0]);
    }


    template <unsigned int B>
    void
    write(const Block<B> &block, NodeValues<B> *columns)
    {
      for (unsigned int j = 0; j < B; ++j)
        for (unsigned int i = 0; i < B; ++i)
          columns[j].lanes[i] = static_cast<float>(block(i, j));
    }

    constexpr double covered_share = 0.9; // of D; the rest keeps the sum definite
  }                                       // namespace


  template <unsigned int B>
  bool
  BlockSmoother<B>::set_diagonal(const Piece &piece, const MatrixView<B> &A, const double factor)
  {
    bool positive    = true;
    auto next_remote = std::lower_bound(remote.begin(),
                                        remote.end(),
                                        piece.begin,
                                        [](const RemoteSum &entry, const std::uint32_t node) {
                                          return entry.node < node;
                                        });
    for (std::size_t node = piece.begin; node < piece.end; ++node)
      {
        const double *values = A.diagonal + MatrixView<B>::block_size * node;
        Block<B> D, inverted;
        for (unsigned int i = 0; i < B; ++i)
          for (unsigned int j = 0; j < B; ++j)
            D(i, j) = factor * values[MatrixView<B>::row_size * i + j];
        write<B>(D, &diagonal[B * node]);
        if (next_remote != remote.end() && next_remote->node == node)
          {
            const double covered = 0.5 * covered_share * smallest_scaled_eigenvalue<B>(D);
            for (unsigned int i = 0; i < B; ++i)
              {
                float &sum = next_remote->sum.lanes[i];
                sum        = std::max(0., sum - covered * D(i, i));
                D(i, i) += sum;
              }
            ++next_remote;
          }
        positive = invert(D, inverted) && positive;
        write<B>(inverted, &inverse[B * node]);
      }
    return positive;
  }


  namespace
  {
    template <unsigned int B, int direction>
    inline void
    ask_for_block_ahead(const float *block)
    {
      constexpr std::size_t line = 64 / sizeof(float);
      for (std::size_t k = 0; k < B * B; k += line)
        ask_for_line_ahead<direction>(block + k);
    }
  } // namespace


  template <unsigned int B>
  template <int direction>
  inline Lanes<float, B>
  BlockSmoother<B>::row_product(const std::size_t begin,
                                const std::size_t end,
                                const NodeValues<B> *x) const
  {
    Lanes<float, B> sums[B]{};
    for (std::size_t k = begin; k < end; ++k)
      {
        if constexpr (direction != 0)
          ask_for_block_ahead<B, direction>(&lower[B * B * k]);
        const Lanes<float, B> x_j = x[pattern.column[k]].lanes;
        for (unsigned int i = 0; i < B; ++i)
          sums[i] += load<Lanes<float, B>>(&lower[B * (B * k + i)]) * x_j;
      }
    return sums_of_lanes(sums);
  }


  template <unsigned int B>
  inline void
  BlockSmoother<B>::add_transposed(const std::size_t begin,
                                   const std::size_t end,
                                   const Lanes<float, B> &x,
                                   NodeValues<B> *y) const
  {
    Lanes<float, B> factor[B];
    for (unsigned int i = 0; i < B; ++i)
      factor[i] = broadcast<B>(x[i]);
    for (std::size_t k = begin; k < end; ++k)
      {
        Lanes<float, B> sum = load<Lanes<float, B>>(&lower[B * B * k]) * factor[0];
        for (unsigned int i = 1; i < B; ++i)
          sum += load<Lanes<float, B>>(&lower[B * (B * k + i)]) * factor[i];
        y[pattern.column[k]].lanes += sum;
      }
  }


  namespace
  {
    template <unsigned int B>
    inline Lanes<float, B>
    combination(const NodeValues<B> *columns, const Lanes<float, B> &x)
    {
      Lanes<float, B> sum = columns[0].lanes * x[0];
      for (unsigned int j = 1; j < B; ++j)
        sum += columns[j].lanes * x[j];
      return sum;
    }
  } // namespace


  template <unsigned int B>
  Lanes<float, B>
  BlockSmoother<B>::solve_diagonal(const std::size_t node, const Lanes<float, B> &b) const
  {
    return combination<B>(&inverse[B * node], b);
  }


  template <unsigned int B>
  Lanes<float, B>
  BlockSmoother<B>::diagonal_product(const std::size_t node, const Lanes<float, B> &x) const
  {
    return combination<B>(&diagonal[B * node], x);
  }


  template <unsigned int B>
  float
  BlockSmoother<B>::diagonal_norm(const std::size_t node) const
  {
    float square = 0.f;
    for (unsigned int j = 0; j < B; ++j)
      for (unsigned int i = 0; i < B; ++i)
        square += diagonal[B * node + j].lanes[i] * diagonal[B * node + j].lanes[i];
    return std::sqrt(square);
  }


  template <unsigned int B>
  void
  BlockSmoother<B>::vmult(NodeValues<B> *y, const NodeValues<B> *x) const
  {
    // Row i comes after all rows it adds to, so that y[i] can be set and added to in one sweep.
    for (std::size_t i = 0; i < pattern.n_owned; ++i)
      {
        Lanes<float, B> sums[B]{}, x_i[B];
        for (unsigned int a = 0; a < B; ++a)
          x_i[a] = broadcast<B>(x[i].lanes[a]);
        for (std::size_t k = pattern.row_start[i]; k < pattern.row_start[i + 1]; ++k)
          {
            ask_for_block_ahead<B, 1>(&lower[B * B * k]);
            const std::uint32_t j     = pattern.column[k];
            const Lanes<float, B> x_j = x[j].lanes;
            Lanes<float, B> y_j       = y[j].lanes;
            for (unsigned int a = 0; a < B; ++a)
              {
                const auto row = load<Lanes<float, B>>(&lower[B * (B * k + a)]);
                sums[a] += row * x_j;
                y_j += row * x_i[a];
              }
            y[j].lanes = y_j;
          }
        y[i].lanes = diagonal_product(i, x[i].lanes) + sums_of_lanes(sums);
      }
    for (std::size_t i = pattern.n_owned; i < pattern.n_local; ++i)
      add_transposed(pattern.row_start[i], pattern.row_start[i + 1], x[i].lanes, y);
  }


  template <unsigned int B>
  void
  BlockSmoother<B>::forward(NodeValues<B> *x, NodeValues<B> *residual, const NodeValues<B> *b) const
  {
    for_pieces([=](const Piece &piece, const auto cut) {
      sweep_forward<decltype(cut)::value>(piece, x, residual, b);
    });
  }


  template <unsigned int B>
  template <bool cut>
  void
  BlockSmoother<B>::sweep_forward(const Piece &piece,
                                  NodeValues<B> *x,
                                  NodeValues<B> *residual,
                                  const NodeValues<B> *b) const
  {
    for (std::size_t i = piece.begin; i < piece.end; ++i)
      {
        const std::size_t begin = pattern.template inner_start<cut>(i),
                          end   = pattern.row_start[i + 1];

        const Lanes<float, B> x_i = solve_diagonal(i, b[i].lanes - row_product<1>(begin, end, x));
        x[i].lanes                = x_i;
        residual[i].lanes         = Lanes<float, B>{};
        add_transposed(begin, end, -x_i, residual);
      }
  }


  template <unsigned int B>
  void
  BlockSmoother<B>::subtract_remote(NodeValues<B> *residual, const NodeValues<B> *x) const
  {
    for (const RemoteSum &entry : remote)
      residual[entry.node].lanes += entry.sum.lanes * x[entry.node].lanes;
    pattern.for_outer_entries(
      [=](const std::size_t i, const std::size_t begin, const std::size_t end) {
        add_transposed(begin, end, -x[i].lanes, residual);
        if (i < pattern.n_owned)
          residual[i].lanes -= row_product<0>(begin, end, x);
      });
  }


  template <unsigned int B>
  void
  BlockSmoother<B>::backward(NodeValues<B> *x, NodeValues<B> *b) const
  {
    for_pieces(
      [=](const Piece &piece, const auto cut) { sweep_back<decltype(cut)::value>(piece, x, b); });
  }


  template <unsigned int B>
  template <bool cut>
  void
  BlockSmoother<B>::sweep_back(const Piece &piece, NodeValues<B> *x, NodeValues<B> *b) const
  {
    for (std::size_t i = piece.end; i-- > piece.begin;)
      {
        const std::size_t begin = pattern.template inner_start<cut>(i),
                          end   = pattern.row_start[i + 1];

        const Lanes<float, B> x_i = solve_diagonal(i, b[i].lanes - row_product<-1>(begin, end, x));
        x[i].lanes                = x_i;
        add_transposed(begin, end, -x_i, b);
      }
  }


  template <unsigned int B>
  void
  BlockSmoother<B>::backward(NodeValues<B> *x,
                             NodeValues<B> *b,
                             const NodeValues<B> *rhs,
                             NodeValues<B> *change,
                             NodeValues<B> *product) const
  {
    for_pieces([=](const Piece &piece, const auto cut) {
      sweep_back<decltype(cut)::value>(piece, x, b, rhs, change, product);
    });
  }


  template <unsigned int B>
  template <bool cut>
  void
  BlockSmoother<B>::sweep_back(const Piece &piece,
                               NodeValues<B> *x,
                               NodeValues<B> *b,
                               const NodeValues<B> *rhs,
                               NodeValues<B> *change,
                               NodeValues<B> *product) const
  {
    std::size_t row = piece.end; // of the product, all that follow are done
    for (std::size_t i = piece.end; i-- > piece.begin;)
      {
        const std::size_t begin = pattern.template inner_start<cut>(i),
                          end   = pattern.row_start[i + 1];

        const Lanes<float, B> x_i = solve_diagonal(i, b[i].lanes - row_product<-1>(begin, end, x));
        change[i].lanes           = x[i].lanes - x_i;
        x[i].lanes                = x_i;
        add_transposed(begin, end, -x_i, b);
        for (; row > i && first_column<cut>(row - 1) >= i; --row)
          product[row - 1].lanes =
            rhs[row - 1].lanes - row_product<0>(pattern.template inner_start<cut>(row - 1),
                                                pattern.row_start[row],
                                                change);
      }
  }


  template class BlockSmoother<3>;
  template class BlockSmoother<6>;
} // namespace Supple
