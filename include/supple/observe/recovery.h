#ifndef supple_recovery_h
#define supple_recovery_h

#include <supple/linear_algebra/halo.h>
#include <supple/mechanics/body.h>

#include <array>
#include <cstdint>
#include <vector>

namespace Supple
{
  /** Up to eight numbers of a point or a vertex, computed side by side. */
  struct Octet
  {
    Lanes<double, 6> lanes;
  };


  /**
   * Superconvergent patch recovery (Zienkiewicz and Zhu 1992): from values at the points of the
   * cells, one or four, it makes continuous ones, x*. The value at a vertex is that of the linear
   * polynomial that fits best, in the mean square weighted by the volume, the points of the cells
   * around the vertex. A linear field is recovered exactly.
   *
   * In linear cells x is constant, and x* linear between the vertices. In quadratic ones x is
   * linear through the four points, and x* quadratic: in the middle of an edge it is the mean of
   * the polynomials of both ends.
   *
   * Where too few cells meet for that, on edges and at corners, the polynomial is the mean of those
   * of the neighbours along edges; where these have too few as well, it is found after theirs.
   *
   * Stresses jump between materials: a vertex has a value for each material that meets there, from
   * the cells of that material alone. Such a pair is a site.
   */
  class Recovery
  {
  public:
    /** Collective. */
    explicit Recovery(const Body &body);

    /** The linear polynomial of a site, about its vertex. */
    struct Fit
    {
      Octet value;
      std::array<Octet, 3> slopes; ///< along x, y, z
    };

    /** A field and what is recovered of it. */
    struct Field
    {
      std::vector<Octet> of_points; ///< cell by cell, in the order of Body::cell_nodes
      std::vector<Fit> of_sites;
    };

    /** Collective. @param of_points of all cells of this process, owned or not */
    Field
    recover(std::vector<Octet> of_points) const;

    /** Whether there are enough cells around each site or around one beside it; where there are
     * not, nothing is recovered that differs from the cells. */
    bool
    is_everywhere() const
    {
      return everywhere;
    }

    /** Whether most of the sites have too few cells for a polynomial of their own, as in a body
     * that is one cube thick: what is recovered there sees a part of the error alone. Collective.
     */
    bool
    is_rough() const;

    /** Lane by lane, the integral over a cell of (x* - x)(y* - y), all around the axis if there is
     * one. */
    Octet
    product(const Field &x, const Field &y, std::size_t cell) const;

    /** x* - x at a point of a quadratic cell; the mean over a linear one. */
    Octet
    difference_at(const Field &x, std::size_t cell, unsigned int point) const;

    /** Volume of a cell [m^3]. */
    double
    volume(std::size_t cell) const;

    /** As much of it as a point stands for [m^3]. */
    double
    volume(const std::size_t cell, const unsigned int point) const
    {
      return points[n_points * cell + point].volume;
    }

  private:
    using Place = std::array<double, 3>;

    struct Point
    {
      Place place;
      double volume; ///< as much of that of the cell as it stands for
    };

    /** A field at the nodes of a cell, in the order of Quadratic::corners for a quadratic one. */
    using NodalOctets = std::array<Octet, 10>;

    /** The vertices of a cell; of a quadratic one in the order of its points. */
    std::array<unsigned int, 4>
    corners(std::size_t cell) const;

    void
    place_points();

    void
    place_quadratic_points();

    /** The materials of each node, as its owner knows them. */
    void
    find_materials();

    void
    find_sites();

    /** Those with too few cells, and the neighbours that their polynomials come from. */
    void
    find_poor_sites();

    /** Those whose neighbours are known already. @param known of all sites */
    void
    find_poor_sites_beside(const std::vector<unsigned int> &known);

    std::size_t
    site_of(unsigned int node, unsigned int material) const;

    Fit
    fit(std::size_t site, const std::vector<Octet> &of_points) const;

    /** The mean of the polynomials of the neighbours of a poor site. */
    Fit
    mean_of_neighbours(std::size_t poor, const std::vector<Fit> &fits) const;

    /** x* - x at the nodes of a cell. */
    NodalOctets
    differences(const Field &x, std::size_t cell) const;

    NodalOctets
    quadratic_differences(const Field &x, std::size_t cell) const;

    Octet
    quadratic_product(const NodalOctets &d, const NodalOctets &e, std::size_t cell) const;

    /** Of each node of a cell of an axisymmetric body, over that of the centroid. */
    std::array<double, 3>
    nodal_radii(std::size_t cell) const;

    const Body &body;
    const Halo halo;
    const unsigned int n_nodes;          ///< of a cell, without the middles of edges
    const unsigned int n_points;         ///< of a cell
    std::vector<Point> points;           ///< cell by cell
    unsigned int n_slots = 1;            ///< sites of a node
    std::vector<unsigned int> materials; ///< of each site; ascending at a node, padded
    std::vector<std::array<std::uint32_t, 4>> sites_of_cells;
    std::vector<std::size_t> start;          ///< of each site in cells_around
    std::vector<std::uint32_t> cells_around; ///< complete for sites of owned nodes
    std::vector<std::uint32_t> poor;         ///< sites of owned nodes
    std::vector<std::size_t> end_of_round;   ///< in poor: each takes from those before
    std::vector<std::size_t> start_of_neighbours;
    std::vector<std::uint32_t> neighbours; ///< sites, of those in poor
    bool everywhere = true;
  };
} // namespace Supple

#endif
