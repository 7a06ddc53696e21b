#include <supple/linear_algebra/block_matrix.h>

#include <supple/base/memory.h>

#include <algorithm>
#include <array>

namespace Supple
{
  std::size_t
  SymmetricPattern::position(const unsigned int row, const unsigned int wanted) const
  {
    const auto begin = column.begin() + row_start[row];
    const auto end   = column.begin() + row_start[row + 1];
    const auto found = std::lower_bound(begin, end, wanted);
    return (found != end && *found == wanted) ? found - column.begin() : n_entries();
  }


  void
  SymmetricPattern::cut(const unsigned int n_pieces)
  {
    piece_start.clear();
    inner.clear();
    outer_rows.clear();
    if (n_pieces == 1)
      return;
    for (std::size_t p = 0; p <= n_pieces; ++p)
      {
        // A row costs about as much as its block on the diagonal does.
        const auto cost  = [&](const std::size_t row) { return row_start[row] + row; };
        std::size_t low  = 0;
        std::size_t high = n_owned;
        while (low < high)
          {
            const std::size_t middle = (low + high) / 2;
            if (cost(middle) * n_pieces < p * cost(n_owned))
              low = middle + 1;
            else
              high = middle;
          }
        piece_start.push_back(low);
      }
    inner.assign(row_start.begin(), row_start.begin() + n_owned);
    for (unsigned int p = 1; p < n_pieces; ++p)
      for (std::uint32_t row = piece_start[p]; row < piece_start[p + 1]; ++row)
        {
          while (inner[row] < row_start[row + 1] && column[inner[row]] < piece_start[p])
            ++inner[row];
          if (inner[row] > row_start[row])
            outer_rows.push_back(row);
        }
  }


  SymmetricBlockMatrix::SymmetricBlockMatrix(const SymmetricPattern &pattern)
    : pattern(pattern)
  {
    fit_pattern();
  }


  void
  SymmetricBlockMatrix::fit_pattern()
  {
    diagonal.assign(9 * (pattern.n_owned + pattern.n_pieces()), 0.);
    lower.clear();
    resize_in_huge_pages(lower, 9 * (pattern.n_entries() + pattern.n_pieces()));
  }


  void
  SymmetricBlockMatrix::set_zero()
  {
    pattern.for_pieces([this](const SymmetricPattern::Piece &piece) {
      std::fill(diagonal.data() + 9 * std::size_t(piece.begin),
                diagonal.data() + 9 * std::size_t(piece.end),
                0.);
      std::fill(lower.data() + 9 * pattern.row_start[piece.begin],
                lower.data() + 9 * pattern.row_start[piece.end],
                0.);
    });
    std::fill(lower.begin() + 9 * pattern.row_start[pattern.n_owned], lower.end(), 0.);
    std::fill(diagonal.begin() + 9 * std::size_t(pattern.n_owned), diagonal.end(), 0.);
  }


