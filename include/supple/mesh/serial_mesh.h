#ifndef supple_serial_mesh_h
#define supple_serial_mesh_h

#include <supple/scene/parameters.h>

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

#include <array>
#include <string>
#include <vector>

namespace Supple
{
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
    std::vector<unsigned int> pieces;               ///< of the vertices; see check_mesh()
    std::vector<BoundaryFace> boundary;

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

    /** All faces of all cells, sorted by their vertices, then by cells: a face that two cells share
     * stands there twice in a row. */
    std::vector<CellFace>
    sorted_faces() const;

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &dimension &vertices &cells &materials &patches &pieces &boundary;
    }
  };


  /** The mesh a scene asks for: generated or read, in metres, positively oriented, with its
   * boundary ids. */
  SerialMesh
  make_serial_mesh(const Parameters &parameters);


  /**
   * A box of cubes, each cut into six tetrahedra which share its diagonal from corner 000 to corner
   * 111 (Kuhn 1960). Vertices and cubes are numbered with x fastest, then y, then z. Boundary ids:
   * 0, 1 (x), 2, 3 (y), 4, 5 (z). Layers along y have materials of their own.
   */
  SerialMesh
  box_mesh(const MeshParameters &parameters);


  /**
   * A rectangle of squares in the plane z = 0, each cut into two triangles.
   *
   *    o---o---o
   *    |\  |  /|       falling, rising: square (i, j) is cut from vertex (i, j + 1) to (i + 1, j),
   *    | \ | / |       or from (i, j) to (i + 1, j + 1)
   *    |  \|/  |
   *    o---o---o
   *
   * Vertices and squares are numbered with x fastest. Boundary ids: 0 left, 1 right, 2 bottom, 3
   * top. Layers along y have materials of their own.
   */
  SerialMesh
  rectangle_mesh(const MeshParameters &parameters);


  /**
   * A hollow cylinder about the z axis, centred at the origin (Valera 2002): n sectors, n_rings
   * sections along the axis, one or more layers through the wall.
   *
   *      o---o---o      outer circle, half a sector ahead
   *     / \ / \ /
   *    o---o---o        inner circle
   *
   * Between two sections each of these triangles makes a wedge, cut into three tetrahedra. Vertices
   * are numbered section by section from the bottom, in each circle by circle from the inside.
   * Boundary ids: 0 inner, 1 outer, 2 bottom, 3 top.
   */
  SerialMesh
  hollow_cylinder_mesh(const MeshParameters &parameters);


  /**
   * Reads a mesh by Gmsh: .msh (1, 2.2, 4.1, ASCII or binary), legacy .vtk, .unv, .mesh, .bdf.
   * Physical volumes become material ids and physical surfaces boundary ids; without them the
   * material is 0 and the whole surface boundary 0. Triangles in the plane z = 0 without
   * tetrahedra are a plane body, with the same from physical surfaces and curves.
   * @throws InputError in words that help if there is neither, or Gmsh can't read the file
   */
  SerialMesh
  read_mesh(const std::string &file, const std::string &origin);
} // namespace Supple

#endif
