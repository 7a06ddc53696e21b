#ifndef supple_cells_h
#define supple_cells_h

#include <supple/base/memory.h>
#include <supple/linear_algebra/block_matrix.h>
#include <supple/mechanics/material.h>
#include <supple/mechanics/rotation.h>
#include <supple/mesh/section.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace Supple
{
  /**
   * How the operator K' knows of the rotations.
   *
   * - frozen: as if they stayed what they are: positive definite, but no derivative of the force.
   * - consistent: the derivative of the force of polar rotations, which is symmetric but may be
   *   indefinite where the body is compressed.
   * - definite: the same, projected cell by cell to the nearest positive semidefinite one.
   */
  enum class Tangent
  {
    frozen,
    consistent,
    definite
  };


  /** One linear tetrahedron, or triangle, as Cells wants to know it. */
  struct Cell
  {
    std::array<unsigned int, 4> nodes; ///< local node numbers, positively oriented; 3 of a triangle
    IsotropicMaterial material;
    bool owned; ///< counted in sums: true on exactly one process
  };


  /** Sums and extremes over the owned cells of one process. */
  struct CellSums
  {
    double kinetic = 0.;                        ///< [J]
    double elastic = 0.;                        ///< [J]
    std::array<double, 3> linear_momentum{{}};  ///< [kg m/s]
    std::array<double, 3> angular_momentum{{}}; ///< [kg m^2/s], about the origin
    double min_volume_ratio = 1e300;
    double max_volume_ratio = -1e300;
    unsigned int inverted   = 0; ///< cells with a volume ratio of zero or less
  };


  /** What is drawn of a cell. */
  struct CellState
  {
    double volume_ratio;
    double von_mises_stress; ///< [Pa]
    double rotation_angle;   ///< [degrees]
    double pressure;         ///< [Pa], positive where the cell is squeezed
  };


  /**
   * How much a cell's volume has changed, in a measure that is linear in the displacement as long
   * as H is kept: V theta = constant + sum_a gradient_a . u_a.
   */
  struct VolumeChange
  {
    double volume;                                  ///< V at rest [m^3]
    double constant;                                ///< [m^3]
    std::array<std::array<double, 3>, 4> gradients; ///< V H g_a [m^2], nodes ascending
  };


  /**
   * All linear tetrahedra of one process: gradients of the shape functions, volumes, materials,
   * rotations and places in the matrix, in flat arrays computed once. n_lanes cells make a batch
   * and are computed side by side.
   *
   *           3
   *          /|\         F = I + sum_a u_a g_a^T          deformation gradient
   *         / | \        S = R^T F                        in the cell's rotated frame
   *        /  |  \       e = sym(S) - I                   strain
   *       0---|---2      P = 2 mu e + lambda tr(e) I      stress
   *        \  |  /       f_a = V R P g_a                  force of node a
   *         \ | /        W = V (mu e:e + lambda/2 tr(e)^2)
   *          \|/         K_ab = V (lambda h_a h_b^T + mu h_b h_a^T + mu (h_a.h_b) I),   h_a = R g_a
   *           1
   *
   * (Mueller & Gross 2004; Hauth & Strasser 2004.) If polar rotations are to follow the
   * displacement (Chao et al. 2010; McAdams et al. 2011), the stress has one more derivative: with
   * the axial vector a = sum_a g_a x R^T du_a of twice the skew part of R^T dF,
   *
   *       dW^2 = (frozen) + V a.H a,  H = mu I - (2 mu - lambda tr(S - I)) (tr(S) I - S)^-1,
   *
   * which acts on skew parts alone, as the frozen part does on symmetric ones: it can be projected
   * to a positive semidefinite H by itself.
   *
   * In a plane body (Section) the cells are triangles. Each is taken as a tetrahedron whose fourth
   * node has no gradient and no place in the matrix, and which is as thick as its section: then
   * F33 = 1. In an axisymmetric one with centroids at r
   *
   *           F33 = 1 + sum_a c u_a.e_x,   c = 1/(3 r),   V = 2 pi r A
   *           f_a += V P33 c e_x
   *           K_ab = V (lambda (h_a + c e_x) (h_b + c e_x)^T + mu h_b h_a^T + mu (h_a.h_b) I
   *                     + 2 mu c^2 e_x e_x^T)
   *
   * for R turns about z, so that neither F33 nor the direction e_x of its change take part in it.
   * Displacements, velocities and forces are arrays
   * of 3 n_local doubles, node by node; ghost values must be valid in what is read, and those of
   * what is written are meaningless.
   */
  class Cells
  {
  public:
    /**
     * @param positions   rest positions [m] of the local nodes, of which the first @p n_owned count
     * in sums
     * @param vertex_mass mass [kg] of each node beside that of the cells
     * @param n_threads   at most, among which cells are shared out
     */
    Cells(const std::vector<std::array<double, 3>> &positions,
          unsigned int n_owned,
          const std::vector<Cell> &cells,
          bool lumped_mass,
          double vertex_mass,
          const Section &section = Section(),
          unsigned int n_threads = 1);

    /** Finds the place of each cell's blocks in matrices with this pattern, which has a piece for
     * each thread. */
    void
    connect(const SymmetricPattern &pattern);

    /** R of every cell from the displacement; kept until called again. Before the first call R = I.
     */
    void
    update_rotations(RotationMethod method, const double *displacement);

    /** f += sum R K (R^T x - X), with the rotations that are kept. */
    void
    add_internal_force(const double *displacement, double *force) const;

    /** y += K' w, with K' = sum R K R^T. */
    void
    add_stiffness_product(const double *w, double *y) const;

    /** Computes what the derivatives of the rotations add to K'; kept until called again. */
    void
    update_rotation_stiffness(Tangent tangent, const double *displacement);

    /**
     * The same where the resistance to a change of volume is not the cells' own: what mean stresses
     * [Pa], one for each cell, add by the second derivative of a cell's volume change. It is
     * indefinite for the determinant: there the definite tangent goes without it.
     */
    void
    update_rotation_stiffness(Tangent tangent,
                              const double *displacement,
                              VolumeMeasure measure,
                              const std::vector<double> &mean_stress);

    /**
     * Of each cell in the order given to the constructor, about this displacement: theta = H : F -
     * h with H = R, h = 3 (trace, with the rotations that are kept) or H = cof F, h = 2 det F + 1
     * (determinant). With the hoop strain of an axisymmetric body.
     */
    void
    volume_changes(VolumeMeasure measure,
                   const double *displacement,
                   std::vector<VolumeChange> &changes) const;

    /** y += (that part of K') w */
    void
    add_rotation_product(const double *w, double *y) const;

    /** y += M w on all nodes, those held included. */
    void
    add_mass_product(const double *w, double *y) const;

    /** A += mass_factor M + stiffness_factor K' + rotation_factor (what rotations add to K'), with
     * this many shear moduli added to the bulk modulus. */
    void
    add_tangent(double mass_factor,
                double stiffness_factor,
                double rotation_factor,
                SymmetricBlockMatrix &A,
                double added_bulk = 0.) const;

    /** From now on add_tangent() takes the rotations of this moment, until they are renewed or
     * released. */
    void
    keep_rotations();

    /** From now on add_tangent() takes the rotations of the forces. */
    void
    release_rotations();

    /** Whether K' is free of derivatives of the rotations. */
    bool
    tangent_is_frozen() const;

    /** Owned cells that have turned by more than an angle [rad] since keep_rotations() or renewal.
     */
    std::size_t
    n_turned(double angle) const;

    /** Renews the rotations of these cells, and adds what this changes to A = ... +
     * stiffness_factor K'. */
    void
    renew_tangent(double angle, double stiffness_factor, SymmetricBlockMatrix &A);

    /** M += the mass matrix. */
    void
    add_mass(SymmetricScalarMatrix &M) const;

    /** Mass [kg] of each local node, that of a cell shared among its nodes: the row sums of the
     * mass matrix. */
    void
    add_nodal_mass(double *mass) const;

    /** f += integrals of shape functions times a linear force per volume [N/m^3], given at the
     * nodes. */
    void
    add_load(const double *force_density, double *force) const;

    /** Sum over owned cells and their nodes of (round-off in the node's force)^2 [N^2], at strains
     * of order one. */
    double
    round_off_square() const;

    /** @p velocity may be null: then nothing moves. An axisymmetric body has no momenta but that
     * along its axis. */
    CellSums
    sums(const double *displacement, const double *velocity) const;

    /** For each cell in the order given to the constructor, owned or not. */
    std::vector<CellState>
    states(const double *displacement) const;

  private:
    struct Batch
    {
      std::array<std::array<Pack, 3>, 4> gradients; ///< g_a [1/m]
      Pack volume;                                  ///< [m^3]
      Pack lambda, mu, density;
      Pack owned;                                              ///< 1 or 0
      std::array<std::array<std::uint32_t, n_lanes>, 4> nodes; ///< ascending in each lane
    };

    struct Slots
    {
      std::array<std::array<std::uint32_t, n_lanes>, 6>
        lower; ///< (1,0), (2,0), (2,1), (3,0), (3,1), (3,2)
      std::array<std::array<std::uint32_t, n_lanes>, 4> diagonal;
    };

    /** What an axisymmetric batch needs beside. */
    struct Hoop
    {
      Pack gradient; ///< c = 1/(3 r) [1/m], r the centroid's distance from the axis
      std::array<Pack, 4> nodal_radius; ///< of each node, over r; zero for the fourth
    };

    /** Of a cell's nodes, in the order of Slots::lower. */
    static constexpr std::array<std::array<unsigned int, 2>, 6> lower_pairs = {
      {{{1, 0}}, {{2, 0}}, {{2, 1}}, {{3, 0}}, {{3, 1}}, {{3, 2}}}};

    using NodalPack = std::array<std::array<Pack, 3>, 4>;

    static NodalPack
    gather(const Batch &batch, const double *nodal);

    static void
    scatter(const Batch &batch, const NodalPack &values, double *nodal);

    void
    add_cell(std::size_t number, const Cell &cell);

    /**
     * Cuts the batches into two chunks in a row for each thread, such that those of even number
     * share no nodes with each other, and neither do those of odd number. Where cells next to each
     * other are far apart in number this takes fewer threads, or one.
     */
    void
    cut_into_chunks(unsigned int n_threads);

    bool
    chunks_are_apart() const;

    /** action(batch) for those of a chunk, in a sweep that asks for what comes next. */
    template <class Action>
    void
    for_chunk(const unsigned int chunk, const Action &action) const
    {
      for (std::size_t b = chunk_start[chunk]; b < chunk_start[chunk + 1]; ++b)
        {
          ask_for_next(batches, b);
          ask_for_next(rotations, b);
          action(b);
        }
    }

    /** action(batch) for batches that write to what is their own, on several threads. */
    template <class Action>
    void
    for_batches(const Action &action) const
    {
      run_tasks(chunk_start.size() - 1,
                [&](const unsigned int chunk) { for_chunk(chunk, action); });
    }

    /** The same for batches that add to nodes and to their couplings: on several threads those of
     * even chunks, and then those of odd ones. */
    template <class Action>
    void
    for_batches_in_turn(const Action &action) const
    {
      const unsigned int n_chunks = chunk_start.size() - 1;
      for (unsigned int parity = 0; parity < std::min(2u, n_chunks); ++parity)
        run_tasks((n_chunks + 1) / 2,
                  [&](const unsigned int thread) { for_chunk(2 * thread + parity, action); });
    }

    /** With the hoop strain of an axisymmetric body in the last entry. */
    Matrix3<Pack>
    gradient(std::size_t batch, const NodalPack &values) const;

    /** R, the identity for linear elasticity. */
    Matrix3<Pack>
    rotation_of(std::size_t batch) const;

    /** sym(R^T G) */
    Matrix3<Pack>
    rotated_back(std::size_t batch, const Matrix3<Pack> &G) const;

    /** sym(R^T F) - I */
    Matrix3<Pack>
    strain(std::size_t batch, const Matrix3<Pack> &F) const;

    static Matrix3<Pack>
    stress(const Batch &batch, const Matrix3<Pack> &strain);

    Matrix3<Pack>
    deformation_gradient(std::size_t batch, const double *displacement) const;

    void
    add_stress_divergence(std::size_t batch, const Matrix3<Pack> &strain, double *force) const;

    /** Entry (a, c) of a cell's mass matrix. */
    Pack
    mass_entry(std::size_t batch, unsigned int a, unsigned int c) const;

    /** What a cell gives of its mass to a node, over all of it. */
    Pack
    nodal_share(std::size_t batch, unsigned int a) const;

    /** The integral of shape functions times the linear function with these values at the nodes,
     * for a cell of this weight; lumped: with all of its weight at the nodes. */
    NodalPack
    integral(std::size_t batch, const Pack &weight, bool lumped, const NodalPack &values) const;

    /** The cell's mass matrix times nodal values. */
    NodalPack
    mass_product(std::size_t batch, const NodalPack &values) const;

    /** Whether cells have turned by more than an angle with this 8 sin(angle/2)^2. */
    Pack::mask_type
    has_turned(std::size_t batch, double bound) const;

    /** add_tangent() for the cells of a batch. */
    void
    add_tangent_of_batch(std::size_t batch,
                         double mass_factor,
                         double stiffness_factor,
                         double rotation_factor,
                         double added_bulk,
                         SymmetricBlockMatrix &A) const;

    template <bool axisymmetric>
    void
    add_tangent_of(std::size_t batch,
                   double mass_factor,
                   double stiffness_factor,
                   double rotation_factor,
                   double added_bulk,
                   SymmetricBlockMatrix &A) const;

    /** R g_a */
    NodalPack
    rotated_gradients(std::size_t batch) const;

    /** The columns of V [h_a]^T H [h_c] in the body's frame, [h] w = h x w. */
    std::array<std::array<Pack, 3>, 3>
    rotation_block(std::size_t batch, const NodalPack &h, unsigned int a, unsigned int c) const;

    /** The columns of the second derivative of the volume energy, nodes a and c. */
    std::array<std::array<Pack, 3>, 3>
    volume_block(std::size_t batch, unsigned int a, unsigned int c) const;

    /** V s times the derivative of cof F in a direction G, with hoop strain. */
    Matrix3<Pack>
    volume_stress(std::size_t batch, const Matrix3<Pack> &G) const;

    void
    update_volume_stiffness(const double *displacement, const std::vector<double> &mean_stress);

    void
    add_volume_product(const double *w, double *y) const;

    /** Node by node, P g_a and the hoop's part. */
    NodalPack
    divergence(std::size_t batch, const Matrix3<Pack> &P) const;

    void
    add_deformation(const double *displacement, CellSums &sums) const;

    void
    add_motion(const double *displacement, const double *velocity, CellSums &sums) const;

    void
    add_motion_of_vertices(const double *displacement,
                           const double *velocity,
                           CellSums &sums) const;

    const std::size_t n_cells;
    const unsigned int n_owned; ///< nodes
    const bool lumped_mass;
    const double vertex_mass;
    const Section section;
    const unsigned int n_nodes; ///< of a cell
    const double pair_share;    ///< what two nodes of a cell share of its mass
    std::vector<Batch> batches;
    std::vector<std::size_t> chunk_start; ///< of batches; one chunk, or two for each thread
    std::vector<Hoop> hoops;              ///< of an axisymmetric body, otherwise none
    std::vector<Matrix3<Pack>> rotations;
    std::vector<Matrix3<Pack>> kept_rotations;     ///< of the tangent; none: those above
    std::vector<Matrix3<Pack>> rotation_stiffness; ///< V R H R^T; empty for frozen rotations
    std::vector<Matrix3<Pack>> volume_stiffness;   ///< V s F; empty but for determinants
    std::vector<Slots> slots;
    std::vector<std::array<double, 3>> positions;
  };
} // namespace Supple

#endif
