#include <supple/observe/profiles.h>

#include <supple/base/error.h>
#include <supple/base/gather.h>
#include <supple/input/entries.h>
#include <supple/mechanics/selection.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Supple
{
  using namespace dealii;

  Profiles::Profiles(const Body &body,
                     const ProbeParameters &parameters,
                     const ParameterFile &scene)
    : body(body)
    , center(parameters.profile_center)
  {
    const std::string origin = scene.origin("Probes/Profiles");
    for (const auto &[name, text] : named_list(parameters.profiles, origin))
      {
        const auto on_boundary = Selection(body).boundary_nodes(text, origin);
        profiles.push_back({name, {}});
        for (unsigned int node = 0; node < body.n_owned; ++node)
          if (on_boundary[node])
            profiles.back().nodes.push_back(node);
      }
  }


  std::vector<std::string>
  Profiles::names() const
  {
    std::vector<std::string> list;
    for (const Profile &profile : profiles)
      list.push_back(profile.name);
    return list;
  }


  std::vector<std::string>
  Profiles::column_names()
  {
    return {"step", "time", "vertex", "distance", "depth", "x", "y", "z", "ux", "uy", "uz"};
  }


  unsigned int
  Profiles::number(const std::string &name) const
  {
    const auto found = std::find_if(profiles.begin(), profiles.end(), [&](const Profile &profile) {
      return profile.name == name;
    });
    return found - profiles.begin();
  }


  double
  Profiles::distance(const Point<3> &point) const
  {
    return std::hypot(point[0] - center[0], point[2] - center[2]);
  }


  std::vector<std::vector<double>>
  Profiles::rows(const unsigned int profile,
                 const unsigned int step,
                 const double time,
                 const Vector &displacement) const
  {
    // Each row begins with what it is sorted by.
    std::vector<std::array<double, 10>> here;
    for (const unsigned int node : profiles[profile].nodes)
      {
        const Point<3> rest = body.position(node);
        Tensor<1, 3> u;
        for (unsigned int i = 0; i < 3; ++i)
          u[i] = displacement.local_element(3 * node + i);
        const Point<3> x = rest + u;
        here.push_back({{body.mesh.section.plane() ? rest[0] : distance(rest),
                         double(body.serial_vertex[node]),
                         distance(x),
                         -u[1],
                         x[0],
                         x[1],
                         x[2],
                         u[0],
                         u[1],
                         u[2]}});
      }
    std::vector<std::array<double, 10>> all = gathered_on_first(here, body.mesh.communicator);
    std::sort(all.begin(), all.end());
    std::vector<std::vector<double>> rows;
    for (const auto &row : all)
      {
        rows.push_back({double(step), time});
        rows.back().insert(rows.back().end(), row.begin() + 1, row.end());
      }
    return rows;
  }
} // namespace Supple
