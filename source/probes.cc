#include <supple/probes.h>

#include <supple/error.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <cmath>
#include <sstream>

namespace Supple
{
  using namespace dealii;

  Probes::Probes(const Body &body, const Parameters &parameters)
    : body(body)
  {
    const ProbeParameters &wanted = parameters.probes;

    const std::string points = parameters.origin("Probes/Points");
    for (const auto &[name, text] : named_list(wanted.points, points))
      add_point(name, text, points);

    const std::string boundaries = parameters.origin("Probes/Boundaries");
    for (const auto &[name, text] : named_list(wanted.boundaries, boundaries))
      add_nodes(name,
                "boundary " + text,
                body.boundary_nodes(boundary_id(text, boundaries), boundaries));

    const std::string regions = parameters.origin("Probes/Regions");
    for (const auto &[name, text] : named_list(wanted.regions, regions))
      add_nodes(name, "region " + text, body.region_nodes(text, regions));

    for (const Probe &probe : probes)
      for (const Probe &other : probes)
        if (&probe != &other && probe.name == other.name)
          throw InputError("Probes: the name '" + probe.name + "' is given twice.");
  }


  void
  Probes::add_point(const std::string &name, const std::string &text, const std::string &origin)
  {
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
                         "' is no point; three numbers set apart by commas are.");
      }

    const auto [vertex, distance] = body.nearest_vertex(point);

    Probe probe;
    probe.name    = name;
    probe.n_nodes = 1;
    std::vector<double> here(3), position(3);
    for (unsigned int node = 0; node < body.n_owned; ++node)
      if (body.serial_vertex[node] == vertex)
        {
          probe.nodes.push_back(node);
          std::copy(body.positions[node].begin(), body.positions[node].end(), here.begin());
        }
    Utilities::MPI::sum(here, body.mesh.communicator, position);

    std::ostringstream description;
    description << "vertex " << vertex << " at (" << position[0] << ", " << position[1] << ", "
                << position[2] << "), " << distance << " m from the point asked for";
    probe.description = description.str();
    probes.push_back(probe);
  }


  void
  Probes::add_nodes(const std::string &name,
                    const std::string &what,
                    const std::vector<bool> &nodes)
  {
    Probe probe;
    probe.name = name;
    for (unsigned int node = 0; node < body.n_owned; ++node)
      if (nodes[node])
        probe.nodes.push_back(node);
    probe.n_nodes     = Utilities::MPI::sum(probe.nodes.size(), body.mesh.communicator);
    probe.description = what + ", " + std::to_string(probe.n_nodes) + " vertices";
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
    const bool moving = state.n_blocks() > 1;
    for (std::size_t p = 0; p < probes.size(); ++p)
      for (const unsigned int node : probes[p].nodes)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int dof = 3 * node + i;
            local[9 * p + i] += state.block(0).local_element(dof) / probes[p].n_nodes;
            if (moving)
              local[9 * p + 3 + i] += state.block(1).local_element(dof) / probes[p].n_nodes;
            local[9 * p + 6 + i] += reactions.local_element(dof);
          }
    std::vector<double> values(local.size());
    Utilities::MPI::sum(local, body.mesh.communicator, values);
    return values;
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
