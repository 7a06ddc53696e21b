#ifndef supple_mesh_h
#define supple_mesh_h

#include <supple/mesh_check.h>
#include <supple/serial_mesh.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/distributed/fully_distributed_tria.h>

#include <array>
#include <map>
#include <vector>

namespace Supple
{
  /** The mesh of the body at rest, each cell on one process. */
  class Mesh
  {
  public:
    /** @throws InputError */
    Mesh(const Parameters &parameters, MPI_Comm communicator);

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
    std::map<unsigned int, unsigned int> materials;  ///< material id -> number of its cells
    MeshReport report;

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
