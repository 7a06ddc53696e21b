#ifndef supple_mesh_h
#define supple_mesh_h

#include <supple/mesh/distributed_mesh.h>
#include <supple/mesh/mesh_check.h>
#include <supple/mesh/mesh_parameters.h>

#include <deal.II/base/bounding_box.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Supple
{
  /** The mesh of the body at rest, each cell on one process. The first process alone has the whole
   * of it, while it is made, checked and cut into parts. */
  class Mesh
  {
  public:
    /**
     * Collective.
     * @param plane        counts for triangles alone
     * @param with_patches the cells are grouped, see make_patches()
     * @param scene        knows where the entries were set, for messages, and its folder has the
     *                     mesh file
     * @throws InputError on all processes
     */
    Mesh(const MeshParameters &parameters,
         const PlaneParameters &plane,
         bool with_patches,
         const ParameterFile &scene,
         MPI_Comm communicator);

    const MPI_Comm communicator;
    Section section; ///< solid, or what stands behind the triangles of a plane body
    std::unique_ptr<DistributedMesh> parts;

    unsigned int n_cells    = 0;                        ///< on all processes
    unsigned int n_vertices = 0;                        ///< of cells, on all processes
    unsigned int n_middles  = 0;                        ///< of edges of quadratic cells
    double volume           = 0.;                       ///< [m^3]
    dealii::BoundingBox<3> bounding_box;                ///< [m]
    std::map<unsigned int, unsigned int> boundaries;    ///< boundary id -> number of its faces
    std::map<unsigned int, unsigned int> materials;     ///< material id -> number of its cells
    std::map<std::string, unsigned int> boundary_names; ///< of groups of the file -> boundary id
    std::map<std::string, unsigned int> material_names; ///< of groups of the file -> material id
    MeshReport report;
    unsigned int checksum = 0; ///< of vertices, cells and ids

    /** Of the file or the generator, those that no cell has included, and the nodes in the middles
     * of edges, which come after them: a node's index in the mesh is less. */
    unsigned int
    n_serial_vertices() const
    {
      return n_vertices + report.unused_vertices + n_middles;
    }

    bool
    is_quadratic() const
    {
      return n_middles > 0;
    }

    /** Length of the bounding box's diagonal [m]. */
    double
    diameter() const;

    /** "tetrahedra", "quadratic tetrahedra" or "triangles" */
    std::string
    cell_name() const;

    /** "[0, 4] x [0, 12] x [0, 4]"; along x and y alone for a plane body. */
    std::string
    extent() const;

  private:
    /** On the first process: generated or read, checked and measured, with its patches.
     * @throws InputError */
    SerialMesh
    make_whole(const MeshParameters &parameters,
               const PlaneParameters &plane,
               bool with_patches,
               const ParameterFile &scene);

    void
    measure(const SerialMesh &mesh);

    /** Tells all processes what the first one knows of the whole mesh. */
    void
    share();
  };
} // namespace Supple

#endif
