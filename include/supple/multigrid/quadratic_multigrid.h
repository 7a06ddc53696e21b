#ifndef supple_quadratic_multigrid_h
#define supple_quadratic_multigrid_h

#include <supple/multigrid/multigrid.h>

#include <array>
#include <cstdint>

namespace Supple
{
  /** The vertices among the nodes of quadratic cells: a level of their own, on which displacements
   * are linear in each cell. */
  struct VertexLevel
  {
    /** Of the vertices, three each: this process's own ones in the order of the nodes. */
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> dofs;

    /** Of all local nodes, the local numbers of the vertices at the ends of their edge; a vertex
     * has itself twice. */
    std::vector<std::array<std::uint32_t, 2>> ends;

    std::vector<std::uint32_t> node; ///< of own vertices

    // One for what is free to move, zero for what is held.
    std::vector<NodeValues<3>> free_nodes;    ///< all local ones
    std::vector<NodeValues<3>> free_vertices; ///< own ones
  };


  /**
   * Multigrid by polynomial degree: one sweep of Gauss-Seidel on the nodes of quadratic cells
   * before and one after the Multigrid of the vertices,
   *
   *   x = (D + L)^-1 r,   b = P^T (r - A x),   x += P Multigrid(A_v) b,   a sweep backwards,
   *
   * where P gives the middle of an edge the mean of its ends (Ronquist and Patera 1987). A_v is
   * about P^T A P. It needs fewer iterations than aggregates of all nodes, and far less to set up.
   */
  class QuadraticMultigrid : public Cycle
  {
  public:
    /**
     * @param A          stays in use, as A_vertices; values may change, patterns not
     * @param A_vertices up to date whenever levels are built or refreshed
     */
    QuadraticMultigrid(const SymmetricBlockMatrix &A,
                       std::shared_ptr<const dealii::Utilities::MPI::Partitioner> dofs,
                       const SymmetricBlockMatrix &A_vertices,
                       VertexLevel level);

    void
    build(const std::vector<double> &modes) override;

    void
    refresh(const std::vector<double> &modes) override;

    void
    refresh_finest() override;

    void
    apply(NodeValues<3> *z, NodeValues<3> *product, const NodeValues<3> *r) override;

    std::size_t
    n_coarse_levels() const override
    {
      return vertices.n_coarse_levels();
    }

    const CoarseLevel &
    coarse_level(const std::size_t l) const override
    {
      return vertices.coarse_level(l);
    }

  private:
    /** Of the vertices. */
    std::vector<double>
    modes_of_vertices(const std::vector<double> &modes) const;

    /** b = P^T residual in the unit of the vertices' matrix */
    void
    restrict_residual();

    /** z += P x */
    void
    add_correction(NodeValues<3> *z) const;

    const VertexLevel level;
    Multigrid vertices;
    std::vector<std::size_t> start;          ///< of each own vertex in edges
    std::vector<std::uint32_t> edges;        ///< the nodes in the middles of edges at a vertex
    std::vector<NodeValues<3>> b, x, b_less; ///< of the vertices
  };
} // namespace Supple

#endif
