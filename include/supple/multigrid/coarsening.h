#ifndef supple_coarsening_h
#define supple_coarsening_h

#include <supple/multigrid/aggregation.h>
#include <supple/multigrid/block_exchange.h>

namespace Supple
{
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
   * Each process makes aggregates of its own nodes, and knows the rows of P of these and of ghosts.
   * The coarse level is distributed as the aggregates are, with all aggregates as ghosts that a
   * process has in its rows of P or next to its own in the matrix. If it is too small for that,
   * each process has the whole of it, and sums go over all. So is what comes after a level that
   * each process has the whole of, without messages.
   */
  template <unsigned int B>
  class Coarsening
  {
  public:
    /**
     * Chooses aggregates and finds the patterns of P and of the coarse matrix.
     * @param fine       stays in use
     * @param halo       of the fine level, null where each process has the whole of it
     * @param patch_size see aggregate()
     * @param largest_replicated the coarse level is distributed if it has more nodes than this
     */
    Coarsening(const BlockSmoother<B> &fine,
               const Halo *halo,
               unsigned int patch_size,
               std::uint32_t largest_replicated);

    /**
     * Computes P and the coarse matrix anew on the same aggregates.
     * @param A     the matrix in double precision; fine has factor times this
     * @param modes the six rigid motions at owned nodes, B rows of six for each node; zero where
     * the body is held
     */
    void
    refresh(const MatrixView<B> &A, double factor, const std::vector<double> &modes);

    /** coarse_values = P^T residual on owned nodes */
    void
    restrict_residual(NodeValues<6> *coarse_values, const NodeValues<B> *residual);

    /** x += P coarse_values, at ghosts too. Brings the ghost values of the coarse level. */
    void
    add_correction(NodeValues<B> *x, NodeValues<6> *coarse_values) const;

    CoarseLevel coarse; ///< its modes are R

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

    /** Whether it is here that each process gets the whole of what was distributed. */
    bool
    replicates() const
    {
      return distributed() && !coarse.halo;
    }

    /** @return the first aggregate of each process, and one after the last */
    std::vector<std::uint32_t>
    number_aggregates(unsigned int patch_size);

    void
    find_rows();

    void
    find_ghost_rows();

    /** Changes the local numbers of aggregates; up to the first time they are those counted over
     * all processes. */
    void
    renumber(NodeNumbers numbers);

    /** Gives those aggregates local numbers that are in the rows of P. */
    void
    number_known_aggregates();

    /** Tells other processes what this one contributes to the rows they have of a distributed
     * matrix; what they contribute here makes further aggregates ghosts. */
    void
    exchange_entries(const std::vector<std::uint32_t> &first_of);

    BlockExchange::Entries
    entries_for_others(const std::vector<std::uint32_t> &first_of) const;

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

    /** @param rows of the coarse matrix, in local numbers, with the smaller ones of each entry */
    void
    add_entries_of_others(std::vector<std::vector<std::uint32_t>> &rows) const;

    /** @return the pattern of what others keep */
    SymmetricPattern
    set_coarse_pattern(std::vector<std::vector<std::uint32_t>> &rows);

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
                      NodeValues<6> *coarse_values,
                      const NodeValues<B> *residual) const;

    /** x += P coarse_values of some nodes. */
    void
    add_correction(std::size_t begin,
                   std::size_t end,
                   NodeValues<B> *x,
                   const NodeValues<6> *coarse_values) const;

    const BlockSmoother<B> &fine;
    const Halo *const halo;
    const Adjacency adjacency;
    double largest_eigenvalue; ///< of D^-1 A

    std::vector<std::uint32_t> aggregate_of;         ///< of local nodes
    std::uint32_t first_own = 0, n_own;              ///< aggregates of this process
    std::vector<std::uint32_t> member_start, member; ///< nodes of own aggregates
    std::unique_ptr<BlockExchange> exchange; ///< null where the coarse level is not distributed

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
