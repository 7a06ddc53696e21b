#ifndef supple_cells_h
#define supple_cells_h

#include <supple/base/memory.h>
#include <supple/base/threads.h>
#include <supple/linear_algebra/block_matrix.h>
#include <supple/linear_algebra/matrix3.h>
#include <supple/mechanics/material.h>
#include <supple/mesh/section.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace Supple
{
  /** One tetrahedron, or triangle, as Cells wants to know it. */
  struct Cell
  {
    std::array<unsigned int, 4> nodes; ///< local node numbers, positively oriented; 3 of a triangle
    IsotropicMaterial material;
    bool owned; ///< counted in sums: true on exactly one process

    /** Of a quadratic cell, the nodes of the edges 01, 02, 03, 12, 13, 23. */
    std::array<unsigned int, 6> middles{};
  };


  /** Kinetic energy and momenta of the owned nodes of one process. */
  struct MotionSums
  {
    double kinetic = 0.;                        ///< [J]
    std::array<double, 3> linear_momentum{{}};  ///< [kg m/s]
    std::array<double, 3> angular_momentum{{}}; ///< [kg m^2/s], about the origin
  };


  class CellSlots;


  /**
   * The geometry and the mass of all tetrahedra of one process: gradients of the shape
   * functions, volumes, materials and nodes, in flat arrays computed once. n_lanes cells make a
   * batch and are computed side by side. What stress a deformation causes is the matter of a Law.
   *
   *           3
   *          /|\         F = I + sum_a u_a g_a^T          deformation gradient
   *         / | \        f_a = V P g_a                    force of node a, P a stress
   *        /  |  \
   *       0---|---2
   *        \  |  /
   *         \ | /
   *          \|/
   *           1
   *
   * In a plane body (Section) the cells are triangles. Each is taken as a tetrahedron whose fourth
   * node has no gradient and no place in the matrix, and which is as thick as its section: then
   * F33 = 1. In an axisymmetric one with centroids at r
   *
   *           F33 = 1 + sum_a c u_a.e_x,   c = 1/(3 r),   V = 2 pi r A
   *           f_a += V P33 c e_x
   *
   * Quadratic cells have six more nodes, in the middles of their edges, and four points, each of
   * which is computed as a linear cell (quadratic_cells.h).
   *
   * Displacements, velocities and forces are arrays of 3 n_local doubles, node by node; ghost
   * values must be valid in what is read, and those of what is written are meaningless.
   */
  class Cells
  {
  public:
    /** The constants of n_lanes cells. */
    struct Batch
    {
      std::array<std::array<Pack, 3>, 4> gradients; ///< g_a [1/m]
      Pack volume;                                  ///< [m^3]
      Pack lambda, mu, density;
      Pack owned;                                              ///< 1 or 0
      std::array<std::array<std::uint32_t, n_lanes>, 4> nodes; ///< ascending in each lane
    };

    /** What an axisymmetric batch has beside. */
    struct Hoop
    {
      Pack gradient; ///< c = 1/(3 r) [1/m], r the centroid's distance from the axis
      std::array<Pack, 4> nodal_radius; ///< of each node, over r; zero for the fourth
    };

    /** A vector at each of the four nodes. */
    using NodalPack = std::array<std::array<Pack, 3>, 4>;

    /** The nodes of a batch of quadratic cells, in the order of Quadratic::corners. */
    using TenNodes = std::array<std::array<std::uint32_t, n_lanes>, 10>;

    /**
     * @param positions   rest positions [m] of the local nodes, of which the first @p n_owned count
     * in sums
     * @param vertex_mass mass [kg] of each node beside that of the cells
     * @param n_threads   at most, among which cells are shared out
     * @param quadratic   the cells, tetrahedra, have nodes in the middles of their edges
     */
    Cells(const std::vector<std::array<double, 3>> &positions,
          unsigned int n_owned,
          const std::vector<Cell> &cells,
          bool lumped_mass,
          double vertex_mass,
          const Section &section = Section(),
          unsigned int n_threads = 1,
          bool quadratic         = false);

    std::size_t
    n_batches() const
    {
      return batches.size();
    }

    const Batch &
    batch(const std::size_t b) const
    {
      return batches[b];
    }

    /** Of a batch of an axisymmetric body. */
    const Hoop &
    hoop(const std::size_t b) const
    {
      return hoops[b];
    }

    bool
    is_quadratic() const
    {
      return !ten_nodes.empty();
    }

    /** How many points a cell has, at each of which it has a deformation gradient of its own. */
    unsigned int
    n_points() const
    {
      return is_quadratic() ? 4 : 1;
    }

    /** Of a batch of quadratic cells. */
    const TenNodes &
    nodes_of(const std::size_t b) const
    {
      return ten_nodes[b];
    }

    /** A point of quadratic cells as if it were a batch of linear ones: with the gradients of the
     * barycentric coordinates there, and as much of the volume as the point stands for. */
    Batch
    point(const std::size_t b, const unsigned int q) const
    {
      Batch point = batches[b];
      if (curved.empty())
        point.volume *= 0.25;
      else
        {
          point.gradients = curved[b][q].gradients;
          point.volume    = curved[b][q].weight;
        }
      return point;
    }

    /** Where a point of a quadratic cell is at rest [m]. */
    std::array<double, 3>
    place_of_point(std::size_t cell, unsigned int q) const;

    /** Calls action(lane, cell) for each lane of a batch that is a cell, numbered as given to the
     * constructor. */
    template <class Action>
    void
    for_lanes(const std::size_t b, const Action &action) const
    {
      for (unsigned int lane = 0; lane < n_lanes && b * n_lanes + lane < n_cells; ++lane)
        action(lane, b * n_lanes + lane);
    }

    static NodalPack
    gather(const Batch &batch, const double *nodal);

    /** Adds the values to those of the nodes, or subtracts them (sign = -1). */
    template <int sign = 1>
    static void
    scatter(const Batch &batch, const NodalPack &values, double *nodal);

    /** The gradient of a field with these nodal values, with the hoop strain of an axisymmetric
     * body in the last entry. */
    Matrix3<Pack>
    gradient(std::size_t batch, const NodalPack &values) const;

    /** F */
    Matrix3<Pack>
    deformation_gradient(std::size_t batch, const double *displacement) const;

    /** Node by node, P g_a and the hoop's part. */
    NodalPack
    divergence(std::size_t batch, const Matrix3<Pack> &P) const;

    /** Calls action(batch) for batches that write to what is their own, on several threads. */
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

    /** Calls add(batch, sum) for all batches, on several threads: a sum for each chunk, which
     * begins as @p zero. The chunks do not depend on who does them, and neither do the digits. */
    template <class Sum, class Add>
    std::vector<Sum>
    sums_of_chunks(const Sum &zero, const Add &add) const
    {
      std::vector<Sum> sums(chunk_start.size() - 1, zero);
      run_tasks(sums.size(), [&](const unsigned int chunk) {
        Sum sum = zero; // apart from those of other threads
        for_chunk(chunk, [&](const std::size_t b) { add(b, sum); });
        sums[chunk] = sum;
      });
      return sums;
    }

    /** The first batch of each chunk, and their number in the end. */
    const std::vector<std::size_t> &
    chunk_starts() const
    {
      return chunk_start;
    }

    /** Entry (a, c) of a cell's mass matrix [kg]; of the ten nodes of a quadratic cell. */
    Pack
    mass_entry(std::size_t batch, unsigned int a, unsigned int c) const;

    /** Entry of P^T M P, where P gives the middles of edges the means of their ends [kg]. */
    Pack
    vertex_mass_entry(std::size_t batch, bool diagonal) const;

    /** y += M w on all nodes, those held included. */
    void
    add_mass_product(const double *w, double *y) const;

    /** M += the mass matrix. */
    void
    add_mass(const CellSlots &slots, SymmetricScalarMatrix &M) const;

    /** Mass [kg] of each local node, that of a cell shared among its nodes: the row sums of the
     * mass matrix. */
    void
    add_nodal_mass(double *mass) const;

    /** f += integrals of shape functions times a linear force per volume [N/m^3], given at the
     * nodes. */
    void
    add_load(const double *force_density, double *force) const;

    /** An axisymmetric body has no momenta but that along its axis.
     * @param momentum M v on all rows [kg m/s], see add_mass_product() */
    MotionSums
    motion(const double *displacement, const double *velocity, const double *momentum) const;

    const std::size_t n_cells;
    const unsigned int n_owned; ///< nodes
    const double vertex_mass;   ///< [kg]
    const Section section;
    const unsigned int n_nodes; ///< of a cell, without the middles of edges

  private:
    /** The geometry of curved quadratic cells at a point. */
    struct CurvedPoint
    {
      std::array<std::array<Pack, 3>, 4> gradients; ///< of the barycentric coordinates [1/m]
      Pack weight;                                  ///< a quarter of the volume, where it is [m^3]
    };

    void
    add_cell(std::size_t number, const Cell &cell);

    /** @param order of its corners in the batch */
    void
    add_middles(std::size_t number, const Cell &cell, const std::array<unsigned int, 4> &order);

    /** Whether a node is off the middle of its edge, by more than round-off. */
    bool
    any_is_curved() const;

    /** Of all cells, by the places of their ten nodes: four points, and their sum as the volume. */
    void
    find_curved_points();

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
          action(b);
        }
    }

    /** What two of the ten nodes of a quadratic cell share of its mass, over all of it. */
    double
    share_of_pair(unsigned int a, unsigned int c) const;

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

    const bool lumped_mass;
    const double pair_share; ///< what two nodes of a cell share of its mass
    std::vector<Batch> batches;
    std::vector<std::size_t> chunk_start; ///< of batches; one chunk, or two for each thread
    std::vector<Hoop> hoops;              ///< of an axisymmetric body, otherwise none
    std::vector<TenNodes> ten_nodes;      ///< of quadratic cells, otherwise none
    std::vector<std::array<CurvedPoint, 4>> curved; ///< if any quadratic cell is, otherwise none
    std::vector<std::array<double, 3>> positions;
  };


  /**
   * Where the blocks of the cells stand in matrices of one pattern, which has a piece for each
   * thread of the cells. Entries of held and of ghost nodes go to a spare block of each thread.
   *
   * The nodes of a linear cell ascend, those of a quadratic one need not where some are ghosts:
   * there the transposed block of a pair is what the matrix keeps.
   */
  class CellSlots
  {
  public:
    /** The place of one block in each lane. */
    using Slot = std::array<std::uint32_t, n_lanes>;

    /** Of a cell's nodes, those of the blocks below the diagonal. */
    static constexpr std::array<std::array<unsigned int, 2>, 6> lower_pairs = {
      {{{1, 0}}, {{2, 0}}, {{2, 1}}, {{3, 0}}, {{3, 1}}, {{3, 2}}}};

    /** The ten nodes of quadratic cells: 45 pairs a > b, (1, 0), (2, 0), (2, 1), ... */
    struct QuadraticPlaces
    {
      std::array<Slot, 45> lower;
      std::array<Slot, 10> diagonal;
      std::array<std::uint8_t, 45> transposed; ///< a bit for each lane
    };

    CellSlots(const Cells &cells, const SymmetricPattern &pattern);

    /** Of the corners alone, in a matrix on the vertices.
     * @param vertex the number of each node that is a vertex, ascending over own ones and over
     * ghosts */
    CellSlots(const Cells &cells,
              const SymmetricPattern &pattern,
              const std::vector<std::uint32_t> &vertex);

    const QuadraticPlaces &
    quadratic(const std::size_t batch) const
    {
      return quadratic_places[batch];
    }

    const std::array<Slot, 6> &
    lower(const std::size_t batch) const
    {
      return places[batch].lower;
    }

    const std::array<Slot, 4> &
    diagonal(const std::size_t batch) const
    {
      return places[batch].diagonal;
    }

    /** Asks memory for the places of a batch that comes soon. */
    void
    ask_for_next_after(const std::size_t batch) const
    {
      ask_for_next(places, batch);
    }

  private:
    struct Places
    {
      std::array<Slot, 6> lower; ///< in the order of lower_pairs
      std::array<Slot, 4> diagonal;
    };

    /** Where a pair of nodes stands, or the spare block of a thread. */
    static std::uint32_t
    place_of_pair(const SymmetricPattern &pattern,
                  std::uint32_t node,
                  std::uint32_t other,
                  std::size_t spare);

    /** @param number of the corner a of a cell in a batch: number(b, a, lane) */
    template <class Number>
    void
    find_places(const Cells &cells, const SymmetricPattern &pattern, const Number &number);

    void
    find_quadratic_places(const Cells &cells, const SymmetricPattern &pattern);

    std::vector<Places> places;                    ///< of linear cells, otherwise none
    std::vector<QuadraticPlaces> quadratic_places; ///< of quadratic cells, otherwise none
  };

  inline Cells::NodalPack
  Cells::gather(const Batch &batch, const double *nodal)
  {
    namespace stdx = std::experimental;

    NodalPack values;
    for (unsigned int a = 0; a < 4; ++a)
      {
        alignas(64) double buffer[3][n_lanes];
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          for (unsigned int i = 0; i < 3; ++i)
            buffer[i][lane] = nodal[3 * static_cast<std::size_t>(batch.nodes[a][lane]) + i];
        for (unsigned int i = 0; i < 3; ++i)
          values[a][i].copy_from(buffer[i], stdx::vector_aligned);
      }
    return values;
  }


  template <int sign>
  inline void
  Cells::scatter(const Batch &batch, const NodalPack &values, double *nodal)
  {
    namespace stdx = std::experimental;

    static_assert(sign == 1 || sign == -1, "values are added or subtracted");
    for (unsigned int a = 0; a < 4; ++a)
      {
        alignas(64) double buffer[3][n_lanes];
        for (unsigned int i = 0; i < 3; ++i)
          values[a][i].copy_to(buffer[i], stdx::vector_aligned);
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          for (unsigned int i = 0; i < 3; ++i)
            nodal[3 * static_cast<std::size_t>(batch.nodes[a][lane]) + i] += sign * buffer[i][lane];
      }
  }


  inline Matrix3<Pack>
  Cells::gradient(const std::size_t b, const NodalPack &values) const
  {
    const Batch &batch = batches[b];
    Matrix3<Pack> G;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        G(i, j) = values[0][i] * batch.gradients[0][j] + values[1][i] * batch.gradients[1][j] +
                  values[2][i] * batch.gradients[2][j] + values[3][i] * batch.gradients[3][j];
    if (!hoops.empty())
      G(2, 2) += hoops[b].gradient * (values[0][0] + values[1][0] + values[2][0]);
    return G;
  }


  inline Matrix3<Pack>
  Cells::deformation_gradient(const std::size_t b, const double *displacement) const
  {
    Matrix3<Pack> F = gradient(b, gather(batches[b], displacement));
    for (unsigned int i = 0; i < 3; ++i)
      F(i, i) += 1.;
    return F;
  }


  inline Cells::NodalPack
  Cells::divergence(const std::size_t b, const Matrix3<Pack> &P) const
  {
    const auto &g = batches[b].gradients;
    NodalPack f;
    for (unsigned int a = 0; a < 4; ++a)
      for (unsigned int i = 0; i < 3; ++i)
        f[a][i] = P(i, 0) * g[a][0] + P(i, 1) * g[a][1] + P(i, 2) * g[a][2];
    if (!hoops.empty())
      for (unsigned int a = 0; a < 3; ++a)
        f[a][0] += hoops[b].gradient * P(2, 2);
    return f;
  }


  inline Pack
  Cells::nodal_share(const std::size_t b, const unsigned int a) const
  {
    if (hoops.empty())
      return 1. / n_nodes;
    return (3. + hoops[b].nodal_radius[a]) / 12.;
  }


  /**
   * (1 + delta_ac) pair_share of the cell's mass. All around an axis the integral of N_a N_c has
   * the weight r, which makes it (3 + r_a/r + r_c/r)/5 times that.
   */
  inline Pack
  Cells::mass_entry(const std::size_t b, const unsigned int a, const unsigned int c) const
  {
    const Pack mass = batches[b].density * batches[b].volume;
    if (is_quadratic())
      return share_of_pair(a, c) * mass;
    if (lumped_mass)
      return a == c ? nodal_share(b, a) * mass : Pack(0.);
    const Pack share = (a == c ? 2. : 1.) * pair_share * mass;
    if (hoops.empty())
      return share;
    return 0.2 * (3. + hoops[b].nodal_radius[a] + hoops[b].nodal_radius[c]) * share;
  }
} // namespace Supple

#endif
