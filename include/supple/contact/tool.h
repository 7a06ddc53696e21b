#ifndef supple_tool_h
#define supple_tool_h

#include <supple/base/expression.h>
#include <supple/contact/contact_parameters.h>
#include <supple/contact/tool_shape.h>
#include <supple/mechanics/configuration.h>
#include <supple/mesh/section.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <limits>
#include <memory>
#include <vector>

namespace Supple
{
  /** Where a rigid body is: its reference point, and how far it is turned about that. */
  struct Pose
  {
    Arrow place; ///< [m]
    Arrow turn;  ///< axis times angle [rad]

    /** A vector that the body carries. */
    Arrow
    turned(const Arrow &vector) const;

    /** The same the other way round. */
    Arrow
    turned_back(const Arrow &vector) const;

    /** Where a point is that the body carries, given in its frame. */
    Arrow
    carried(const Arrow &point) const
    {
      return place + turned(point);
    }

    /** A point in the frame of the body. */
    Arrow
    in_frame(const Arrow &point) const
    {
      return turned_back(point - place);
    }

    /** Where the point of the body that is here with this pose was with another one. */
    Arrow
    place_with(const Pose &other, const Arrow &point) const;
  };


  /** The pose at a part of the way between two. Along it a point of the body at a distance r from
   * the reference point moves by no more than |change of place| + r |change of turn|. */
  Pose
  between(const Pose &from, const Pose &to, double part);


  /** A tool in its place: a half-space, or all points that are no farther from its core than a
   * distance. */
  struct PlacedTool
  {
    const ToolShape *shape;    ///< null for a plane
    std::vector<Arrow> points; ///< of the core, or one of the plane [m]
    Arrow normal;              ///< of the plane, toward the body, of length 1

    /** Distance from the core, or height above the plane, from where on the barrier acts no more is
     * @p offset and its reach [m]. */
    double offset;
    double reach; ///< of the barrier [m]
    Pose pose;

    bool
    is_plane() const
    {
      return !shape;
    }

    /** Between a part of the surface and the whole tool; less than zero within a plane, and minus
     * the offset where another core is crossed or contains it [m].
     * @param least what is of no interest beyond */
    double
    gap(const Simplex &simplex, double least = std::numeric_limits<double>::max()) const;
  };


  /**
   * A rigid tool that moves and turns as prescribed.
   *
   * What the barrier keeps out, its core, is as much smaller than the tool as the barrier reaches:
   * so it begins to act where body and tool meet. The core of a tool from a file is its surface.
   */
  class Tool
  {
  public:
    /**
     * @param section of the body: a tool stays in the plane of a plane body
     * @param reach   of the barrier, but no more than half the radius or a quarter of a box [m]
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

    bool
    is_plane() const
    {
      return parameters.shape == ToolParameters::Shape::plane;
    }

    const ToolParameters parameters;
    const double reach;  ///< [m]
    const double offset; ///< as that of PlacedTool [m]

    /** Of its core; null for a plane. */
    std::shared_ptr<const ToolShape> shape;

  private:
    /** @throws InputError for a motion that depends on a place, or that does not begin anywhere */
    void
    require_motion(const ParameterFile &scene) const;

    /** @throws InputError */
    void
    require_plane_motion(const ParameterFile &scene) const;

    Expression position, rotation;
  };
} // namespace Supple

#endif
