#include <supple/block_matrix.h>
#include <supple/huge_pages.h>
#include <supple/prefetch.h>

#include <algorithm>

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


  SymmetricBlockMatrix::SymmetricBlockMatrix(const SymmetricPattern &pattern)
    : pattern(pattern)
    , diagonal(9 * (pattern.n_owned + 1))
  {
    resize_in_huge_pages(lower, 9 * (pattern.n_entries() + 1));
  }


  void
  SymmetricBlockMatrix::set_zero()
  {
    std::fill(lower.begin(), lower.end(), 0.);
    std::fill(diagonal.begin(), diagonal.end(), 0.);
  }


  void
  SymmetricBlockMatrix::add_to_diagonal(const double factor)
  {
    for (std::size_t node = 0; node < pattern.n_owned; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        diagonal[9 * node + 4 * i] += factor;
  }


  void
  SymmetricBlockMatrix::vmult(double *y, const double *x) const
  {
    // Row i comes after all rows it adds to, so that y[i] can be set and added to in one sweep.
    for (unsigned int i = 0; i < pattern.n_local; ++i)
      {
        const bool owned = i < pattern.n_owned;
        const double x0 = x[3 * i], x1 = x[3 * i + 1], x2 = x[3 * i + 2];
        double y0 = 0., y1 = 0., y2 = 0.;
        if (owned)
          {
            const double *d = &diagonal[9 * static_cast<std::size_t>(i)];

            y0 = d[0] * x0 + d[1] * x1 + d[2] * x2;
            y1 = d[3] * x0 + d[4] * x1 + d[5] * x2;
            y2 = d[6] * x0 + d[7] * x1 + d[8] * x2;
          }
        for (std::size_t k = pattern.row_start[i]; k < pattern.row_start[i + 1]; ++k)
          {
            const double *a = &lower[9 * k];
            ask_for_line_ahead(a);
            const double *xj = x + 3 * static_cast<std::size_t>(pattern.column[k]);
            double *yj       = y + 3 * static_cast<std::size_t>(pattern.column[k]);

            y0 += a[0] * xj[0] + a[1] * xj[1] + a[2] * xj[2];
            y1 += a[3] * xj[0] + a[4] * xj[1] + a[5] * xj[2];
            y2 += a[6] * xj[0] + a[7] * xj[1] + a[8] * xj[2];
            yj[0] += a[0] * x0 + a[3] * x1 + a[6] * x2;
            yj[1] += a[1] * x0 + a[4] * x1 + a[7] * x2;
            yj[2] += a[2] * x0 + a[5] * x1 + a[8] * x2;
          }
        if (owned)
          {
            y[3 * i]     = y0;
            y[3 * i + 1] = y1;
            y[3 * i + 2] = y2;
          }
      }
  }


  SymmetricScalarMatrix::SymmetricScalarMatrix(const SymmetricPattern &pattern)
    : pattern(pattern)
    , lower(pattern.n_entries() + 1)
    , diagonal(pattern.n_owned + 1)
  {
  }


  void
  SymmetricScalarMatrix::vmult(double *y, const double *x) const
  {
    for (unsigned int i = 0; i < pattern.n_local; ++i)
      {
        const bool owned = i < pattern.n_owned;
        const double x0 = x[3 * i], x1 = x[3 * i + 1], x2 = x[3 * i + 2];
        const double d = owned ? diagonal[i] : 0.;
        double y0 = d * x0, y1 = d * x1, y2 = d * x2;
        for (std::size_t k = pattern.row_start[i]; k < pattern.row_start[i + 1]; ++k)
          {
            const double a   = lower[k];
            const double *xj = x + 3 * static_cast<std::size_t>(pattern.column[k]);
            double *yj       = y + 3 * static_cast<std::size_t>(pattern.column[k]);

            y0 += a * xj[0];
            y1 += a * xj[1];
            y2 += a * xj[2];
            yj[0] += a * x0;
            yj[1] += a * x1;
            yj[2] += a * x2;
          }
        if (owned)
          {
            y[3 * i]     = y0;
            y[3 * i + 1] = y1;
            y[3 * i + 2] = y2;
          }
      }
  }
} // namespace Supple
