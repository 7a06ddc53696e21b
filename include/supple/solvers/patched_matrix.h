#ifndef supple_patched_matrix_h
#define supple_patched_matrix_h

#include <supple/solvers/implicit_operator.h>

#include <memory>
#include <vector>

namespace Supple
{
  /** The matrix of an operator with what its patches add to it, for factorizations: a patch couples
   * all of its nodes with each other. Without patches it is the operator's own. On one process. */
  class PatchedMatrix
  {
  public:
    explicit PatchedMatrix(const ImplicitOperator &A);

    const SymmetricBlockMatrix &
    get() const
    {
      return matrix ? *matrix : A.matrix();
    }

    /** To be called whenever A has changed. */
    void
    update();

  private:
    /** Calls @p visit(row, column, c of the row, c of the column, factor) for the pairs of nodes of
     * each patch, row >= column. */
    template <class Visit>
    void
    for_each_pair(const Visit &visit) const;

    /** That of the cells and all pairs. */
    SymmetricPattern
    make_pattern() const;

    const ImplicitOperator &A;
    SymmetricPattern pattern;                     ///< empty without patches
    std::unique_ptr<SymmetricBlockMatrix> matrix; ///< null without patches
    std::vector<std::size_t> places;              ///< of each pair
    std::vector<std::size_t> places_of_cells;     ///< of each entry of A.matrix()
  };
} // namespace Supple

#endif
