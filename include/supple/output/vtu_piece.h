#ifndef supple_vtu_piece_h
#define supple_vtu_piece_h

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /** Cells of one kind, by their points. */
  struct VtuCells
  {
    unsigned int type; ///< VTK's number: 5 triangle, 10 tetrahedron; 22, 24 with middles of edges
    unsigned int points_per_cell;
    std::vector<std::int32_t> points; ///< of each cell one after the other
  };


  /** Numbers of all points or of all cells. */
  struct VtuField
  {
    std::string name;
    unsigned int n_components;
    const std::vector<float> *values; ///< one after the other
  };


  /** Whole numbers of all cells. */
  struct VtuIds
  {
    std::string name;
    const std::vector<std::int32_t> *values;
  };


  /**
   * A piece of an unstructured grid, as VTU files hold it, in many instants: cells and their ids
   * are packed once. Cells share points, and have values of their own.
   */
  class VtuPiece
  {
  public:
    /** What changes from one instant to the next. */
    struct Instant
    {
      double time;
      unsigned int step;
      const std::vector<double> &points; ///< three coordinates each [m]
      std::vector<VtuField> of_points;
      std::vector<VtuField> of_cells;
    };

    /**
     * @param ids of the cells
     * @throws WriteError if the numbers of the points of all cells don't fit into 32 bits
     */
    VtuPiece(const VtuCells &cells, const std::vector<VtuIds> &ids = {});

    /** The file of an instant. */
    std::string
    file(const Instant &now) const;

    /** The file that names the pieces of all processes; their fields are those of @p now. */
    std::string
    record(const Instant &now, const std::vector<std::string> &files) const;

  private:
    const std::size_t n_cells;
    std::string topology; ///< elements of the XML
    /** Elements that declare the ids, and that have them. */
    std::string ids_declared, ids_packed;
  };
} // namespace Supple

#endif
