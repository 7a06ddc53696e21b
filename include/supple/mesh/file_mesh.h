#ifndef supple_file_mesh_h
#define supple_file_mesh_h

#include <supple/mesh/serial_mesh.h>

#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace Supple
{
  /** What a mesh file says, vertex by vertex and element by element, in the numbers of the file. */
  struct FileMesh
  {
    /** A tetrahedron, a triangle or an edge. */
    struct Element
    {
      std::size_t number;
      std::array<std::size_t, 4> vertices; ///< numbers of the file; dimension + 1 of them count
      std::vector<unsigned int> ids;       ///< of the groups that it is in
    };

    std::map<std::size_t, dealii::Point<3>> vertices; ///< by number

    /** Of quadratic tetrahedra, the nodes in the middles of edges by the vertices there, ascending.
     */
    std::map<std::array<std::size_t, 2>, std::size_t> middles;

    /** How many quadratic triangles there are among the elements. */
    std::size_t n_quadratic_triangles = 0;

    // By the dimension of the elements: 1, 2 or 3.
    std::array<std::vector<Element>, 4> elements;
    std::array<std::map<std::string, std::size_t>, 4> others; ///< kind, such as "Hexahedron 8",
                                                              ///< and how many there are
    std::array<std::map<std::string, std::set<unsigned int>>, 4> names; ///< ids of groups by name

    std::vector<std::string> warnings; ///< about the file, in sentences
  };


  /** The places of nodes behind the vertices in the lists of a format. */
  enum class NodeOrder
  {
    vtk,      ///< vertices, then the edges 01, 12, 02, 03, 13, 23 (Medit, Nastran too)
    gmsh,     ///< vertices, then the edges 01, 12, 02, 03, 23, 13
    universal ///< 0, 01, 1, 12, 2, 02, then 03, 13, 23, 3
  };


  /** Adds a quadratic triangle of six nodes or tetrahedron of ten.
   * @throws InputError if the edge of another one has another node in its middle */
  void
  add_quadratic(FileMesh &mesh,
                FileMesh::Element element,
                const std::vector<std::size_t> &nodes,
                NodeOrder order);


  /** The number that a word of a file announces. @param of what, for the message
   * @throws InputError if it is no whole number of at most twelve digits */
  std::size_t
  announced(const std::string &word, const std::string &of);


  /** @throws InputError if the number of a group, a reference or the like is no id: a whole number,
   * 2147483647 at most, as in parameter files */
  unsigned int
  id_of(double number);


  /**
   * The body that a file holds: its tetrahedra, or the triangles of one in the plane z = 0.
   * Vertices and cells have the order of their numbers; the middles of edges of quadratic
   * tetrahedra are no vertices. Materials are ids of cells, boundaries those of the elements of one
   * dimension less; of several ids of an element the least one counts, with a warning.
   * @throws InputError in words that help if there is no body, or cells are of another kind too
   */
  SerialMesh
  body_of(const FileMesh &file);
} // namespace Supple

#endif
