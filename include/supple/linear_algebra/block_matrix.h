#ifndef supple_block_matrix_h
#define supple_block_matrix_h

#include <supple/base/threads.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace Supple
{
  /**
   * Where a symmetric matrix on the nodes of a mesh has entries, seen from one process.
   *
   * Nodes have local numbers: first those this process owns, then the ghosts next to them. Kept are
   * the entries below the diagonal, (i, j) with i > j and j owned: for an owned row i the entry
   * stands for itself and for its transpose, for a ghost row i only for its transpose, which is in
   * the owned row j. So one process holds all of its rows, and half of the memory is saved.
   *
   * The owned rows may be cut into pieces, one for each thread. A row's inner entries couple it to
   * its own piece: pieces do not disturb each other with them, whoever is first. The outer ones,
   * those to the pieces before and all of ghost rows, come afterwards on one thread: they are few
   * if the nodes are numbered along the body.
   */
  struct SymmetricPattern
  {
    unsigned int n_owned = 0;
    unsigned int n_local = 0;
    std::vector<std::size_t> row_start; ///< n_local + 1 positions into column
    std::vector<std::uint32_t> column;  ///< ascending within a row, each below n_owned

    std::size_t
    n_entries() const
    {
      return column.size();
    }

    /** The position of the entry (row, column); n_entries() where there is none. */
    std::size_t
    position(unsigned int row, unsigned int column) const;

    /** Owned rows that one thread does. */
    struct Piece
    {
      unsigned int number;
      std::uint32_t begin, end;
    };

    /** Cuts the owned rows into pieces with about as many entries each. */
    void
    cut(unsigned int n_pieces);

    unsigned int
    n_pieces() const
    {
      return piece_start.empty() ? 1 : piece_start.size() - 1;
    }

    /** Whether there is more than one piece. */
    bool
    is_cut() const
    {
      return !piece_start.empty();
    }

    /** Where the inner entries of an owned row begin; they end where the row does. Sweeps know
     * whether there are pieces when they are compiled: one pointer less. */
    template <bool cut>
    std::size_t
    inner_start(const std::size_t row) const
    {
      return cut ? inner[row] : row_start[row];
    }

    /** action(piece), on several threads. */
    template <class Action>
    void
    for_pieces(const Action &action) const
    {
      run_tasks(n_pieces(), [&](const unsigned int p) {
        action(is_cut() ? Piece{p, piece_start[p], piece_start[p + 1]} : Piece{0, 0, n_owned});
      });
    }

    /** The sum of action(piece), in the order of the pieces. */
    template <class Action>
    double
    sum_over_pieces(const Action &action) const
    {
      if (!is_cut())
        return action(Piece{0, 0, n_owned});
      std::vector<double> parts(n_pieces());
      for_pieces([&](const Piece &piece) { parts[piece.number] = action(piece); });
      double sum = 0.;
      for (const double part : parts)
        sum += part;
      return sum;
    }

    /** action(row, begin, end) with the inner entries of each owned row, on several threads. */
    template <class Action>
    void
    for_inner_entries(const Action &action) const
    {
      if (is_cut())
        for_pieces([&](const Piece &piece) {
          for (std::size_t row = piece.begin; row < piece.end; ++row)
            action(row, inner[row], row_start[row + 1]);
        });
      else
        for (std::size_t row = 0; row < n_owned; ++row)
          action(row, row_start[row], row_start[row + 1]);
    }

    /** action(row, begin, end) with the outer entries of the rows that have some. */
    template <class Action>
    void
    for_outer_entries(const Action &action) const
    {
      for (const std::size_t row : outer_rows)
        action(row, row_start[row], inner[row]);
      for (std::size_t row = n_owned; row < n_local; ++row)
        action(row, row_start[row], row_start[row + 1]);
    }

  private:
    std::vector<std::uint32_t> piece_start; ///< none: one piece
    std::vector<std::size_t> inner;         ///< none: all entries of owned rows are inner ones
    std::vector<std::uint32_t> outer_rows;  ///< owned ones
  };


  /** A symmetric matrix of 3x3 blocks (stored by rows, with a spare block for each piece of the
   * pattern that collects what is not wanted). */
  class SymmetricBlockMatrix
  {
  public:
    SymmetricBlockMatrix(const SymmetricPattern &pattern);

    /** Takes the size of the pattern, which has become another one; all entries are zero then. */
    void
    fit_pattern();

    void
    set_zero();

    /** A += factor I */
    void
    add_to_diagonal(double factor);

    /** y = A x for the owned rows; x must have valid ghost values. Arrays of 3 n_local doubles. */
    void
    vmult(double *y, const double *x) const;

    const SymmetricPattern &pattern;
    std::vector<double> lower;    ///< 9 (n_entries + n_pieces)
    std::vector<double> diagonal; ///< 9 (n_owned + n_pieces)
  };


  /** A symmetric matrix of 3x3 blocks which are multiples of the identity: the mass matrix. */
  class SymmetricScalarMatrix
  {
  public:
    SymmetricScalarMatrix(const SymmetricPattern &pattern);

    /** y = A x for the owned rows, as SymmetricBlockMatrix::vmult(). */
    void
    vmult(double *y, const double *x) const;

    const SymmetricPattern &pattern;
    std::vector<double> lower;    ///< n_entries + n_pieces
    std::vector<double> diagonal; ///< n_owned + n_pieces
  };
} // namespace Supple

#endif