  void
  SymmetricBlockMatrix::add_to_diagonal(const double factor)
  {
    for (std::size_t node = 0; node < pattern.n_owned; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        diagonal[9 * node + 4 * i] += factor;
  }


  namespace
  {
    using Sum = std::array<double, 3>;


    /** sum += A_ij x_j and y_j += A_ij^T x_i for entries of a row. */
    inline void
    add_blocks(const SymmetricBlockMatrix &A,
               const std::size_t i,
               const std::size_t begin,
               const std::size_t end,
               double *y,
               const double *x,
               Sum &sum)
    {
      const double x0 = x[3 * i], x1 = x[3 * i + 1], x2 = x[3 * i + 2];
      for (std::size_t k = begin; k < end; ++k)
        {
          const double *a = &A.lower[9 * k];
          ask_for_line_ahead(a);
          const double *xj = x + 3 * static_cast<std::size_t>(A.pattern.column[k]);
          double *yj       = y + 3 * static_cast<std::size_t>(A.pattern.column[k]);

          sum[0] += a[0] * xj[0] + a[1] * xj[1] + a[2] * xj[2];
          sum[1] += a[3] * xj[0] + a[4] * xj[1] + a[5] * xj[2];
          sum[2] += a[6] * xj[0] + a[7] * xj[1] + a[8] * xj[2];
          yj[0] += a[0] * x0 + a[3] * x1 + a[6] * x2;
          yj[1] += a[1] * x0 + a[4] * x1 + a[7] * x2;
          yj[2] += a[2] * x0 + a[5] * x1 + a[8] * x2;
        }
    }


    /** The same where A_ij is a multiple of the identity. */
    inline void
    add_multiples(const SymmetricScalarMatrix &A,
                  const std::size_t i,
                  const std::size_t begin,
                  const std::size_t end,
                  double *y,
                  const double *x,
                  Sum &sum)
    {
      const double x0 = x[3 * i], x1 = x[3 * i + 1], x2 = x[3 * i + 2];
      for (std::size_t k = begin; k < end; ++k)
        {
          const double a   = A.lower[k];
          const double *xj = x + 3 * static_cast<std::size_t>(A.pattern.column[k]);
          double *yj       = y + 3 * static_cast<std::size_t>(A.pattern.column[k]);

          sum[0] += a * xj[0];
          sum[1] += a * xj[1];
          sum[2] += a * xj[2];
          yj[0] += a * x0;
          yj[1] += a * x1;
          yj[2] += a * x2;
        }
    }


    /** y = A x of owned rows: diagonal(i) is what a row begins with, and add(i, begin, end, sum)
     * adds entries of it to its sum and the transposed ones to y. */
    template <class Diagonal, class Add>
    void
    multiply(const SymmetricPattern &pattern, double *y, const Diagonal &diagonal, const Add &add)
    {
      // Row i comes after all rows it adds to, so that y[i] can be set and added to in one sweep.
      pattern.for_inner_entries(
        [&](const std::size_t i, const std::size_t begin, const std::size_t end) {
          Sum sum = diagonal(i);
          add(i, begin, end, sum);
          for (unsigned int a = 0; a < 3; ++a)
            y[3 * i + a] = sum[a];
        });
      pattern.for_outer_entries(
        [&](const std::size_t i, const std::size_t begin, const std::size_t end) {
          Sum sum{};
          add(i, begin, end, sum);
          for (unsigned int a = 0; a < 3 && i < pattern.n_owned; ++a)
            y[3 * i + a] += sum[a];
        });
    }
  } // namespace


  void
  SymmetricBlockMatrix::vmult(double *y, const double *x) const
  {
    multiply(
      pattern,
      y,
      [=](const std::size_t i) {
        const double x0 = x[3 * i], x1 = x[3 * i + 1], x2 = x[3 * i + 2];
        const double *d = &diagonal[9 * i];
        return Sum{{d[0] * x0 + d[1] * x1 + d[2] * x2,
                    d[3] * x0 + d[4] * x1 + d[5] * x2,
                    d[6] * x0 + d[7] * x1 + d[8] * x2}};
      },
      [=](const std::size_t i, const std::size_t begin, const std::size_t end, Sum &sum) {
        add_blocks(*this, i, begin, end, y, x, sum);
      });
  }


  SymmetricScalarMatrix::SymmetricScalarMatrix(const SymmetricPattern &pattern)
    : pattern(pattern)
    , lower(pattern.n_entries() + pattern.n_pieces())
    , diagonal(pattern.n_owned + pattern.n_pieces())
  {
  }


  void
  SymmetricScalarMatrix::vmult(double *y, const double *x) const
  {
    multiply(
      pattern,
      y,
      [=](const std::size_t i) {
        const double d = diagonal[i];
        return Sum{{d * x[3 * i], d * x[3 * i + 1], d * x[3 * i + 2]}};
      },
      [=](const std::size_t i, const std::size_t begin, const std::size_t end, Sum &sum) {
        add_multiples(*this, i, begin, end, y, x, sum);
      });
  }
} // namespace Supple
