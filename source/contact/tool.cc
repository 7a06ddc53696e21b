#include <supple/contact/tool.h>

#include <supple/base/error.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <limits>

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
  Pose::turned_back(const Arrow &vector) const
  {
    return rotated(vector, -1. * turn);
  }


  Arrow
  Pose::place_with(const Pose &other, const Arrow &point) const
  {
    return other.carried(in_frame(point));
  }


  Pose
  between(const Pose &from, const Pose &to, const double part)
  {
    if (part == 1.)
      return to;
    return {(1. - part) * from.place + part * to.place, (1. - part) * from.turn + part * to.turn};
  }


  namespace
  {
    double
    largest_reach(const ToolParameters &tool)
    {
      switch (tool.shape)
        {
          case Shape::sphere:
          case Shape::capsule:
            return 0.5 * tool.radius;
          case Shape::box:
            return 0.25 * std::min({tool.size[0], tool.size[1], tool.size[2]});
          default:
            return std::numeric_limits<double>::max();
        }
    }


    /** Of a box that a plane body meets only two lengths count: along z it is long. */
    ToolParameters
    in_section(ToolParameters tool, const Section &section)
    {
      if (section.plane())
        tool.size[2] = tool.size[0] + tool.size[1];
      return tool;
    }


    double
    offset_of(const ToolParameters &tool, const double reach)
    {
      switch (tool.shape)
        {
          case Shape::plane:
            return -reach;
          case Shape::sphere:
          case Shape::capsule:
            return tool.radius - reach;
          default:
            return 0.;
        }
    }


    std::shared_ptr<const ToolShape>
    core_of(const ToolParameters &tool, const double reach, const ParameterFile &scene)
    {
      const auto share = [](const ToolShape &shape) {
        return std::make_shared<const ToolShape>(shape);
      };
      switch (tool.shape)
        {
          case Shape::sphere:
            return share(ToolShape::point());
          case Shape::capsule:
            return share(ToolShape::segment(tool.axis));
          case Shape::box:
            return share(ToolShape::box(tool.size - 2. * reach * Arrow({1., 1., 1.})));
          case Shape::file:
            return share(ToolShape::triangles(tool.read(scene), tool.scale));
          default:
            return nullptr;
        }
    }
  } // namespace


  Tool::Tool(const ToolParameters &parameters,
             const Section &section,
             const double wanted_reach,
             const ParameterFile &scene)
    : parameters(in_section(parameters, section))
    , reach(std::min(wanted_reach, largest_reach(this->parameters)))
    , offset(offset_of(this->parameters, reach))
    , position(parameters.position, 3, scene.origin(parameters.section() + "/Position"))
    , rotation(parameters.rotation, 3, scene.origin(parameters.section() + "/Rotation"))
  {
    parameters.check(scene);
    require_motion(scene);
    shape = core_of(this->parameters, reach, scene);
    if (section.plane())
      require_plane_motion(scene);
  }


  void
  Tool::require_motion(const ParameterFile &scene) const
  {
    for (const auto &[expression, entry] :
         {std::make_pair(&position, "/Position"), std::make_pair(&rotation, "/Rotation")})
      {
        const std::string origin = scene.origin(parameters.section() + entry);
        if (expression->depends_on_place())
          throw InputError(origin +
                           ": a tool moves as a whole, as expressions of t say; x, y and z "
                           "mean nothing in them.");
        const Arrow at_first = value_of(*expression, 0.);
        if (!std::isfinite(at_first.norm()))
          throw InputError(origin + ": at t = 0 it is not a finite number.");
      }
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
    if (parameters.shape == Shape::file)
      throw InputError(scene.origin(name + "/Shape") +
                       ": a plane body meets planes, spheres, capsules and boxes, not files.");
    if (parameters.shape == Shape::capsule && parameters.axis[2] != 0.)
      throw InputError(scene.origin(name + "/Axis") + words + "the third component must be 0.");
  }


  Pose
  Tool::pose(const double time) const
  {
    const SharedHandPath &hand = parameters.hand;
    const Pose pose{hand && time >= hand->begin ? hand->at(time) : value_of(position, time),
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
    placed.shape  = shape.get();
    placed.offset = offset;
    placed.reach  = reach;
    placed.pose   = pose;
    if (is_plane())
      {
        placed.points = {pose.place};
        placed.normal = pose.turned(parameters.normal / parameters.normal.norm());
      }
    else
      for (const Arrow &point : shape->points)
        placed.points.push_back(pose.carried(point));
    return placed;
  }


  double
  PlacedTool::gap(const Simplex &simplex, double least) const
  {
    if (is_plane())
      {
        for (unsigned int v = 0; v < simplex.n; ++v)
          least = std::min(least, normal * (simplex.x[v] - points[0]) - offset);
        return least;
      }
    Simplex here = simplex;
    for (unsigned int v = 0; v < simplex.n; ++v)
      here.x[v] = pose.in_frame(simplex.x[v]);
    if (shape->contains(here.x[0]))
      return -offset;
    return std::min(least, shape->distance(here, least + offset) - offset);
  }
} // namespace Supple
