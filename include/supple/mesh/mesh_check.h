#ifndef supple_mesh_check_h
#define supple_mesh_check_h

#include <supple/mesh/serial_mesh.h>

#include <deal.II/base/bounding_box.h>

#include <string>
#include <vector>

namespace Supple
{
  /** What was found when a mesh was looked through. */
  struct MeshReport
  {
    unsigned int repaired        = 0; ///< cells whose orientation was negative
    unsigned int slivers         = 0; ///< cells of a quality below 0.1
    unsigned int unused_vertices = 0; ///< in no cell
    unsigned int double_vertices = 0; ///< at the place of another one, but for round-off
    double worst_quality         = 1.;
    std::size_t worst_cell       = 0;
    dealii::Point<3> worst_position;

    /** What hangs together. */
    struct Piece
    {
      unsigned int n_cells = 0;
      dealii::BoundingBox<3> box;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &n_cells &box;
      }
    };
    std::vector<Piece> pieces;

    /** Cells that hang together face by face (in the plane: edge by edge): a rigid motion of one of
     * them is one of all. Most pieces are one part. */
    struct Part
    {
      unsigned int n_cells = 0;
      unsigned int piece   = 0;
      dealii::BoundingBox<3> box;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &n_cells &piece &box;
      }
    };
    std::vector<Part> parts;

    /** A vertex that several parts share. */
    struct Joint
    {
      dealii::Point<3> place;
      std::vector<unsigned int> parts;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int)
      {
        archive &place &parts;
      }
    };
    std::vector<Joint> joints;

    std::vector<std::string> warnings; ///< what the user should know, in sentences

    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &repaired &slivers &unused_vertices &double_vertices;
      archive &worst_quality &worst_cell &worst_position &pieces &parts &joints &warnings;
    }
  };


  /**
   * Looks a mesh through and mends what can be mended: negative cells are reoriented, and the
   * boundary gets each face with one cell (id 0 where none was given), cell by cell. Each vertex
   * gets the number of its part of the body, the first of several; one that is in no cell gets the
   * number of parts.
   * @throws InputError beginning with @p origin for flat cells, vertices that do not exist, and
   * faces with more than two cells
   */
  MeshReport
  check_mesh(SerialMesh &mesh, const std::string &origin);


  /**
   * Puts the vertices of an axisymmetric body that are as good as on the axis onto it.
   * @throws InputError beginning with @p origin if there are any beyond it
   */
  void
  fit_to_axis(SerialMesh &mesh, const std::string &origin);


  /** "[0, 4] x [0, 12] x [0, 4]"; along x and y alone in two dimensions. */
  std::string
  extent_in_words(const dealii::BoundingBox<3> &box, unsigned int dimension);


  /** Mean ratio of a tetrahedron, 12 (3 V)^(2/3) / sum of squared edges, or of a triangle,
   * 4 sqrt(3) A / sum of squared edges: 1 if regular, 0 if flat. */
  double
  quality(const SerialMesh &mesh, std::size_t cell);
} // namespace Supple

#endif
