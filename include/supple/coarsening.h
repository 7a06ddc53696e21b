#ifndef supple_coarsening_h
#define supple_coarsening_h

#include <supple/aggregation.h>
#include <supple/halo.h>

namespace Supple
{
  /** The matrix of a coarse level: six unknowns a node, blocks with rows of eight. Whole on every
   * process. */
  struct CoarseMatrix
  {
    struct Block
    {
      Lanes<double, 6> row[6];
    };

    SymmetricPattern pattern;
    std::vector<Block> lower, diagonal;

    MatrixView<6>
    view() const
    {
      return {pattern,
              reinterpret_cast<const double *>(lower.data()),
              reinterpret_cast<const double *>(diagonal.data())};
    }
  };


  /**
   * The step from a level to the next coarser one by smoothed aggregation (Vanek, Mandel, Brezina
   * 1996): every aggregate of nodes becomes a node with six unknowns, which stand for its rigid
   * motions,
   *
   *   P = (I - w D^-1 A) T,   w = 4/3 / (largest eigenvalue of D^-1 A),   A_coarse = P^T A P,
   *
   * where the columns of T are the rigid motions of one aggregate each, made orthonormal (T R = the
   * rigid motions; R are those of the coarse level).
   *
   * P is kept in whole numbers of sixteen bits, with a scale for each node: the matrix of the
   * coarse level is that of the P so rounded, and half the bytes are to be read.
   *
   * The finest level is distributed: each process makes aggregates of its own nodes, and knows the
   * rows of P of its own nodes and ghosts. Coarse levels are the same on all processes.
   */
  template <unsigned int B>
  class Coarsening
  {
  public:
    /**
     * Chooses aggregates and finds the patterns of P and of the coarse matrix.
     * @param fine       stays in use
     * @param halo       of the finest level, null for others
     * @param patch_size see aggregate()
     */
    Coarsening(const BlockSmoother<B> &fine, const Halo *halo, unsigned int patch_size);

    /**
     * Computes P and the coarse matrix anew on the same aggregates.
     * @param A     the matrix in double precision; fine has factor times this
     * @param modes the six rigid motions at owned nodes, B rows of six for each node; zero where
     * the body is held
     */
    void
    refresh(const MatrixView<B> &A, double factor, const std::vector<double> &modes);

    /** coarse = P^T residual */
    void
    restrict_residual(NodeValues<6> *coarse, const NodeValues<B> *residual);

    /** x += P coarse */
    void
    add_correction(NodeValues<B> *x, const NodeValues<6> *coarse) const;

    std::uint32_t n_coarse; ///< aggregates on all processes
    CoarseMatrix matrix;
    std::vector<double> coarse_modes; ///< R, 36 for each aggregate

  private:
    /** A row of T, or a node's part of a column of P times A, in lanes. */
    struct Rows
    {
      NodeValues<6> row[B];
    };

    struct WideRows
    {
      Lanes<double, 6> row[B];
    };

    bool
    distributed() const
    {
      return halo != nullptr && !halo->single();
    }

    void
    number_aggregates(unsigned int patch_size);

    void
    find_rows();

    void
    find_ghost_rows();

    /** The aggregates that (L + D/2) P has entries for in each row. */
    void
    find_product_columns();

    /** action(larger, smaller) for each pair of aggregates that gets a contribution, in the order
     * of slots. */
    template <class Action>
    void
    for_pairs(const Action &action) const;

    void
    find_coarse_pattern();

    void
    merge_patterns(std::vector<std::vector<std::uint32_t>> &rows) const;

    void
    estimate_largest_eigenvalue();

    void
    set_tentative(const std::vector<double> &modes);

    void
    smooth(std::size_t node);

    /** The rows of P at hand, in sixteen bits. */
    void
    round(std::size_t node);

    void
    update_ghost_rows();

    void
    multiply(const MatrixView<B> &A);

    /** product += weight A_ij P_j */
    void
    add_to_product(const double *block, double weight, std::size_t j);

    /** The contributions of a row of P and of product to the coarse matrix. */
    void
    add_row(std::size_t row, const std::uint32_t *&slot);

    void
    set_dead_unknowns(double diagonal_entry);

    /** P^T residual of the nodes of a piece. */
    void
    restrict_residual(const SymmetricPattern::Piece &piece,
                      NodeValues<6> *coarse,
                      const NodeValues<B> *residual) const;

    void
    add_correction(const SymmetricPattern::Piece &piece,
                   NodeValues<B> *x,
                   const NodeValues<6> *coarse) const;

    const BlockSmoother<B> &fine;
    const Halo *const halo;
    const Adjacency adjacency;
    double largest_eigenvalue; ///< of D^-1 A

    std::vector<std::uint32_t> aggregate_of;         ///< of local nodes, counted over all processes
    std::uint32_t first_own, n_own;                  ///< aggregates of this process
    std::vector<std::uint32_t> member_start, member; ///< nodes of own aggregates

    std::vector<std::uint32_t> row_start, column; ///< of P, for local nodes
    std::vector<float> scale;                     ///< of the rows of a node
    std::vector<std::int16_t> values; ///< of P over the scale: B rows of six for each entry
    std::vector<std::uint32_t> product_start, product_column; ///< of (L + D/2) P, likewise
    std::vector<std::uint32_t> slots; ///< block of the coarse matrix for each contribution

    std::vector<Rows> tentative;     ///< T at local nodes
    std::vector<std::uint32_t> mark; ///< for each aggregate, its place in the row at hand
    std::vector<Rows> smoothed;      ///< the row of P at hand
    std::vector<WideRows> product;   ///< the row of (L + D/2) P at hand
    WideRows prolongation;           ///< an entry of P at hand
    std::vector<char> ghost_records; ///< rows of P on their way between processes
    std::uint32_t longest_row = 0;   ///< of P, over all processes

    std::vector<std::vector<NodeValues<6>>> partial_sums; ///< P^T residual, of pieces but the first
  };
} // namespace Supple

#endif
