#ifndef supple_body_h
#define supple_body_h

#include <supple/base/effort.h>
#include <supple/mechanics/cells.h>
#include <supple/mechanics/material_parameters.h>
#include <supple/mechanics/volumetric_patches.h>
#include <supple/mesh/mesh.h>

#include <memory>

namespace Supple
{
  /**
   * The elastic body: linear displacements on the mesh, and its cells with their material. A node
   * is a vertex with its three degrees of freedom, 3 node, 3 node + 1, 3 node + 2; this process's
   * own nodes have the local numbers 0 to n_owned - 1 and ghosts those up to n_local - 1.
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
         const CorotationParameters &corotation,
         unsigned int most_threads,
         const ParameterFile &scene);

    const Mesh &mesh;
    const RotationMethod rotation;
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;

    const unsigned int n_threads;                        ///< of this process, see threads.h
    const unsigned int n_owned;                          ///< nodes
    const unsigned int n_local;                          ///< nodes, ghosts included
    const std::vector<std::array<double, 3>> &positions; ///< at rest [m], of local nodes
    const std::vector<unsigned int> &serial_vertex;      ///< vertex index in the unpartitioned mesh

    std::vector<std::array<unsigned int, 4>> cell_nodes; ///< local node numbers
    std::vector<unsigned int> cell_index;                ///< place in values by cell
    std::vector<unsigned int> cell_material;             ///< material id of each cell

    std::unique_ptr<Cells> cells;

    /** What resists to a change of volume in place of the cells; null if they do it themselves. */
    std::unique_ptr<VolumetricPatches> patches;

    /** Degrees of freedom on all processes, without those along z of a plane body. */
    unsigned int
    n_dofs() const;

    /** Whether a degree of freedom stays at rest whatever the scene says: a plane body does not
     * leave its plane, and an axisymmetric one does not open at its axis. */
    bool
    is_held_by_nature(unsigned int dof) const;

    void
    initialize(Vector &vector) const;

    /** R of every cell from the displacement; nothing to do for linear elasticity. */
    void
    update_rotations(const Vector &displacement, Effort &effort) const;

    /** What the derivatives of the rotations add to K', see Cells. */
    void
    update_rotation_stiffness(Tangent tangent, const Vector &displacement, Effort &effort) const;

    /** y += K' w, without what rotations add. */
    void
    add_stiffness_product(const double *w, double *y) const;

    /** As Cells::sums(), with the energy of patches. */
    CellSums
    sums(const double *displacement, const double *velocity) const;

    /** As Cells::states(), with the pressure of patches. */
    std::vector<CellState>
    states(const double *displacement) const;

    /** As Cells::round_off_square(), with that of patches. */
    double
    round_off_square() const;

    /** f = sum R K (R^T x - X) on owned nodes, held ones included, with the rotations of the last
     * update. */
    void
    internal_force(Vector &force, const Vector &displacement, Effort &effort) const;

    /** Of the cells with this material id. */
    const IsotropicMaterial &
    material(unsigned int id) const;

    /** Of all materials with cells on any process. */
    double
    largest_poisson() const;

    dealii::Point<3>
    position(unsigned int node) const;

    /**
     * The nodes a user means by "vertex 12", "nearest to 0, 0, 1", "boundary 2, 3", "region z > 1"
     * or "all".
     * @throws InputError beginning with @p origin if it is none of these, or there is no such node
     */
    std::vector<bool>
    selected_nodes(const std::string &text, const std::string &origin) const;

    /** The index of the vertex nearest to a point, in the unpartitioned mesh, and its distance [m].
     */
    std::pair<unsigned int, double>
    nearest_vertex(const dealii::Point<3> &point) const;

    /** The nodes of a boundary. @throws InputError beginning with @p origin if there are none. */
    std::vector<bool>
    boundary_nodes(unsigned int boundary_id, const std::string &origin) const;

    /**
     * The faces of boundaries that touch a node of this process, their nodes in the order that
     * makes the normal point out of the body; the second node of an edge stands twice. @throws
     * InputError beginning with @p origin if there is no such boundary
     */
    std::vector<std::array<unsigned int, 3>>
    boundary_faces(const std::vector<unsigned int> &boundary_ids, const std::string &origin) const;

    /** The nodes where an expression is not zero. @throws InputError beginning with @p origin if
     * there are none. */
    std::vector<bool>
    region_nodes(const std::string &expression, const std::string &origin) const;

    /** At rest [m], of a vertex by its index in the mesh; collective. */
    dealii::Point<3>
    place_of_vertex(unsigned int vertex) const;

    /** "vertex 3 at (0, 0, 1)", for a vertex by its index in the mesh. */
    std::string
    vertex_in_words(unsigned int vertex) const;

  private:
    /** nearest_vertex() of a point that is not far from the body. @throws InputError beginning with
     * @p origin if it is */
    unsigned int
    vertex_of_body(const dealii::Point<3> &point, const std::string &origin) const;

    /** @throws InputError beginning with @p origin */
    void
    require_boundary(unsigned int boundary_id, const std::string &origin) const;

    std::map<unsigned int, IsotropicMaterial> materials;

    void
    collect_cells(const MaterialParameters &parameters, const ParameterFile &scene);
  };
} // namespace Supple

#endif
