#include <supple/identification/layered_model.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>
#include <supple/base/text.h>
#include <supple/input/entries.h>
#include <supple/run/simulation.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Supple
{
  namespace
  {
    /** What an identification changes in its scene: this is linear, a step is enough. */
    Override
    one_step(const IdentificationParameters &identification)
    {
      return {"Time/Steps=1", identification.place("Scene")};
    }
  } // namespace


  LayeredModel::LayeredModel(const IdentificationParameters &identification,
                             const MPI_Comm communicator)
    : base(identification.read_scene({one_step(identification)}))
    , identification(identification)
    , communicator(communicator)
  {
    check_linear();
    check_layers();
    check_profile();
  }


  void
  LayeredModel::check_linear() const
  {
    if (base.time.problem != TimeParameters::Problem::stationary)
      throw InputError(base.origin("Time/Problem") +
                       ": an identification needs a static scene; set Problem = static.");
    if (base.material.law_choice().is_hyperelastic())
      throw InputError(base.origin("Material/Law") +
                       ": an identification needs displacements that are proportional to the depth "
                       "of the needle, and with " +
                       base.material.law + " they are not; set Law = corotational.");
    if (base.corotation.rotation != RotationMethod::none)
      throw InputError(base.origin("Corotation/Rotation") +
                       ": an identification needs displacements that are proportional to the depth "
                       "of the needle; set Rotation = none.");
    const LoadParameters &loads = base.loads;
    if (!Expression(loads.gravity_expressions(), 3, base.origin("Loads/Gravity")).is_zero())
      throw InputError(
        base.origin("Loads/Gravity") +
        ": in an identification the needle alone moves the skin; set it to 0, 0, 0.");
    const std::vector<std::pair<std::string, std::string>> texts = {
      {"Loads/Body force", loads.body_force},
      {"Loads/Nodal force", loads.nodal_force},
      {"Loads/Traction", loads.traction},
      {"Loads/Pressure", loads.pressure}};
    for (const auto &[entry, text] : texts)
      if (!Expression(text, entry == "Loads/Pressure" ? 1 : 3, base.origin(entry)).is_zero())
        throw InputError(base.origin(entry) +
                         ": in an identification the needle alone moves the skin; set it to 0.");
  }


  void
  LayeredModel::check_layers() const
  {
    using Shape = MeshParameters::Shape;
    if (base.mesh.shape != Shape::box && base.mesh.shape != Shape::rectangle)
      throw InputError(base.origin("Mesh/Shape") +
                       ": an identification changes the layers of a box or a rectangle.");
    for (const char *entry : {"Mesh/Refine", "Space/Aim"})
      if (base.changes(entry))
        throw InputError(base.origin(entry) +
                         ": the runs of an identification are compared on one mesh; refine it by "
                         "Mesh/Refine region, or not at all.");
    if (base.material.constants != MaterialParameters::Constants::young_poisson)
      throw InputError(base.origin("Material/Elastic constants") +
                       ": an identification needs Young modulus and Poisson ratio.");
    const std::string here = base.origin("Material/By id");
    const auto exceptions  = base.material.exceptions(here);
    if (exceptions.count(0) > 0)
      throw InputError(here + ": in an identification the upper layer, id 0, has the modulus of " +
                       "Material/Young modulus.");
    for (const double thickness : identification.thicknesses)
      if (thickness * identification.unit_length() >= height())
        throw InputError(identification.place("Thicknesses") + ": the upper layer of " +
                         digits(thickness, 6) + " " + identification.unit_name() +
                         " leaves nothing for the lower one; the body is " + digits(height(), 6) +
                         " m high.");
    if (identification.fit && base.mesh.layer_rows.size() != 2)
      throw InputError(identification.place("Fit") +
                       ": a layer of any thickness needs a mesh that goes with it; set Mesh/Layer "
                       "rows of the scene to two numbers.");
  }


  void
  LayeredModel::check_profile() const
  {
    const auto profiles = named_list(base.probes.profiles, base.origin("Probes/Profiles"));
    std::vector<std::string> names;
    for (const auto &[name, text] : profiles)
      names.push_back(name);
    if (std::find(names.begin(), names.end(), identification.profile) == names.end())
      throw InputError(identification.place("Profile") + ": the scene has no profile '" +
                       identification.profile + "' (Probes/Profiles)" +
                       did_you_mean(identification.profile, names));
  }


  std::pair<std::string, std::string>
  LayeredModel::layers(const LayerPair &pair) const
  {
    const auto materials = base.material.exceptions(base.origin("Material/By id"));
    const auto lower     = materials.find(1);
    const double lower_poisson =
      lower == materials.end() ? base.material.poisson : lower->second.poisson();
    // Messages show this text: 7.5e-07 rather than 7.5000000000000002e-07.
    const auto exact = [](const double value) { return digits(value, 14); };
    return {exact(pair.thickness) + ", " + exact(height() - pair.thickness),
            "1: " + exact(base.material.young / pair.ratio) + ", " + exact(lower_poisson) + ", " +
              exact(base.material.density)};
  }


  Parameters
  LayeredModel::read_scene(const LayerPair &pair) const
  {
    const auto [thicknesses, lower] = layers(pair);
    return identification.read_scene(
      {one_step(identification),
       {"Mesh/Layers=" + thicknesses, identification.place("Thicknesses")},
       {"Material/By id=" + lower, identification.place("Elasticity ratios")}});
  }


  /** Without reading it anew, which takes longer than the solution of a small body. */
  Parameters
  LayeredModel::scene(const LayerPair &pair) const
  {
    Parameters parameters           = base;
    parameters.mesh.material_layers = {pair.thickness, height() - pair.thickness};
    parameters.material.by_id       = layers(pair).second;
    return parameters;
  }


  std::vector<SurfaceResponse::Vertex>
  LayeredModel::line_of(const std::vector<std::vector<double>> &rows) const
  {
    const auto names  = Profiles::column_names();
    const auto column = [&](const std::string &name) {
      return std::find(names.begin(), names.end(), name) - names.begin();
    };
    const auto x = column("x"), z = column("z"), ux = column("ux"), uz = column("uz");
    const auto depth = column("depth");

    const dealii::Point<3> &needle = base.probes.profile_center;
    double extent                  = 0.;
    for (const auto &row : rows)
      extent = std::max(extent, std::abs(row[x] - needle[0]));
    std::vector<SurfaceResponse::Vertex> line;
    for (const auto &row : rows)
      if (std::abs(row[z] - row[uz] - needle[2]) <= 1e-6 * extent)
        line.push_back({row[x] - row[ux] - needle[0], row[ux], row[depth]});
    std::sort(line.begin(), line.end(), [](const auto &a, const auto &b) {
      return a.position < b.position;
    });
    return line;
  }


  void
  LayeredModel::check_center(const std::vector<SurfaceResponse::Vertex> &line) const
  {
    const std::string here = base.origin("Probes/Profile center");
    if (line.size() < 2)
      throw InputError(here +
                       ": the profile has no vertices straight to the left and right of it.");
    const double first = line.front().position, last = line.back().position;
    const double play = 1e-6 * (last - first);
    if (first <= play && last >= -play)
      return;
    const double center = base.probes.profile_center[0];
    std::ostringstream text;
    text << here << ": x = " << center
         << " m is outside the body, whose surface lies between x = " << center + first << " and "
         << center + last << "; the center must be where the needle is.";
    throw InputError(text.str());
  }


  void
  LayeredModel::check_needle(const std::vector<SurfaceResponse::Vertex> &line,
                             const double needle) const
  {
    constexpr double play = 1e-6; // of a solution that is not exact
    const auto deepest =
      std::max_element(line.begin(), line.end(), [](const auto &a, const auto &b) {
        return a.depth < b.depth;
      });
    if (needle > 0. && deepest->depth <= (1. + play) * needle)
      return;
    if (!(deepest->depth > 0.))
      throw InputError(base.origin("Motion/Displacement") +
                       ": under the needle, at Probes/Profile center, the surface does not go "
                       "down; it must.");
    std::ostringstream text;
    text << base.origin("Probes/Profile center") << ": at " << base.probes.profile_center
         << (needle > 0. ? " the surface goes down, but more at x = "
                         : " the surface does not go down; it goes down most at x = ")
         << base.probes.profile_center[0] + deepest->position
         << ". The center must be where the needle is (Motion/Of).";
    throw InputError(text.str());
  }


  SurfaceResponse
  LayeredModel::surface(const LayerPair &pair) const
  {
    Simulation simulation(scene(pair), "", true, communicator);
    simulation.advance();
    auto line = line_of(
      dealii::Utilities::MPI::broadcast(communicator, simulation.profile(identification.profile)));
    check_center(line);
    const auto under = std::min_element(line.begin(), line.end(), [](const auto &a, const auto &b) {
      return std::abs(a.position) < std::abs(b.position);
    });
    const double needle = under->depth;
    check_needle(line, needle);
    for (auto &vertex : line)
      {
        vertex.slide /= needle;
        vertex.depth /= needle;
      }
    return SurfaceResponse(line);
  }


  void
  LayeredModel::check_depths(const std::vector<MeasuredSet> &sets) const
  {
    const double unit = identification.unit_length();
    for (const MeasuredSet &set : sets)
      for (std::size_t i = 0; i < set.depths.size(); ++i)
        if (set.depths[i] >= height())
          {
            std::ostringstream text;
            text << set.places[i] << ": the depth is " << set.depths[i] / unit << " "
                 << identification.unit_name() << ", outside the model, which is "
                 << height() / unit << " " << identification.unit_name() << " high.";
            throw InputError(text.str());
          }
  }


  void
  LayeredModel::check(const LayerPair &pair, const std::vector<MeasuredSet> &sets) const
  {
    check_depths(sets);
    const Simulation simulation(read_scene(pair), "", true, communicator);
    const auto line = line_of(
      dealii::Utilities::MPI::broadcast(communicator, simulation.profile(identification.profile)));
    check_center(line);
    const double unit = identification.unit_length();
    for (const double direction : identification.comparison.directions())
      {
        const double reach = direction < 0. ? -line.front().position : line.back().position;
        if (reach <= 1e-6 * (line.back().position - line.front().position))
          throw InputError(
            identification.place("Side") +
            ": the body ends at the needle; set Side = " + (direction < 0. ? "right." : "left."));
        for (const MeasuredSet &set : sets)
          for (std::size_t i = 0; i < set.distances.size(); ++i)
            if (set.distances[i] > reach * (1. + 1e-9))
              {
                std::ostringstream text;
                text << set.places[i] << ": the distance is " << set.distances[i] / unit << " "
                     << identification.unit_name() << ", outside the model, whose surface ends "
                     << reach / unit << " " << identification.unit_name() << " to the "
                     << (direction < 0. ? "left" : "right")
                     << " of the needle (Identification/Side, Probes/Profile center).";
                throw InputError(text.str());
              }
      }
  }
} // namespace Supple
