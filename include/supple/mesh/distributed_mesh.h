#ifndef supple_distributed_mesh_h
#define supple_distributed_mesh_h

#include <supple/linear_algebra/vector.h>
#include <supple/mesh/partition.h>

#include <deal.II/base/partitioner.h>

#include <array>
#include <memory>
#include <vector>

namespace Supple
{
  /** A cell as one process knows it. */
  struct LocalCell
  {
    std::array<unsigned int, 4> nodes; ///< local numbers; the third of a triangle stands twice
    unsigned int material_id;
    unsigned int index;       ///< its place in values by cell
    unsigned int serial_cell; ///< its index in the whole mesh
    unsigned int patch;       ///< number of its patch on all processes, if the mesh has patches
    bool owned;               ///< true on exactly one process
  };


  /** A face of the body's surface as one process knows it. */
  struct LocalFace
  {
    std::array<unsigned int, 3> nodes; ///< local numbers; the second of an edge stands twice
    unsigned int boundary_id;
    unsigned int cell_index; ///< of its cell in values by cell
    bool owned;              ///< its cell is
  };


  /**
   * The mesh with a part for each process, and its nodes numbered, by deal.II's triangulation and
   * degrees of freedom. What this process knows of them stands here as plain lists: nothing else
   * has to know at compile time whether the cells are tetrahedra or triangles, and deal.II's own,
   * which take some 400 bytes a cell, need not stay.
   *
   * A node is a vertex, or the middle of an edge of quadratic cells, with its three degrees of
   * freedom, 3 node, 3 node + 1, 3 node + 2; this process's own nodes have the local numbers 0 to
   * n_owned - 1 and ghosts those up to n_local - 1.
   *
   * Own nodes of quadratic cells are numbered by the vertices v <= w of their edge, with v = w for
   * a vertex itself: those of a cell v0 e01 e02 e03 v1 e12 e13 v2 e23 v3 ascend, and neighbours
   * stay together.
   */
  class DistributedMesh
  {
  public:
    /** Collective. */
    DistributedMesh(const MeshPart &part, MPI_Comm communicator);

    const unsigned int dimension; ///< of the cells: 3 tetrahedra, 2 triangles

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner; ///< of the unknowns

    unsigned int n_owned;                         ///< nodes
    unsigned int n_local;                         ///< nodes, ghosts included
    std::vector<std::array<double, 3>> positions; ///< of the local nodes [m]
    std::vector<unsigned int> serial_vertex;      ///< their indices in the whole mesh
    std::vector<unsigned int> parts;              ///< those of the body that they are in

    /** Of the functions of the patches, all cells of which are on one process: those of its cells
     * and, as ghosts, those of its ghost cells. Null if the mesh has none. */
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> patch_partitioner;

    /** Of quadratic cells, the middle nodes of the edges in the order of tetrahedron_edges, by
     * LocalCell::index; otherwise none. */
    std::vector<std::array<unsigned int, 6>> cell_middles;

    /** Of quadratic cells, the middle nodes of the edges 01, 12, 20 of each face; otherwise none.
     */
    std::vector<std::array<unsigned int, 3>> face_middles;

    unsigned int n_cells;         ///< length of values by cell
    std::vector<LocalCell> cells; ///< this process's own and the ghosts next to them
    std::vector<LocalFace> faces; ///< of these cells on the surface, normals pointing outward

    bool
    is_quadratic() const
    {
      return !cell_middles.empty();
    }

    /** How many functions the mean stress of a patch is made of: a constant or, in quadratic cells,
     * all linear ones. */
    unsigned int
    n_functions_of_patch() const
    {
      return is_quadratic() ? 4 : 1;
    }

  private:
    /** The nodes of a part. */
    struct Numbers
    {
      std::vector<unsigned int> of_vertices, of_middles;
    };

    /** Sets partitioner. */
    template <int dim>
    Numbers
    number_nodes(const MeshPart &part, MPI_Comm communicator);

    void
    collect_nodes(const MeshPart &part, const Numbers &numbers);

    void
    collect_cells(const MeshPart &part, const Numbers &numbers);

    void
    collect_faces(const MeshPart &part, const Numbers &numbers);

    void
    find_patch_partitioner(unsigned int n_patches, MPI_Comm communicator);
  };
} // namespace Supple

#endif
