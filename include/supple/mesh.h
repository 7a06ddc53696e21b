#ifndef supple_mesh_h
#define supple_mesh_h

#include <supple/parameters.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/distributed/fully_distributed_tria.h>

#include <array>
#include <map>
#include <vector>

namespace Supple
{
  /** A mesh of tetrahedra as plain lists, the same on every process. */
  struct SerialMesh
  {
    struct BoundaryTriangle
    {
      std::array<unsigned int, 3> vertices;
      unsigned int boundary_id;
    };

    std::vector<dealii::Point<3>> vertices;         ///< [m]
    std::vector<std::array<unsigned int, 4>> cells; ///< positively oriented
    std::vector<BoundaryTriangle> boundary;
  };


  /**
   * A box of cubes, each cut into six tetrahedra which share its diagonal from corner 000 to corner
   * 111 (Kuhn 1960). Vertices and cubes are numbered with x fastest, then y, then z.
   */
  SerialMesh
  box_mesh(const MeshParameters &parameters);


  /** The mesh of the body at rest, each cell on one process. */
  class Mesh
  {
  public:
    Mesh(const MeshParameters &parameters, MPI_Comm communicator);

    const MPI_Comm communicator;
    dealii::parallel::fullydistributed::Triangulation<3> triangulation;

    /** Index in the mesh before it was partitioned, for each vertex of this process's
     * triangulation. */
    std::vector<unsigned int> serial_vertex;

    unsigned int n_cells;                            ///< on all processes
    unsigned int n_vertices;                         ///< on all processes
    double volume;                                   ///< [m^3]
    dealii::BoundingBox<3> bounding_box;             ///< [m]
    std::map<unsigned int, unsigned int> boundaries; ///< boundary id -> number of its faces

    /** Length of the bounding box's diagonal [m]. */
    double
    diameter() const;

    /** "[0, 4] x [0, 12] x [0, 4]" */
    std::string
    extent() const;

  private:
    void
    measure(const SerialMesh &mesh);
  };
} // namespace Supple

#endif
