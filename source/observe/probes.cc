#include <supple/observe/probes.h>

#include <supple/base/error.h>
#include <supple/input/entries.h>
#include <supple/mechanics/selection.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <sstream>

namespace Supple
{
  using namespace dealii;

  Probes::Probes(const Body &body,
                 const ProbeParameters &parameters,
                 const Motions &motions,
                 const ParameterFile &scene)
    : body(body)
    , chosen(parameters.chosen)
  {
    for (unsigned int m = 0; m < motions.size(); ++m)
      if (!motions[m].of.empty())
        add_motion(motions[m].of, m, scene);

    const std::string points = scene.origin("Probes/Points");
    for (const auto &[name, text] : named_list(parameters.points, points))
      add_point(name, text, points);

    const std::string boundaries = scene.origin("Probes/Boundaries");
    for (const auto &[name, text] : named_list(parameters.boundaries, boundaries))
      add_nodes(name, "boundary " + text, Selection(body).boundary_nodes(text, boundaries));

    const std::string regions = scene.origin("Probes/Regions");
    for (const auto &[name, text] : named_list(parameters.regions, regions))
      add_nodes(name, "region " + text, Selection(body).region_nodes(text, regions));

    for (const Probe &probe : probes)
      for (const Probe &other : probes)
        if (&probe != &other && probe.name == other.name)
          throw InputError("Probes: the name '" + probe.name +
                           "' is given twice. (What is moved has the names motion, motion2 ...)");
  }


  void
  Probes::add_motion(const std::string &of, const unsigned int motion, const ParameterFile &scene)
  {
    const std::string origin = scene.origin(motion_section(motion) + "/Of");
    const std::string name   = "motion" + (motion == 0 ? "" : std::to_string(motion + 1));
    const std::string text   = Utilities::trim(of);
    const std::string point  = after_word(text, point_word);
    const auto nodes         = Selection(body).selected_nodes(text, origin);
    if (!point.empty() || !after_word(text, vertex_word).empty())
      add_point(name, point.empty() ? text : point, origin);
    else
      add_nodes(name, text, nodes);
  }


  /** The index of a vertex is the same on a finer mesh, that of the middle of an edge is not. */
  void
  Probes::add_vertex(const std::string &name, const std::string &text, const std::string &origin)
  {
    const Selection selection(body);
    const auto before   = chosen.find(name);
    std::string of_mesh = text;
    if (before != chosen.end())
      of_mesh = vertex_word + std::to_string(selection.nearest_vertex(before->second).first);
    const std::vector<bool> nodes = selection.selected_nodes(of_mesh, origin);
    const unsigned int vertex     = Utilities::string_to_int(after_word(of_mesh, vertex_word));
    if (body.is_middle(vertex))
      chosen[name] = selection.place_of_vertex(vertex);
    add(name, nodes, selection.vertex_in_words(vertex));
  }


  void
  Probes::add_point(const std::string &name, const std::string &text, const std::string &origin)
  {
    if (!after_word(text, vertex_word).empty())
      return add_vertex(name, text, origin);
    Point<3> point;
    try
      {
        const auto numbers = Utilities::string_to_double(Utilities::split_string_list(text, ','));
        AssertThrow(numbers.size() == 3 && std::isfinite(numbers[0] + numbers[1] + numbers[2]),
                    ExcInternalError());
        point = Point<3>(numbers[0], numbers[1], numbers[2]);
      }
    catch (const std::exception &)
      {
        throw InputError(origin + ": '" + text +
                         "' is no point. A point is three numbers set apart by commas, or vertex "
                         "INDEX.");
      }

    constexpr double margin = 0.01; // of the box's sides
    const Selection selection(body);
    const unsigned int vertex =
      selection.nearest_vertex(chosen.count(name) > 0 ? chosen.at(name) : point).first;
    chosen[name]          = selection.place_of_vertex(vertex);
    const double distance = chosen.at(name).distance(point);
    std::vector<bool> nodes(body.n_local);
    for (unsigned int node = 0; node < body.n_local; ++node)
      nodes[node] = body.serial_vertex[node] == vertex;
    std::ostringstream description;
    description << selection.vertex_in_words(vertex) << ", " << distance
                << " m from the point asked for";
    add(name, nodes, description.str());
    if (!body.mesh.bounding_box.point_inside(point, margin))
      points_outside.push_back("Probe " + name + " follows " + description.str() +
                               ", which is outside of the body.");
  }


  void
  Probes::add_nodes(const std::string &name,
                    const std::string &what,
                    const std::vector<bool> &nodes)
  {
    add(name, nodes, what);
    probes.back().description += ", " + std::to_string(probes.back().n_nodes) + " vertices";
  }


  void
  Probes::add(const std::string &name,
              const std::vector<bool> &nodes,
              const std::string &description)
  {
    Probe probe;
    probe.name        = name;
    probe.description = description;
    for (unsigned int node = 0; node < body.n_owned; ++node)
      if (nodes[node])
        probe.nodes.push_back(node);
    probe.n_nodes = Utilities::MPI::sum(probe.nodes.size(), body.mesh.communicator);
    probes.push_back(probe);
  }


  std::vector<std::string>
  Probes::column_names() const
  {
    std::vector<std::string> names = {"step", "time"};
    for (const Probe &probe : probes)
      for (const char quantity : {'u', 'v', 'f'})
        for (const char direction : {'x', 'y', 'z'})
          names.push_back(probe.name + "." + quantity + direction);
    return names;
  }


  std::vector<double>
  Probes::values(const State &state, const Vector &reactions) const
  {
    std::vector<double> local(9 * probes.size());
    const bool moving = state.has_velocity();
    for (std::size_t p = 0; p < probes.size(); ++p)
      for (const unsigned int node : probes[p].nodes)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int dof = 3 * node + i;
            local[9 * p + i] += state.displacement.local_element(dof) / probes[p].n_nodes;
            if (moving)
              local[9 * p + 3 + i] += state.velocity.local_element(dof) / probes[p].n_nodes;
            local[9 * p + 6 + i] += reactions.local_element(dof);
          }
    std::vector<double> values(local.size());
    Utilities::MPI::sum(local, body.mesh.communicator, values);
    return values;
  }


  std::vector<Probes::Component>
  Probes::displacement_components() const
  {
    std::vector<Component> components;
    for (const Probe &probe : probes)
      for (unsigned int i = 0; i < 3; ++i)
        {
          components.push_back({probe.name + ".u" + "xyz" [i], {}, 1. / probe.n_nodes});
          for (const unsigned int node : probe.nodes)
            components.back().dofs.push_back(3 * node + i);
        }
    return components;
  }


  std::vector<std::string>
  Probes::descriptions() const
  {
    std::vector<std::string> lines;
    for (const Probe &probe : probes)
      lines.push_back(probe.name + ": " + probe.description);
    return lines;
  }
} // namespace Supple
