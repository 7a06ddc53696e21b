#include <supple/base/memory.h>
#include <supple/multigrid/coarsening.h>

#include <deal.II/base/mpi.h>

#include <Eigen/Dense>

#include <algorithm>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    // What remains of a motion beside the others, at the least, to count as another one.
    constexpr double independent = 1e-6;


    /** Makes the columns of Q orthonormal, Q R = old Q; those that depend on others become zero. */
    void
    make_orthonormal(Eigen::Ref<Eigen::MatrixXd> Q, double *R)
    {
      for (unsigned int j = 0; j < 6; ++j)
        {
          auto column         = Q.col(j);
          const double before = column.norm();
          for (unsigned int repetition = 0; repetition < 2; ++repetition)
            for (unsigned int i = 0; i < j; ++i)
              {
                const double part = Q.col(i).dot(column);
                R[6 * i + j] += part;
                column -= part * Q.col(i);
              }
          const double norm = column.norm();
          if (norm > independent * before)
            {
              R[6 * j + j] = norm;
              column /= norm;
            }
          else
            column.setZero();
        }
    }
  } // namespace


  template <unsigned int B>
  void
  Coarsening<B>::refresh(const MatrixView<B> &A,
                         const double factor,
                         const std::vector<double> &modes)
  {
    set_tentative(modes);
    for (std::size_t node = 0; node < fine.pattern.n_owned; ++node)
      smooth(node);
    if (distributed())
      update_ghost_rows();
    multiply(A);
    set_dead_unknowns(1. / factor);
  }


  template <unsigned int B>
  void
  Coarsening<B>::set_tentative(const std::vector<double> &modes)
  {
    std::fill(coarse.modes.begin(), coarse.modes.end(), 0.);
    const std::uint32_t first = coarse.numbers.local(first_own);
    Eigen::MatrixXd storage;
    for (std::uint32_t a = 0; a < n_own; ++a)
      {
        const std::uint32_t *const nodes = &member[member_start[a]];
        const std::uint32_t n            = member_start[a + 1] - member_start[a];
        if (storage.rows() < B * n)
          storage.resize(B * n, 6);
        auto Q = storage.topRows(B * n);
        for (std::uint32_t k = 0; k < n; ++k)
          for (unsigned int i = 0; i < B; ++i)
            for (unsigned int j = 0; j < 6; ++j)
              Q(B * k + i, j) = modes[6 * (B * std::size_t(nodes[k]) + i) + j];
        make_orthonormal(Q, &coarse.modes[36 * std::size_t(first + a)]);
        for (std::uint32_t k = 0; k < n; ++k)
          for (unsigned int i = 0; i < B; ++i)
            for (unsigned int j = 0; j < 6; ++j)
              tentative[nodes[k]].row[i].lanes[j] = static_cast<float>(Q(B * k + i, j));
      }
    if (distributed())
      halo->update(tentative.data());
    if (replicates())
      Utilities::MPI::sum(coarse.modes, halo->communicator(), coarse.modes);
  }


  /** The row (I - w D^-1 A) T of P. */
  template <unsigned int B>
  void
  Coarsening<B>::smooth(const std::size_t node)
  {
    const std::uint32_t begin = row_start[node], n = row_start[node + 1] - begin;
    for (std::uint32_t q = 0; q < n; ++q)
      {
        mark[column[begin + q]] = q;
        smoothed[q]             = Rows();
      }

    // A T
    for (std::uint32_t k = adjacency.start[node]; k < adjacency.start[node + 1]; ++k)
      {
        const std::uint32_t other = adjacency.neighbor[k];
        if (aggregate_of[other] == no_aggregate)
          continue;
        const float *block  = &fine.lower[B * B * std::size_t(adjacency.entry[k])];
        const bool mirrored = other > node;
        const Rows &T       = tentative[other];
        Rows &sum           = smoothed[mark[aggregate_of[other]]];
        for (unsigned int i = 0; i < B; ++i)
          for (unsigned int j = 0; j < B; ++j)
            sum.row[i].lanes += block[mirrored ? B * j + i : B * i + j] * T.row[j].lanes;
      }
    const std::uint32_t own = aggregate_of[node];
    if (own != no_aggregate)
      for (unsigned int i = 0; i < B; ++i)
        for (unsigned int j = 0; j < B; ++j)
          smoothed[mark[own]].row[i].lanes +=
            fine.diagonal[B * node + j].lanes[i] * tentative[node].row[j].lanes;

    const float w = -4. / 3. / largest_eigenvalue;
    for (std::uint32_t q = 0; q < n; ++q)
      {
        Rows rows = Rows();
        for (unsigned int i = 0; i < B; ++i)
          for (unsigned int j = 0; j < B; ++j)
            rows.row[i].lanes +=
              (w * fine.inverse[B * node + j].lanes[i]) * smoothed[q].row[j].lanes;
        if (column[begin + q] == own)
          for (unsigned int i = 0; i < B; ++i)
            rows.row[i].lanes += tentative[node].row[i].lanes;
        smoothed[q] = rows;
      }
    round(node);
  }


  template <unsigned int B>
  void
  Coarsening<B>::round(const std::size_t node)
  {
    constexpr float largest_whole = 32767.f;

    const std::uint32_t begin = row_start[node], n = row_start[node + 1] - begin;
    Lanes<float, 6> largest_lanes{};
    for (std::uint32_t q = 0; q < n; ++q)
      for (const NodeValues<6> &row : smoothed[q].row)
        {
          const Lanes<float, 6> size = row.lanes < 0.f ? -row.lanes : row.lanes;
          largest_lanes              = size > largest_lanes ? size : largest_lanes;
        }
    float largest = 0.f;
    for (unsigned int j = 0; j < 6; ++j)
      largest = std::max(largest, largest_lanes[j]);
    scale[node]         = largest / largest_whole;
    const float inverse = largest > 0.f ? largest_whole / largest : 0.f;

    std::int16_t *value = values.data() + 6 * B * std::size_t(begin);
    for (std::uint32_t q = 0; q < n; ++q)
      for (const NodeValues<6> &row : smoothed[q].row)
        {
          const Lanes<float, 6> exact = row.lanes * inverse;
          store_converted(exact +
                            (exact < 0.f ? Lanes<float, 6>{} - 0.5f : Lanes<float, 6>{} + 0.5f),
                          value);
          value += 6;
        }
  }


  template <unsigned int B>
  void
  Coarsening<B>::update_ghost_rows()
  {
    const std::size_t entry_size = 6 * B * sizeof(std::int16_t);
    const auto for_rows          = [&](std::uint32_t begin, std::uint32_t end, const auto &action) {
      for (std::uint32_t node = begin; node < end; ++node)
        if (row_start[node + 1] > row_start[node])
          action(ghost_records.data() + node * longest_row * entry_size,
                 values.data() + 6 * B * std::size_t(row_start[node]),
                 (row_start[node + 1] - row_start[node]) * entry_size);
    };
    for_rows(0,
             fine.pattern.n_owned,
             [](char *record, const std::int16_t *row, const std::size_t size) {
               std::memcpy(record, row, size);
             });
    halo->update(ghost_records.data(), longest_row * entry_size);
    halo->update(scale.data());
    for_rows(fine.pattern.n_owned,
             fine.pattern.n_local,
             [](const char *record, std::int16_t *row, const std::size_t size) {
               std::memcpy(row, record, size);
             });
  }


  namespace
  {
    template <unsigned int B>
    inline void
    widen(const std::int16_t *rows, const double factor, Lanes<double, 6> (&wide)[B])
    {
      for (unsigned int i = 0; i < B; ++i)
        wide[i] = factor * load_converted<double>(rows + 6 * i);
    }


    /** block += U^T V */
    template <unsigned int B>
    inline void
    add_product(CoarseMatrix::Block &block,
                const Lanes<double, 6> (&U)[B],
                const Lanes<double, 6> (&V)[B])
    {
      // Copies stay in registers, for all the compiler knows about what the block may overwrite.
      Lanes<double, 6> v[B];
      for (unsigned int j = 0; j < B; ++j)
        v[j] = V[j];
      const double *const u = reinterpret_cast<const double *>(U);
      for (unsigned int i = 0; i < 6; ++i)
        {
          Lanes<double, 6> row = block.row[i];
          for (unsigned int j = 0; j < B; ++j)
            row += u[8 * j + i] * v[j];
          block.row[i] = row;
        }
    }
  } // namespace


  namespace
  {
    void
    sum_over_all(std::vector<CoarseMatrix::Block> &blocks, const MPI_Comm communicator)
    {
      MPI_Allreduce(MPI_IN_PLACE,
                    blocks.data(),
                    sizeof(CoarseMatrix::Block) / sizeof(double) * blocks.size(),
                    MPI_DOUBLE,
                    MPI_SUM,
                    communicator);
    }
  } // namespace


  /**
   * A_coarse = P^T A P = S + S^T with S = P^T (L + D/2) P, row by row of L + D/2. Rows of ghosts
   * are known to two processes, and each adds half of them.
   */
  template <unsigned int B>
  void
  Coarsening<B>::multiply(const MatrixView<B> &A)
  {
    const SymmetricPattern &pattern = fine.pattern;
    CoarseMatrix &matrix            = coarse.matrix;
    std::fill(matrix.lower.begin(), matrix.lower.end(), CoarseMatrix::Block());
    std::fill(matrix.diagonal.begin(), matrix.diagonal.end(), CoarseMatrix::Block());

    const std::uint32_t *slot = slots.data();
    for (std::size_t i = 0; i < pattern.n_local; ++i)
      {
        for (std::uint32_t f = product_start[i]; f < product_start[i + 1]; ++f)
          mark[product_column[f]] = f - product_start[i];
        std::fill_n(product.begin(), product_start[i + 1] - product_start[i], WideRows());
        const double weight = i < pattern.n_owned ? 1. : 0.5;
        if (i < pattern.n_owned)
          add_to_product(A.diagonal + MatrixView<B>::block_size * i, 0.5, i);
        for (std::size_t k = pattern.row_start[i]; k < pattern.row_start[i + 1]; ++k)
          add_to_product(A.lower + MatrixView<B>::block_size * k, weight, pattern.column[k]);
        add_row(i, slot);
      }
    if (exchange)
      exchange->sum(matrix);
    if (replicates())
      {
        sum_over_all(matrix.lower, halo->communicator());
        sum_over_all(matrix.diagonal, halo->communicator());
      }
  }


  template <unsigned int B>
  inline void
  Coarsening<B>::add_to_product(const double *block, const double weight, const std::size_t j)
  {
    const double factor = weight * scale[j];
    for (std::uint32_t q = row_start[j]; q < row_start[j + 1]; ++q)
      {
        Lanes<double, 6> P[B];
        widen<B>(&values[6 * B * std::size_t(q)], factor, P);
        WideRows &sums = product[mark[column[q]]];
        for (unsigned int a = 0; a < B; ++a)
          {
            Lanes<double, 6> sum = sums.row[a];
            for (unsigned int b = 0; b < B; ++b)
              sum += block[MatrixView<B>::row_size * a + b] * P[b];
            sums.row[a] = sum;
          }
      }
  }


  template <unsigned int B>
  inline void
  Coarsening<B>::add_row(const std::size_t i, const std::uint32_t *&slot)
  {
    for (std::uint32_t q = row_start[i]; q < row_start[i + 1]; ++q)
      {
        widen<B>(&values[6 * B * std::size_t(q)], scale[i], prolongation.row);
        for (std::uint32_t f = product_start[i]; f < product_start[i + 1]; ++f)
          {
            const std::uint32_t place = *slot++;
            const WideRows *rows[]    = {&prolongation, &product[f - product_start[i]]};
            const bool swapped        = column[q] < product_column[f];
            if (column[q] != product_column[f])
              add_product<B>(coarse.matrix.lower[place], rows[swapped]->row, rows[!swapped]->row);
            else
              {
                add_product<B>(coarse.matrix.diagonal[place], rows[0]->row, rows[1]->row);
                add_product<B>(coarse.matrix.diagonal[place], rows[1]->row, rows[0]->row);
              }
          }
      }
  }


  /** Motions that depend on others have no column in P; they stay alone with a diagonal entry. */
  template <unsigned int B>
  void
  Coarsening<B>::set_dead_unknowns(const double diagonal_entry)
  {
    for (std::size_t a = 0; a < coarse.numbers.n_owned; ++a)
      for (unsigned int i = 0; i < 6; ++i)
        if (coarse.modes[36 * a + 7 * i] == 0.)
          coarse.matrix.diagonal[a].row[i][i] = diagonal_entry;
  }


  template <unsigned int B>
  void
  Coarsening<B>::restrict_residual(const SymmetricPattern::Piece &piece,
                                   NodeValues<6> *coarse_values,
                                   const NodeValues<B> *residual) const
  {
    std::fill(coarse_values, coarse_values + coarse.numbers.n_local(), NodeValues<6>());
    for (std::size_t node = piece.begin; node < piece.end; ++node)
      {
        Lanes<float, 6> factor[B];
        for (unsigned int i = 0; i < B; ++i)
          factor[i] = broadcast<6>(scale[node] * residual[node].lanes[i]);
        for (std::uint32_t q = row_start[node]; q < row_start[node + 1]; ++q)
          {
            const std::int16_t *rows = &values[6 * B * std::size_t(q)];
            ask_for_line_ahead(rows);
            Lanes<float, 6> sum = load_converted<float>(rows) * factor[0];
            for (unsigned int i = 1; i < B; ++i)
              sum += load_converted<float>(rows + 6 * i) * factor[i];
            coarse_values[column[q]].lanes += sum;
          }
      }
  }


  template <unsigned int B>
  void
  Coarsening<B>::restrict_residual(NodeValues<6> *coarse_values, const NodeValues<B> *residual)
  {
    fine.pattern.for_pieces([&](const SymmetricPattern::Piece &piece) {
      NodeValues<6> *const sums =
        piece.number == 0 ? coarse_values : partial_sums[piece.number - 1].data();
      restrict_residual(piece, sums, residual);
    });
    for (const std::vector<NodeValues<6>> &sums : partial_sums)
      for (std::size_t a = 0; a < sums.size(); ++a)
        coarse_values[a].lanes += sums[a].lanes;
    if (coarse.halo)
      coarse.halo->add_ghosts(coarse_values);
    if (replicates())
      MPI_Allreduce(MPI_IN_PLACE,
                    coarse_values,
                    coarse.numbers.n_local() * sizeof(NodeValues<6>) / sizeof(float),
                    MPI_FLOAT,
                    MPI_SUM,
                    halo->communicator());
  }


  template <unsigned int B>
  void
  Coarsening<B>::add_correction(NodeValues<B> *x, NodeValues<6> *coarse_values) const
  {
    if (coarse.halo)
      coarse.halo->update(coarse_values);
    fine.pattern.for_pieces([=](const SymmetricPattern::Piece &piece) {
      add_correction(piece.begin, piece.end, x, coarse_values);
    });
    add_correction(fine.pattern.n_owned, fine.pattern.n_local, x, coarse_values);
  }


  template <unsigned int B>
  void
  Coarsening<B>::add_correction(const std::size_t begin,
                                const std::size_t end,
                                NodeValues<B> *x,
                                const NodeValues<6> *coarse_values) const
  {
    for (std::size_t node = begin; node < end; ++node)
      {
        Lanes<float, 6> sums[B]{};
        for (std::uint32_t q = row_start[node]; q < row_start[node + 1]; ++q)
          {
            const std::int16_t *rows = &values[6 * B * std::size_t(q)];
            ask_for_line_ahead(rows);
            const Lanes<float, 6> unknown = coarse_values[column[q]].lanes;
            for (unsigned int i = 0; i < B; ++i)
              sums[i] += load_converted<float>(rows + 6 * i) * unknown;
          }
        x[node].lanes += scale[node] * sums_of_lanes(sums);
      }
  }


  template class Coarsening<3>;
  template class Coarsening<6>;
} // namespace Supple
