#ifndef supple_mesh_h
#define supple_mesh_h

#include <supple/distributed_mesh.h>
#include <supple/mesh_check.h>

#include <deal.II/base/bounding_box.h>

#include <map>
#include <memory>
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
    Section section; ///< solid, or what stands behind the triangles of a plane body
    std::unique_ptr<DistributedMesh> parts;

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

    /** "tetrahedra" or "triangles" */
    std::string
    cell_name() const;

    /** "[0, 4] x [0, 12] x [0, 4]"; along x and y alone for a plane body. */
    std::string
    extent() const;

  private:
    void
    measure(const SerialMesh &mesh);
  };
} // namespace Supple

#endif
