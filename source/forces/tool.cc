#include <supple/forces/tool.h>

#include <supple/base/error.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using dealii::cross_product_3d;
  using Shape = ToolParameters::Shape;

  namespace
  {
    /** By Rodrigues' formula. @param turn axis times angle [rad] */
    Arrow
    rotated(const Arrow &vector, const Arrow &turn)
    {
      const double angle = turn.norm();
      if (angle == 0.)
        return vector;
      const Arrow axis = turn / angle;
      return std::cos(angle) * vector + std::sin(angle) * cross_product_3d(axis, vector) +
             (1. - std::cos(angle)) * (axis * vector) * axis;
    }


    Arrow
    value_of(const Expression &expression, const double time)
    {
      Arrow value;
      for (unsigned int i = 0; i < 3; ++i)
        value[i] = expression.value({}, time, i);
      return value;
    }
  } // namespace


  Arrow
  Pose::turned(const Arrow &vector) const
  {
    return rotated(vector, turn);
  }


  Arrow
  Pose::place_with(const Pose &other, const Arrow &point) const
  {
    return other.place + other.turned(rotated(point - place, -1. * turn));
  }


  Pose
  between(const Pose &from, const Pose &to, const double part)
  {
    if (part == 1.)
      return to;
    return {(1. - part) * from.place + part * to.place, (1. - part) * from.turn + part * to.turn};
  }


  Tool::Tool(const ToolParameters &parameters,
             const Section &section,
             const double reach,
             const ParameterFile &scene)
    : parameters(parameters)
    , reach(parameters.shape == Shape::plane ? reach : std::min(reach, 0.5 * parameters.radius))
    , position(parameters.position, 3, scene.origin(parameters.section() + "/Position"))
    , rotation(parameters.rotation, 3, scene.origin(parameters.section() + "/Rotation"))
  {
    parameters.check(scene);
    if (section.plane())
      require_plane_motion(scene);
  }


  void
  Tool::require_plane_motion(const ParameterFile &scene) const
  {
    const std::string words = ": the body lies in the plane z = 0, and the tool must stay in it; ";
    const std::string name  = parameters.section();
    const auto component    = [](const std::string &text, const unsigned int i) {
      const auto all = dealii::Utilities::split_string_list(text, ';');
      return i < all.size() ? all[i] : "0";
    };
    if (!Expression::says_zero(component(parameters.position, 2)))
      throw InputError(scene.origin(name + "/Position") + words + "the third component must be 0.");
    for (unsigned int i = 0; i < 2; ++i)
      if (!Expression::says_zero(component(parameters.rotation, i)))
        throw InputError(scene.origin(name + "/Rotation") + words +
                         "it can turn about z alone: the first two components must be 0.");
    if (parameters.shape == Shape::plane && parameters.normal[2] != 0.)
      throw InputError(scene.origin(name + "/Normal") + words + "the third component must be 0.");
    if (parameters.shape == Shape::capsule && parameters.axis[2] != 0.)
      throw InputError(scene.origin(name + "/Axis") + words + "the third component must be 0.");
  }


  Pose
  Tool::pose(const double time) const
  {
    const Pose pose{value_of(position, time),
                    dealii::numbers::PI / 180. * value_of(rotation, time)};
    if (!std::isfinite(pose.place.norm()) || !std::isfinite(pose.turn.norm()))
      throw ComputationError("the place of the tool " + parameters.name +
                             " is not a finite number at " + std::to_string(time) + " s");
    return pose;
  }


  Pose
  Tool::pose(const Passage &passage) const
  {
    const Pose to = pose(passage.to);
    return passage.part == 1. ? to : between(pose(passage.from), to, passage.part);
  }


  PlacedTool
  Tool::placed(const Pose &pose) const
  {
    PlacedTool placed;
    placed.is_plane = parameters.shape == Shape::plane;
    placed.begin    = pose.place;
    placed.end      = pose.place;
    placed.reach    = reach;
    placed.offset   = -reach;
    if (placed.is_plane)
      placed.normal = pose.turned(parameters.normal / parameters.normal.norm());
    else
      placed.offset = parameters.radius - reach;
    if (parameters.shape == Shape::capsule)
      placed.end += pose.turned(parameters.axis);
    return placed;
  }


  double
  Tool::lever() const
  {
    return parameters.shape == Shape::capsule ? parameters.axis.norm() : 0.;
  }
} // namespace Supple
