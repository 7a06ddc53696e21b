#ifndef supple_selection_h
#define supple_selection_h

#include <supple/mechanics/body.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /** How an entry begins that selects a vertex by its index, and one by a point near to it. */
  inline const std::string vertex_word = "vertex ", point_word = "nearest to ";


  /** What follows such a word in an entry; empty if it does not begin so. */
  std::string
  after_word(const std::string &text, const std::string &word);


  /** Faces of the surface by their local nodes, normals pointing outward; the second node of an
   * edge stands twice. */
  struct Faces
  {
    std::vector<std::array<unsigned int, 3>> corners;

    /** Of quadratic cells, the nodes of the edges 01, 12, 20 of each face; otherwise none. */
    std::vector<std::array<unsigned int, 3>> middles;
  };


  /** The vertices, boundaries and regions of a body that a user means by words and numbers. */
  class Selection
  {
  public:
    explicit Selection(const Body &body)
      : body(body)
    {
    }

    /**
     * The nodes a user means by "vertex 12", "nearest to 0, 0, 1", "boundary 2, 3", "region z > 1"
     * or "all".
     * @throws InputError beginning with @p origin if it is none of these, or there is no such node
     */
    std::vector<bool>
    selected_nodes(const std::string &text, const std::string &origin) const;

    /** The index of the vertex nearest to a point, in the unpartitioned mesh, and its distance [m].
     */
    std::pair<unsigned int, double>
    nearest_vertex(const dealii::Point<3> &point) const;

    /** The nodes of a boundary, by its id or the name of a group of the mesh file. @throws
     * InputError beginning with @p origin if there are none. */
    std::vector<bool>
    boundary_nodes(const std::string &boundary, const std::string &origin) const;

    /** The faces of boundaries that touch a node of this process. @throws InputError beginning with
     * @p origin if there is no such boundary */
    Faces
    boundary_faces(const std::vector<std::string> &boundaries, const std::string &origin) const;

    /** The nodes where an expression is not zero. @throws InputError beginning with @p origin if
     * there are none. */
    std::vector<bool>
    region_nodes(const std::string &expression, const std::string &origin) const;

    /** At rest [m], of a vertex by its index in the mesh; collective. */
    dealii::Point<3>
    place_of_vertex(unsigned int vertex) const;

    /** "vertex 3 at (0, 0, 1)", for a vertex by its index in the mesh. */
    std::string
    vertex_in_words(unsigned int vertex) const;

  private:
    /** nearest_vertex() of a point that is not far from the body. @throws InputError beginning with
     * @p origin if it is */
    unsigned int
    vertex_of_body(const dealii::Point<3> &point, const std::string &origin) const;

    /** By the id or the name of a group. @throws InputError beginning with @p origin if the body
     * has no such boundary */
    unsigned int
    boundary_id(const std::string &boundary, const std::string &origin) const;

    const Body &body;
  };
} // namespace Supple

#endif
