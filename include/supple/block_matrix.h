#ifndef supple_block_matrix_h
#define supple_block_matrix_h

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
  };


  /** A symmetric matrix of 3x3 blocks (stored by rows, with one spare block that collects what is
   * not wanted). */
  class SymmetricBlockMatrix
  {
  public:
    SymmetricBlockMatrix(const SymmetricPattern &pattern);

    void
    set_zero();

    /** A += factor I */
    void
    add_to_diagonal(double factor);

    /** y = A x for the owned rows; x must have valid ghost values. Arrays of 3 n_local doubles. */
    void
    vmult(double *y, const double *x) const;

    const SymmetricPattern &pattern;
    std::vector<double> lower;    ///< 9 (n_entries + 1)
    std::vector<double> diagonal; ///< 9 (n_owned + 1)
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
    std::vector<double> lower;    ///< n_entries + 1
    std::vector<double> diagonal; ///< n_owned + 1
  };
} // namespace Supple

#endif
