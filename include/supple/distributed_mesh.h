#ifndef supple_distributed_mesh_h
#define supple_distributed_mesh_h

#include <supple/serial_mesh.h>
#include <supple/vector.h>

#include <deal.II/base/partitioner.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /** A cell as one process knows it. */
  struct LocalCell
  {
    std::array<unsigned int, 4> nodes; ///< local numbers; the third of a triangle stands twice
    unsigned int material_id;
    unsigned int index; ///< its place in values by cell
    unsigned int patch; ///< number of its patch on all processes, if the mesh has patches
    bool owned;         ///< true on exactly one process
  };


  /** A face of the body's surface as one process knows it. */
  struct LocalFace
  {
    std::array<unsigned int, 3> nodes; ///< local numbers; the second of an edge stands twice
    unsigned int boundary_id;
    unsigned int cell_index; ///< of its cell in values by cell
    bool owned;              ///< its cell is
  };


  /** What is drawn of a deformed body. The vectors have valid ghost values. */
  struct Drawing
  {
    double time;
    unsigned int step;
    const Vector &positions; ///< of the nodes [m]
    std::vector<std::pair<std::string, const Vector *>> of_nodes;
    std::vector<std::pair<std::string, dealii::Vector<float>>> of_cells; ///< by LocalCell::index
  };


  /**
   * The mesh with a part for each process, and its nodes numbered: deal.II's triangulation and
   * degrees of freedom. What this process knows of them stands here as plain lists, so that nothing
   * else has to know at compile time whether the cells are tetrahedra or triangles.
   *
   * A node is a vertex with its three degrees of freedom, 3 node, 3 node + 1, 3 node + 2; this
   * process's own nodes have the local numbers 0 to n_owned - 1 and ghosts those up to n_local - 1.
   */
  class DistributedMesh
  {
  public:
    /** @throws InputError if a process would have no cell */
    static std::unique_ptr<DistributedMesh>
    create(const SerialMesh &mesh, MPI_Comm communicator);

    virtual ~DistributedMesh() = default;

    /** The files of a drawing: that of this process (VTU), and the record that names those of all
     * processes, @p names. */
    virtual std::pair<std::string, std::string>
    draw(const Drawing &drawing, const std::vector<std::string> &names) const = 0;

    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner; ///< of the unknowns

    unsigned int n_owned;                         ///< nodes
    unsigned int n_local;                         ///< nodes, ghosts included
    std::vector<std::array<double, 3>> positions; ///< of the local nodes [m]
    std::vector<unsigned int> serial_vertex;      ///< their indices in the mesh that was given

    /** Of the patches, all cells of which are on one process: those of its cells and, as ghosts,
     * those of its ghost cells. Null if the mesh has none. */
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> patch_partitioner;

    unsigned int n_cells;         ///< length of values by cell
    std::vector<LocalCell> cells; ///< this process's own and the ghosts next to them
    std::vector<LocalFace> faces; ///< of these cells on the surface, normals pointing outward
  };
} // namespace Supple

#endif
