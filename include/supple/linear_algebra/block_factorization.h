#ifndef supple_block_factorization_h
#define supple_block_factorization_h

#include <supple/linear_algebra/block_matrix.h>
#include <supple/linear_algebra/lanes.h>

#include <cstdint>
#include <vector>

namespace Supple
{
  /**
   * The factorization A = L D L^T of a symmetric positive definite matrix of 3x3 blocks, with
   * blocks in L and D too, row by row (the up-looking algorithm of Davis 2005,
   * doi:10.1145/1114268.1114277). Nodes are ordered by approximate minimum degree, so one index
   * serves nine entries, and the entries of a row of a block are computed side by side.
   */
  class BlockFactorization
  {
  public:
    /** Finds the order of the nodes and the pattern of L. @param pattern of A, on one process */
    explicit BlockFactorization(const SymmetricPattern &pattern);

    /** @return false if A is not positive definite */
    bool
    factorize(const SymmetricBlockMatrix &A);

    /** x = A^-1 b, 3 n_owned doubles each. */
    void
    solve(double *x, const double *b);

  private:
    using Row = Lanes<double, 3>; ///< three entries and a zero

    struct Block
    {
      Row rows[3];
    };

    /** A block of A in a row of the reordered matrix. */
    struct Entry
    {
      std::uint32_t column;
      bool transposed;
      std::size_t position; ///< in the lower triangle of A
    };

    /** A block of L in the row that is computed. */
    struct Factor
    {
      std::uint32_t column;
      std::size_t place; ///< among the blocks of L
    };

    void
    find_order(const SymmetricPattern &pattern);

    void
    find_entries(const SymmetricPattern &pattern);

    /** The pattern of L, from the elimination tree. */
    void
    find_factors();

    /** The rows of A in the columns of this one, spread out over row_of_A. */
    void
    spread(const SymmetricBlockMatrix &A, std::uint32_t row);

    /** @return whether the diagonal block is positive definite */
    bool
    factorize_row(const SymmetricBlockMatrix &A, std::uint32_t row);

    const unsigned int n;              ///< nodes
    std::vector<std::uint32_t> node;   ///< of each row
    std::vector<std::uint32_t> row_of; ///< of each node
    std::vector<std::size_t> entry_start, factor_start, column_start;
    std::vector<Entry> entries;            ///< of A, by rows
    std::vector<Factor> factors;           ///< of L, by rows
    std::vector<std::uint32_t> factor_row; ///< of each block of L, by columns
    std::vector<Block> L;                  ///< transposed blocks, by columns
    std::vector<Block> inverse_diagonal;   ///< of D
    std::vector<Block> row_of_A;           ///< at hand
    std::vector<Row> solution;             ///< at hand
  };
} // namespace Supple

#endif
