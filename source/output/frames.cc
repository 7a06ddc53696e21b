#include <supple/output/frames.h>

#include <supple/base/files.h>
#include <supple/base/text.h>
#include <supple/contact/tool_surface.h>
#include <supple/forces/contact.h>
#include <supple/output/tool_polygons.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using namespace dealii;

  Frames::Frames(const Configuration &configuration,
                 const Forces &forces,
                 const OutputParameters &parameters,
                 const std::string &folder,
                 const CellErrors *const errors,
                 const bool of_all_frames)
    : configuration(configuration)
    , forces(forces)
    , body(configuration.body)
    , parameters(parameters)
    , folder(folder)
    , errors(errors)
    , vtu(*body.mesh.parts)
  {
    body.initialize(last_displacement);
    if (parameters.report)
      film = std::make_unique<Film>(body, folder, forces.contact() != nullptr, of_all_frames);
  }


  std::vector<std::string>
  Frames::files()
  {
    return {"solution.pvd", "solution/frame_*", "tools.pvd", "solution/tools_*", Film::file_name()};
  }


  nlohmann::json
  Frames::save() const
  {
    return {{"records", records},
            {"step", last.step},
            {"time", last.time},
            {"min_volume_ratio", min_volume_ratio},
            {"max_volume_ratio", max_volume_ratio},
            {"inverted", inverted}};
  }


  void
  Frames::load(const nlohmann::json &saved)
  {
    records          = saved.at("records").get<std::vector<std::pair<double, std::string>>>();
    last.step        = saved.at("step");
    last.time        = saved.at("time");
    min_volume_ratio = saved.at("min_volume_ratio");
    max_volume_ratio = saved.at("max_volume_ratio");
    inverted         = saved.at("inverted");
    if (film)
      film->resume(records.size());
  }


  bool
  Frames::has_moved(const Vector &displacement) const
  {
    return largest_vertex_distance(displacement, last_displacement) >
           parameters.motion * body.mesh.diameter();
  }


  bool
  Frames::volume_has_changed(const Measurement &now) const
  {
    return now.max_volume_ratio > max_volume_ratio + parameters.volume_ratio_change ||
           now.min_volume_ratio < min_volume_ratio - parameters.volume_ratio_change ||
           (now.inverted > 0 && !inverted);
  }


  bool
  Frames::due(const Measurement &now) const
  {
    if (records.empty())
      return true;
    const double since_last = now.time - last.time;
    switch (parameters.frames)
      {
        case OutputParameters::Frames::every:
          return now.step % parameters.every == 0;
        case OutputParameters::Frames::interval:
          {
            // The first step that reaches a multiple of the interval.
            const auto passed = [&](const double time) {
              return std::floor(time / parameters.interval * (1. + 1e-12));
            };
            return passed(now.time) > passed(now.time - now.dt);
          }
        case OutputParameters::Frames::adaptive:
          return (parameters.longest_interval > 0. &&
                  since_last >= parameters.longest_interval * (1. - 1e-12)) ||
                 volume_has_changed(now) || has_moved(configuration.displacement());
        default:
          return false;
      }
  }


  bool
  Frames::is_written(const unsigned int step) const
  {
    return !records.empty() && step == last.step;
  }


  const CellFields &
  Frames::fields(const unsigned int step)
  {
    if (!cells || step_of_cells != step)
      cells.emplace(configuration, forces.elastic());
    step_of_cells = step;
    return *cells;
  }


  bool
  Frames::can_hold(const unsigned int step)
  {
    if (is_written(step))
      return true;
    const auto holds = [](const Vector &vector) {
      return std::all_of(vector.begin(), vector.end(), [](const float value) {
        return std::isfinite(value);
      });
    };
    const bool here = fields(step).finite() && holds(configuration.displacement()) &&
                      holds(configuration.velocity());
    return Utilities::MPI::min(here ? 1 : 0, body.mesh.communicator) == 1;
  }


  void
  Frames::write(const Measurement &now)
  {
    if (is_written(now.step))
      return;
    const std::string name = "frame_" + Utilities::int_to_string(n_written(), 4);
    draw_state(now, name);

    const bool first    = records.empty();
    const bool parallel = Utilities::MPI::n_mpi_processes(body.mesh.communicator) > 1;
    records.emplace_back(now.time, "solution/" + name + (parallel ? ".pvtu" : ".vtu"));
    if (Utilities::MPI::this_mpi_process(body.mesh.communicator) == 0)
      {
        std::vector<std::string> files;
        for (const auto &[time, file] : records)
          files.push_back(file);
        write_whole_file(folder + "/solution.pvd", collection(files));
        write_tools();
      }

    min_volume_ratio =
      first ? now.min_volume_ratio : std::min(min_volume_ratio, now.min_volume_ratio);
    max_volume_ratio =
      first ? now.max_volume_ratio : std::max(max_volume_ratio, now.max_volume_ratio);
    inverted          = inverted || now.inverted > 0;
    last              = now;
    last_displacement = configuration.displacement();
  }


  namespace
  {
    std::string
    file_of_tools(const unsigned int number)
    {
      return "solution/tools_" + Utilities::int_to_string(number, 4) + ".vtp";
    }
  } // namespace


  void
  Frames::write_tools() const
  {
    if (!forces.contact() || forces.contact()->all_tools().empty())
      return;
    const std::vector<Tool> &tools = forces.contact()->all_tools();
    std::vector<Pose> poses;
    for (const Tool &tool : tools)
      poses.push_back(tool.pose(records.back().first));
    write_whole_file(folder + "/" + file_of_tools(records.size() - 1),
                     draw_tools(tools, poses, extent_of_planes(body)));
    std::vector<std::string> files;
    for (unsigned int number = 0; number < records.size(); ++number)
      files.push_back(file_of_tools(number));
    write_whole_file(folder + "/tools.pvd", collection(files));
  }


  std::string
  Frames::collection(const std::vector<std::string> &files) const
  {
    std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n"
      "<Collection>\n";
    for (std::size_t k = 0; k < files.size(); ++k)
      text +=
        "<DataSet timestep=\"" + digits(records[k].first, 15) + "\" file=\"" + files[k] + "\"/>\n";
    return text + "</Collection>\n</VTKFile>\n";
  }


  void
  Frames::draw_state(const Measurement &now, const std::string &name)
  {
    const State &state      = configuration.state;
    const bool errors_known = errors && errors->step == now.step && !errors->of_cells.empty();
    Vector pressure;
    if (forces.contact())
      pressure = forces.contact()->pressure(configuration);
    const Drawing drawing{now.time,
                          now.step,
                          state.displacement,
                          state.has_velocity() ? &state.velocity : nullptr,
                          fields(now.step),
                          errors_known ? &errors->of_cells : nullptr,
                          forces.contact() ? &pressure : nullptr};
    write_pieces(drawing, name);
    if (film)
      film->write(drawing);
    cells.reset();
  }


  /** A file for each process, and on several a record that names them all. */
  void
  Frames::write_pieces(const Drawing &drawing, const std::string &name) const
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(body.mesh.communicator);
    const unsigned int rank    = Utilities::MPI::this_mpi_process(body.mesh.communicator);
    std::vector<std::string> pieces;
    for (unsigned int r = 0; r < n_ranks; ++r)
      pieces.push_back(n_ranks == 1 ? name + ".vtu" : name + "." + std::to_string(r) + ".vtu");

    const auto [part, record] = vtu.draw(drawing, pieces);
    write_whole_file(folder + "/solution/" + pieces[rank], part);
    if (n_ranks > 1)
      {
        MPI_Barrier(body.mesh.communicator); // the record names no file that is not there
        if (rank == 0)
          write_whole_file(folder + "/solution/" + name + ".pvtu", record);
      }
  }
} // namespace Supple
