#ifndef supple_bisection_h
#define supple_bisection_h

#include <supple/mesh/serial_mesh.h>

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace Supple
{
  /**
   * Refines a mesh by the bisection of longest edges (Rivara 1984; in space Plaza and Carey 2000):
   * edges are marked; where one of a cell or of a face is, its longest one is too; then each cell
   * and each face is cut at its longest marked edge, its halves likewise, until none is left.
   *
   *       o                 o
   *      / \               /|\
   *     /   \     -->     / | o       two edges of a triangle are marked, among them the longest
   *    /     \           /  |/ \
   *   o-------o         o---o---o
   *
   * Of equally long edges the one with the larger vertices counts as longer, so that neighbours cut
   * the face they share alike: no vertex hangs, cells are nested, and their angles stay bounded.
   */
  class Bisection
  {
  public:
    /** Where the vertex between two others is put. */
    using Middle =
      std::function<dealii::Point<3>(const dealii::Point<3> &, const dealii::Point<3> &)>;

    /**
     * @param mesh   must outlive this; its boundary may have faces that no cell has
     * @param places of its vertices, by which edges are long or short [m]
     */
    Bisection(const SerialMesh &mesh, const std::vector<dealii::Point<3>> &places);

    /** Marks the longest edge of a cell and those of its faces: it becomes four, or two triangles.
     */
    void
    mark(std::size_t cell);

    /** Marks all edges of a cell: it becomes eight, or four triangles, half as large. */
    void
    mark_all(std::size_t cell);

    /** Marks the longest edge of a cell. */
    void
    mark_longest(std::size_t cell);

    /** Marks what else must be cut; to be called when all cells are marked. */
    void
    close();

    /** The number of cells after the cut. */
    std::size_t
    n_cells() const;

    /** The mesh with all marked edges cut: old vertices keep their numbers; the halves of a cell
     * stand where it stood and have its material, those of a face its boundary id. */
    SerialMesh
    refined(const Middle &middle) const;

  private:
    /** A cell or a face on its way to be cut. */
    struct Piece
    {
      std::array<unsigned int, 4> vertices;
      std::array<unsigned int, 4> corners; ///< those of the whole that these are, or none
    };

    /** The edges between the corners of a cell or a face. */
    using EdgeTable = std::array<std::array<unsigned int, 4>, 4>;

    void
    number_edges();

    void
    rank_edges(const std::vector<dealii::Point<3>> &places);

    /** The number of an edge, or none. */
    unsigned int
    edge(unsigned int a, unsigned int b) const;

    EdgeTable
    edges_of_cell(std::size_t cell) const;

    EdgeTable
    edges_of_face(const SerialMesh::BoundaryFace &face) const;

    /** The longest of the edges between corners that are not left out; only marked ones, if so
     * wanted; or none. */
    unsigned int
    longest(const EdgeTable &edges,
            const std::array<unsigned int, 4> &corners,
            unsigned int n,
            bool only_marked) const;

    /** Of each face of a cell, the edge to mark is marked if another one is. @return whether one
     * was */
    bool
    close(std::size_t cell);

    /** Calls @p visit with the vertices of each part of a cell or a face of @p n vertices. */
    template <class Visit>
    void
    cut(const Piece &piece, unsigned int n, const EdgeTable &edges, const Visit &visit) const;

    const SerialMesh &mesh;
    const unsigned int n_corners;                        ///< of a cell
    std::vector<std::array<unsigned int, 2>> ends;       ///< of the edges, ascending
    std::vector<std::array<unsigned int, 6>> cell_edges; ///< of which n_corners choose 2 count
    std::vector<unsigned int> rank;                      ///< of the edges from short to long
    std::vector<char> marked;
    std::vector<unsigned int> middle_of; ///< of the edges: the vertex there, or none
  };
} // namespace Supple

#endif
