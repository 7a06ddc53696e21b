#ifndef supple_vtu_h
#define supple_vtu_h

#include <supple/mesh/distributed_mesh.h>
#include <supple/output/cell_fields.h>
#include <supple/output/vtu_piece.h>

#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /** A moving body at an instant. */
  struct Drawing
  {
    double time;
    unsigned int step;
    const Vector &displacement;
    const Vector *velocity; ///< null in a static problem
    const CellFields &cells;
    const std::vector<float>
      *error_in_space;              ///< of the cells, by LocalCell::index; null if unknown
    const Vector *contact_pressure; ///< of nodes, the first of three numbers; null without tools
  };


  /** Draws a body as VTU files: the deformed cells of each process with displacement and velocity
   * of their vertices, and the fields of the cells. */
  class Vtu
  {
  public:
    /** @throws WriteError if there are too many cells on a process */
    explicit Vtu(const DistributedMesh &mesh);

    /** The file of this process, and the record that names those of all processes, @p names;
     * collective. */
    std::pair<std::string, std::string>
    draw(const Drawing &drawing, const std::vector<std::string> &names) const;

  private:
    VtuPiece
    make_piece();

    /** In the order of VTK. */
    unsigned int
    node_of(const LocalCell &cell, unsigned int a) const;

    /** A vector of nodes at the points [its unit]. */
    std::vector<float>
    at_points(const Vector &vector) const;

    std::vector<float>
    of_cells(const std::vector<float> &values) const;

    const DistributedMesh &mesh;
    std::vector<unsigned int> nodes; ///< of this process's own cells: the points of the file
    std::vector<unsigned int> cells; ///< their places in values by cell
    const VtuPiece piece;
  };
} // namespace Supple

#endif
