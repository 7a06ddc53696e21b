#ifndef supple_tool_h
#define supple_tool_h

#include <supple/base/expression.h>
#include <supple/forces/contact_parameters.h>
#include <supple/mechanics/configuration.h>
#include <supple/mesh/section.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace Supple
{
  /** A direction or a distance between points [m]. */
  using Arrow = dealii::Tensor<1, 3>;


  /** Where a rigid body is: its reference point, and how far it is turned about that. */
  struct Pose
  {
    Arrow place; ///< [m]
    Arrow turn;  ///< axis times angle [rad]

    /** A vector that the body carries. */
    Arrow
    turned(const Arrow &vector) const;

    /** Where the point of the body that is here with this pose was with another one. */
    Arrow
    place_with(const Pose &other, const Arrow &point) const;
  };


  /** The pose at a part of the way between two. Along it a point of the body at a distance r from
   * the reference point moves by no more than |change of place| + r |change of turn|. */
  Pose
  between(const Pose &from, const Pose &to, double part);


  /** A tool in its place: a half-space, or all points that are no farther from a segment than a
   * radius. A sphere has a segment of no length. */
  struct PlacedTool
  {
    bool is_plane;
    Arrow begin;  ///< of the segment, or a point of the plane [m]
    Arrow end;    ///< of the segment [m]
    Arrow normal; ///< of the plane, toward the body, of length 1

    /** Distance from the segment, or height above the plane, from where on the barrier acts no
     * more is @p offset and its reach [m]. */
    double offset;
    double reach; ///< of the barrier [m]
  };


  /**
   * A rigid tool that moves and turns as prescribed.
   *
   * What the barrier keeps out, its core, is as much smaller than the tool as the barrier reaches:
   * so it begins to act where body and tool meet.
   */
  class Tool
  {
  public:
    /**
     * @param section of the body: a tool stays in the plane of a plane body
     * @param reach   of the barrier, but no more than half the radius [m]
     * @throws InputError for a tool of no size or one that leaves the plane of the body
     */
    Tool(const ToolParameters &parameters,
         const Section &section,
         double reach,
         const ParameterFile &scene);

    /** At a time [s]. @throws ComputationError if it is not finite */
    Pose
    pose(double time) const;

    /** Where a step has taken it. */
    Pose
    pose(const Passage &passage) const;

    PlacedTool
    placed(const Pose &pose) const;

    /** How far its core reaches from the reference point [m]; 0 for a plane. */
    double
    lever() const;

    const ToolParameters parameters;
    const double reach; ///< [m]

  private:
    /** @throws InputError */
    void
    require_plane_motion(const ParameterFile &scene) const;

    Expression position, rotation;
  };
} // namespace Supple

#endif
