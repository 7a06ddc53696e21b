#ifndef supple_body_h
#define supple_body_h

#include <supple/mechanics/material_parameters.h>
#include <supple/mechanics/volumetric_patches.h>
#include <supple/mesh/mesh.h>

#include <memory>

namespace Supple
{
  /**
   * The elastic body: linear or quadratic displacements on the mesh, and its cells with their
   * material. A node is a vertex, or the middle of an edge of quadratic cells, with its three
   * degrees of freedom, 3 node, 3 node + 1, 3 node + 2; this process's own nodes have the local
   * numbers 0 to n_owned - 1 and ghosts those up to n_local - 1.
   *
   * Each process holds every cell that touches one of its nodes, so that forces and matrix rows of
   * its own nodes need no messages but the ghost values of the displacement.
   */
  class Body
  {
  public:
    /**
     * @param most_threads of this process; small bodies take fewer
     * @param scene        knows where the entries were set, for messages
     * @throws InputError
     */
    Body(const Mesh &mesh,
         const MaterialParameters &material,
         unsigned int most_threads,
         const ParameterFile &scene);

    const Mesh &mesh;
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;

    const unsigned int n_threads;                        ///< of this process, see threads.h
    const unsigned int n_owned;                          ///< nodes
    const unsigned int n_local;                          ///< nodes, ghosts included
    const std::vector<std::array<double, 3>> &positions; ///< at rest [m], of local nodes
    const std::vector<unsigned int> &serial_vertex;      ///< vertex index in the unpartitioned mesh

    std::vector<std::array<unsigned int, 4>> cell_nodes;   ///< local node numbers
    std::vector<std::array<unsigned int, 6>> cell_middles; ///< those of edges of quadratic cells
    std::vector<unsigned int> cell_index;                  ///< place in values by cell
    std::vector<unsigned int> serial_cell;                 ///< index in the unpartitioned mesh
    std::vector<bool> cell_owned;                          ///< true on exactly one process
    std::vector<unsigned int> cell_material;               ///< material id of each cell

    std::unique_ptr<const Cells> cells;

    bool
    is_quadratic() const
    {
      return mesh.is_quadratic();
    }

    /** Whether the node with this index in the unpartitioned mesh is the middle of an edge. */
    bool
    is_middle(const unsigned int index) const
    {
      return index + mesh.n_middles >= mesh.n_serial_vertices();
    }

    /** All local nodes of a cell; two of a triangle's are the same. */
    std::vector<unsigned int>
    nodes_of_cell(std::size_t cell) const;

    /** Whether patches resist to a change of volume in place of the cells. */
    bool
    has_patches() const
    {
      return !patch_cells.empty();
    }

    /** Those patches, at rest; null if there are none.
     * @param linear whether the volume is measured linearly, whatever the scene says */
    std::unique_ptr<VolumetricPatches>
    make_patches(bool linear) const;

    /** Degrees of freedom on all processes, without those along z of a plane body. */
    unsigned int
    n_dofs() const;

    /** Whether a degree of freedom stays at rest whatever the scene says: a plane body does not
     * leave its plane, and an axisymmetric one does not open at its axis. */
    bool
    is_held_by_nature(unsigned int dof) const;

    void
    initialize(Vector &vector) const;

    /** y = M x on all rows, those held included. */
    void
    set_mass_product(Vector &y, const Vector &x) const;

    /** Of the cells with this material id. */
    const IsotropicMaterial &
    material(unsigned int id) const;

    /** Of all materials with cells on any process. */
    double
    largest_poisson() const;

    dealii::Point<3>
    position(unsigned int node) const;

  private:
    std::map<unsigned int, IsotropicMaterial> materials;
    std::vector<PatchCell> patch_cells; ///< of all cells, or none
    const VolumeMeasure volume_measure; ///< of patches

    void
    collect_cells(const MaterialParameters &parameters, const ParameterFile &scene);

    /** @throws InputError for a material of quadratic cells that can have no patches */
    void
    check_patches(const ParameterFile &scene) const;
  };
} // namespace Supple

#endif
