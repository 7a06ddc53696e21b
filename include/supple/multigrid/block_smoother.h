#ifndef supple_block_smoother_h
#define supple_block_smoother_h

#include <supple/linear_algebra/block_matrix.h>
#include <supple/linear_algebra/lanes.h>

#include <array>
#include <type_traits>
#include <vector>

namespace Supple
{
  /**
   * The values of a symmetric matrix of BxB blocks in double precision, as they stand in memory:
   * blocks of 3x3 without gaps, those of 6x6 of coarse levels with rows of eight.
   */
  template <unsigned int B>
  struct MatrixView
  {
    static constexpr unsigned int row_size   = B == 3 ? 3 : 8;
    static constexpr unsigned int block_size = B * row_size;

    const SymmetricPattern &pattern;
    const double *lower;
    const double *diagonal;
  };


  /**
   * A symmetric matrix of BxB blocks in single precision, A = L + D + L^T, of which L and D are
   * kept: the smoother of a multigrid level. One sweep of block Gauss-Seidel before the coarse
   * level and one backwards after it make a symmetric, positive definite preconditioner.
   *
   * Each block of L is used twice when it is read, as L_ij x_j and as L_ij^T x_i. Sweeps leave out
   * the remote couplings R, those to nodes of other processes or of other threads: the outer
   * entries of the pattern. A diagonal matrix E is added instead, so that they converge on any
   * number of processes and threads (l1 Gauss-Seidel: Baker, Falgout, Kolev, Yang 2011). What has
   * to be positive definite for that is D + 2 E - R. Half the sums of absolute values in R are
   * enough for E, and less is, for D counts as well: with s the smallest eigenvalue of a block D
   * that is scaled to ones on its diagonal, D >= s diag(D), and s/2 of it, but for a tenth, goes
   * off the sums. On a coarse level, where most of a node's neighbours may be on other processes,
   * that saves one iteration in six.
   *
   * Arrays have an entry for each of the pattern.n_local nodes.
   */
  template <unsigned int B>
  class BlockSmoother
  {
  public:
    explicit BlockSmoother(const SymmetricPattern &pattern);

    /** Takes the matrix factor * A; false if a block on its diagonal is not positive definite. */
    bool
    set(const MatrixView<B> &A, double factor);

    /** y = A x on owned nodes; ghost values of x must be valid. */
    void
    vmult(NodeValues<B> *y, const NodeValues<B> *x) const;

    /** x = (D + L)^-1 b and residual = b - A x, but for remote couplings. */
    void
    forward(NodeValues<B> *x, NodeValues<B> *residual, const NodeValues<B> *b) const;

    /**
     * What sweeps leave out: takes remote couplings from a residual, or from the right hand side of
     * a backward sweep. Ghost values of x must be valid.
     */
    void
    subtract_remote(NodeValues<B> *residual, const NodeValues<B> *x) const;

    /** x += (D + L^T)^-1 (b - A x), but for remote couplings; b is lost. */
    void
    backward(NodeValues<B> *x, NodeValues<B> *b) const;

    /**
     * The same, and the product A x of what has become of x, which is b - L change but for
     * remote couplings: rows of L are used again while they are still in the cache.
     * @param rhs    b once more, which is kept
     * @param change the old x minus the new one
     */
    void
    backward(NodeValues<B> *x,
             NodeValues<B> *b,
             const NodeValues<B> *rhs,
             NodeValues<B> *change,
             NodeValues<B> *product) const;

    /** D^-1 b */
    Lanes<float, B>
    solve_diagonal(std::size_t node, const Lanes<float, B> &b) const;

    /** D x */
    Lanes<float, B>
    diagonal_product(std::size_t node, const Lanes<float, B> &x) const;

    /** Frobenius' norm of the block D of a node. */
    float
    diagonal_norm(std::size_t node) const;

    const SymmetricPattern &pattern;
    std::vector<float> lower;            ///< blocks by rows, in the order of the pattern
    std::vector<NodeValues<B>> diagonal; ///< D of owned nodes, B columns each
    std::vector<NodeValues<B>> inverse;  ///< D^-1 with what is added to D

  private:
    using Piece = SymmetricPattern::Piece;

    /** The sum of L_ij x_j over entries of a row, in a sweep that goes on or, with -1, back; with 0
     * the row has just been used. */
    template <int direction>
    Lanes<float, B>
    row_product(std::size_t begin, std::size_t end, const NodeValues<B> *x) const;

    /** y_j += L_ij^T x_i over entries of a row. */
    void
    add_transposed(std::size_t begin,
                   std::size_t end,
                   const Lanes<float, B> &x,
                   NodeValues<B> *y) const;

    /** Of inner entries; the row itself if there are none. */
    template <bool cut>
    std::size_t
    first_column(const std::size_t row) const
    {
      const std::size_t k = pattern.template inner_start<cut>(row);
      return k < pattern.row_start[row + 1] ? pattern.column[k] : row;
    }

    /** action(piece, whether the pattern is cut), on several threads. */
    template <class Action>
    void
    for_pieces(const Action &action) const
    {
      if (pattern.is_cut())
        pattern.for_pieces([&](const Piece &piece) { action(piece, std::true_type()); });
      else
        action(Piece{0, 0, pattern.n_owned}, std::false_type());
    }

    // Apart from the code for threads the compiler has registers for all that a sweep needs.
    template <bool cut>
    [[gnu::noinline]] void
    sweep_forward(const Piece &piece,
                  NodeValues<B> *x,
                  NodeValues<B> *residual,
                  const NodeValues<B> *b) const;

    template <bool cut>
    [[gnu::noinline]] void
    sweep_back(const Piece &piece, NodeValues<B> *x, NodeValues<B> *b) const;

    template <bool cut>
    [[gnu::noinline]] void
    sweep_back(const Piece &piece,
               NodeValues<B> *x,
               NodeValues<B> *b,
               const NodeValues<B> *rhs,
               NodeValues<B> *change,
               NodeValues<B> *product) const;

    void
    set_lower(std::size_t begin, std::size_t end, const double *values, double factor);

    bool
    set_diagonal(const Piece &piece, const MatrixView<B> &A, double factor);

    void
    find_remote_couplings();

    void
    sum_remote_couplings();

    /** Of an owned node with remote couplings: E, what is added to its diagonal for them. */
    struct RemoteSum
    {
      std::uint32_t node;
      NodeValues<B> sum;
    };

    std::vector<RemoteSum> remote; ///< by ascending node

    /** For each outer entry the place in remote of its column and of its row, if that is owned. */
    std::vector<std::array<std::uint32_t, 2>> remote_index;
  };
} // namespace Supple

#endif
