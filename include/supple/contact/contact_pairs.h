#ifndef supple_contact_pairs_h
#define supple_contact_pairs_h

#include <supple/contact/candidates.h>

#include <Eigen/Core>

#include <limits>

namespace Supple
{
  /**
   * Two places at the distance d along the normal n: one on the surface, and the nearest one of a
   * tool, y, or of the surface again. With the nodes of all that moves,
   *
   *   sum c_i x_i - y = d n,   d' = c_i n,
   *
   * where c_i is negative on the other side, and y is zero if that is the surface. The places may
   * be free to move: with them in parameters theta_k, they are where d is least.
   *
   * Where two edges are parallel, the places that are nearest jump from one end to the other: there
   * the barrier is multiplied by a factor that vanishes, as that of Li et al. (2020), and the
   * vertices and ends bear the load.
   */
  struct ContactPair
  {
    static constexpr unsigned int no_tool = std::numeric_limits<unsigned int>::max();

    const SurfacePart *part;
    const SurfacePart *other; ///< of the surface; null if it is a tool's
    unsigned int tool;        ///< number, or no_tool
    bool guards;              ///< it is no point of a rule of integration over the surface
    double weight;            ///< area at rest [m^2]
    double reach;             ///< of the barrier [m]

    unsigned int n; ///< nodes
    std::array<unsigned int, 6> nodes;
    std::array<double, 6> c;
    Arrow normal;    ///< to the surface
    Arrow place;     ///< that of the other side [m]
    double distance; ///< d [m]
    double gap;      ///< d less what the tool keeps to itself [m]

    bool is_flat; ///< the tool is a plane, and d is linear
    unsigned int n_free = 0;
    std::array<std::array<double, 6>, 2> dc{}; ///< dc_i / dtheta_k
    std::array<Arrow, 2> J{};                  ///< derivatives of d n by theta_k [m]

    double factor = 1.; ///< of the barrier
    std::array<Arrow, 6>
      factor_gradient{}; ///< by the places of the nodes, or of a tool's edge [1/m]
    Arrow other_edge;    ///< from one end to the other [m]

    /** Whether the place on the surface is fixed, a vertex or a point of a rule, and the other one
     * is a tool's. */
    bool
    has_fixed_weights() const;

    /** sum c_i x_i @param u displacement of all local nodes [m] */
    Arrow
    place_of_nodes(const Body &body, const double *u) const;
  };


  /** A matrix on the nodes of a pair, up to 18 x 18. */
  using PairMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 18, 18>;


  /**
   * The second derivative of the distance of a pair [1/m],
   *
   *   (c c^T (x) I - B (J^T J)^-1 B^T - d' d'^T)/d,   B_k = c (x) J_k + dc/dtheta_k (x) d n;
   *
   * zero for a plane.
   */
  PairMatrix
  second_derivative(const ContactPair &pair);


  /**
   * The second derivative of the barrier of a pair, without its negative part [1/m]:
   * [b'' d' d'^T + b' d'']_+. Points of a rule leave b' d'' out, which hardly changes the number of
   * Newton's iterations.
   */
  PairMatrix
  barrier_tangent(const ContactPair &pair);


  /**
   * All pairs of the surface and the tools, and then of the surface with itself, whose gap is less
   * than the reach of the barrier: points of a rule of integration against the nearest place of a
   * tool or another face, and guards that nothing, however thin, passes: vertices against faces,
   * edges against edges.
   */
  class PairFinder
  {
  public:
    /** @param guard part of the area that guards have
     * @param reach of the barrier of the surface with itself [m] */
    PairFinder(const ContactSurface &surface, double guard, double reach);

    /** Adds those of a tool. @param u displacement of all local nodes [m] */
    void
    add(std::vector<ContactPair> &pairs,
        const double *u,
        const PlacedTool &tool,
        unsigned int number,
        const Candidates &candidates) const;

    /** Adds those of the surface with itself. */
    void
    add_own(std::vector<ContactPair> &pairs, const double *u, const Candidates &candidates) const;

    const ContactSurface &surface;
    const double guard;
    const double reach; ///< [m]
  };
} // namespace Supple

#endif
