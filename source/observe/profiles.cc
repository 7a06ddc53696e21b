#include <supple/observe/profiles.h>

#include <supple/base/error.h>
#include <supple/input/entries.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using namespace dealii;

  Profiles::Profiles(const Body &body,
                     const ProbeParameters &parameters,
                     const ParameterFile &scene)
    : body(body)
    , center(parameters.profile_center)
    , every(parameters.profile_every)
  {
    const std::string origin = scene.origin("Probes/Profiles");
    for (const auto &[name, text] : named_list(parameters.profiles, origin))
      {
        const auto on_boundary = body.boundary_nodes(boundary_id(text, origin), origin);
        profiles.push_back({name, {}, 0, nullptr});
        for (unsigned int node = 0; node < body.n_owned; ++node)
          if (on_boundary[node])
            profiles.back().nodes.push_back(node);
      }
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
    std::vector<std::vector<double>> here, sorted;
    for (const unsigned int node : profiles[profile].nodes)
      {
        const Point<3> rest = body.position(node);
        Tensor<1, 3> u;
        for (unsigned int i = 0; i < 3; ++i)
          u[i] = displacement.local_element(3 * node + i);
        const Point<3> x = rest + u;
        here.push_back({body.mesh.section.plane() ? rest[0] : distance(rest),
                        double(body.serial_vertex[node]),
                        distance(x),
                        -u[1],
                        x[0],
                        x[1],
                        x[2],
                        u[0],
                        u[1],
                        u[2]});
      }
    for (const auto &part : Utilities::MPI::gather(body.mesh.communicator, here))
      sorted.insert(sorted.end(), part.begin(), part.end());
    std::sort(sorted.begin(), sorted.end());
    for (auto &row : sorted)
      {
        row[0] = time;
        row.insert(row.begin(), step);
      }
    return sorted;
  }


  void
  Profiles::open(const std::string &folder, const bool resumed)
  {
    for (Profile &profile : profiles)
      {
        const std::string file = folder + "/profile_" + profile.name + ".csv";
        profile.file           = resumed ? std::make_unique<CsvFile>(file, profile.n_rows)
                                         : std::make_unique<CsvFile>(file, column_names());
      }
  }


  nlohmann::json
  Profiles::save() const
  {
    std::vector<unsigned long> n_rows;
    for (const Profile &profile : profiles)
      n_rows.push_back(profile.n_rows);
    return {{"rows", n_rows}, {"written", written}, {"step", last_written_step}};
  }


  void
  Profiles::load(const nlohmann::json &saved)
  {
    for (unsigned int p = 0; p < profiles.size(); ++p)
      profiles[p].n_rows = saved.at("rows").at(p);
    written           = saved.at("written");
    last_written_step = saved.at("step");
  }


  void
  Profiles::write(const unsigned int step,
                  const double time,
                  const Vector &displacement,
                  const bool always)
  {
    if ((written && step == last_written_step) || !(always || step % every == 0))
      return;
    for (unsigned int p = 0; p < profiles.size(); ++p)
      {
        const auto all = rows(p, step, time, displacement);
        profiles[p].n_rows += all.size();
        if (profiles[p].file)
          profiles[p].file->write_rows(all);
      }
    written           = true;
    last_written_step = step;
  }
} // namespace Supple
