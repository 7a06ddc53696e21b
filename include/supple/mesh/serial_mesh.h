#ifndef supple_serial_mesh_h
#define supple_serial_mesh_h

#include <array>
#include <boost/serialization/array.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>
#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>
#include <map>
#include <string>
#include <vector>

namespace Supple
{
  /** The edges of a tetrahedron by its corners, in the order of their middle nodes. */
  constexpr std::array<std::array<unsigned int, 2>, 6> tetrahedron_edges = {
    {{{0, 1}}, {{0, 2}}, {{0, 3}}, {{1, 2}}, {{1, 3}}, {{2, 3}}}};


  /** A mesh of tetrahedra, or of triangles in the plane z = 0, as plain lists: a whole one, which
   * the first process alone has, or a part of it. */
  struct SerialMesh
  {
    /** A triangle, or an edge of a triangle. */
    struct BoundaryFace
    {
      std::array<unsigned int, 3> vertices; ///< of which the first `dimension` count
      unsigned int boundary_id;
      unsigned int cell = 0; ///< whose face it is, once the mesh is checked

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &vertices &boundary_id &cell;
      }
    };


    /** The node in the middle of an edge of quadratic cells. */
    struct Middle
    {
      std::array<unsigned int, 2> ends; ///< the vertices of the edge, ascending
      dealii::Point<3> place;           ///< [m]
      unsigned int part = 0;            ///< of the body, as SerialMesh::parts

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &ends &place &part;
      }
    };


    /** A face of a cell by itself, its vertices ascending; an edge has none in the third place. */
    struct CellFace
    {
      std::array<unsigned int, 3> vertices;
      unsigned int cell;
    };

    unsigned int dimension = 3;                     ///< of the cells: 3 tetrahedra, 2 triangles
    std::vector<dealii::Point<3>> vertices;         ///< [m]
    std::vector<std::array<unsigned int, 4>> cells; ///< of which the first `dimension` + 1 count
    std::vector<unsigned int> materials;            ///< of the cells
    std::vector<unsigned int> patches;              ///< of the cells, or none; see make_patches()
    std::vector<unsigned int> parts;                ///< of the vertices; see check_mesh()
    std::vector<BoundaryFace> boundary;
    std::vector<Middle>
      middles; ///< of all edges of cells, sorted by their ends; none: linear cells

    // Of a file, on the first process alone.
    std::map<std::string, unsigned int> material_names; ///< ids of groups of cells by name
    std::map<std::string, unsigned int> boundary_names; ///< ids of groups of faces by name
    std::vector<std::string> warnings;                  ///< about the file, in sentences

    dealii::ArrayView<const unsigned int>
    cell_vertices(const std::size_t cell) const
    {
      return {cells[cell].data(), dimension + 1};
    }

    dealii::ArrayView<const unsigned int>
    face_vertices(const BoundaryFace &face) const
    {
      return {face.vertices.data(), dimension};
    }

    /** Signed volume of a cell [m^3], or area of a triangle [m^2], positive if it is oriented as it
     * should be. */
    double
    volume(std::size_t cell) const;

    /** The place in middles of that between two vertices. @throws std::out_of_range if there is
     * none
     */
    unsigned int
    middle(unsigned int v, unsigned int w) const;

    /** All faces of all cells, sorted by their vertices, then by cells: a face that two cells share
     * stands there twice in a row. */
    std::vector<CellFace>
    sorted_faces() const;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &dimension &vertices &cells &materials &patches &parts &boundary &middles;
      archive &material_names &boundary_names &warnings;
    }
  };
} // namespace Supple

#endif
