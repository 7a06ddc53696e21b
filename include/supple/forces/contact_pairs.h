#ifndef supple_contact_pairs_h
#define supple_contact_pairs_h

#include <supple/forces/contact_surface.h>

#include <Eigen/Core>

namespace Supple
{
  /**
   * A place on the surface, sum c_i x_i, and the nearest one of a tool, y: at the distance d along
   * the normal n,
   *
   *   sum c_i x_i - y = d n,   d' = c_i n.
   *
   * Either place may be free to move: with the places in parameters theta_k, that where d is least.
   *
   * Where an edge and the segment of a tool are parallel, the places that are nearest jump from one
   * end to the other: there the barrier is multiplied by a factor that vanishes, as that of Li et
   * al. (2020), and the vertices and ends bear the load.
   */
  struct ContactPair
  {
    const SurfacePart *part;
    unsigned int tool; ///< number
    bool guards;       ///< it is no point of a rule of integration over the surface
    double weight;     ///< area at rest [m^2]
    double reach;      ///< of the barrier [m]

    std::array<double, 3> c;
    Arrow normal;    ///< from the tool to the surface
    Arrow place;     ///< y [m]
    double distance; ///< d [m]
    double gap;      ///< d less what the tool keeps to itself [m]

    bool is_flat; ///< the tool is a plane, and d is linear
    unsigned int n_free = 0;
    std::array<std::array<double, 3>, 2> dc{}; ///< dc_i / dtheta_k
    std::array<Arrow, 2> J{};                  ///< derivatives of d n by theta_k [m]

    double factor = 1.;                     ///< of the barrier
    std::array<Arrow, 3> factor_gradient{}; ///< by the places of the nodes [1/m]

    /** Whether the place on the surface is fixed: a vertex, or a point of a rule. */
    bool
    has_fixed_weights() const;
  };


  /** A matrix on the nodes of a part, up to 9 x 9. */
  using PartMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 9>;


  /**
   * The second derivative of the distance of a pair [1/m],
   *
   *   (c c^T (x) I - B (J^T J)^-1 B^T - d' d'^T)/d,   B_k = c (x) J_k + dc/dtheta_k (x) d n;
   *
   * zero for a plane.
   */
  PartMatrix
  second_derivative(const ContactPair &pair);


  /** The second derivative of the barrier of a pair, without its negative part [1/m]:
   * [b'' d' d'^T + b' d'']_+ */
  PartMatrix
  barrier_tangent(const ContactPair &pair);


  /**
   * All pairs of the surface and the tools whose gap is less than the reach of the barrier: points
   * of a rule of integration against the nearest place of a tool, and guards that no tool, however
   * thin, passes: vertices and edges of the surface, and ends of tools against its triangles.
   * @param u     displacement of all local nodes [m]
   * @param guard part of the area that guards have
   */
  std::vector<ContactPair>
  find_pairs(const ContactSurface &surface,
             const double *u,
             const std::vector<PlacedTool> &tools,
             double guard);


  /** The gap between a part of the surface and a tool [m]; less than zero where they cross.
   * @param x places of the part's nodes */
  double
  gap_of(const SurfacePart &part, const Corners &x, const PlacedTool &tool);
} // namespace Supple

#endif
