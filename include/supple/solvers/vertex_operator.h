#ifndef supple_vertex_operator_h
#define supple_vertex_operator_h

#include <supple/multigrid/quadratic_multigrid.h>
#include <supple/solvers/implicit_operator.h>

#include <memory>

namespace Supple
{
  /** What the operator of a body of quadratic cells is for displacements that are linear in each
   * cell: a matrix on the vertices, for QuadraticMultigrid. */
  class VertexOperator
  {
  public:
    explicit VertexOperator(const ImplicitOperator &A);

    /** To be called whenever A has changed. */
    void
    update();

    const SymmetricBlockMatrix &
    matrix() const
    {
      return on_vertices;
    }

    const VertexLevel &
    level() const
    {
      return of_nodes;
    }

  private:
    /** The numbers of the vertices, by all local nodes; sets what the level says of them. */
    std::vector<std::uint32_t>
    number_vertices();

    SymmetricPattern
    make_pattern() const;

    /** Of what is held the diagonal stays alone. */
    void
    find_masked_entries();

    const ImplicitOperator &A;
    VertexLevel of_nodes;
    const std::vector<std::uint32_t> vertex; ///< of each local node, or none
    const SymmetricPattern pattern;
    const CellSlots slots;
    SymmetricBlockMatrix on_vertices;
    std::vector<std::size_t> masked_lower, masked_diagonal; ///< positions in the matrix
  };
} // namespace Supple

#endif
