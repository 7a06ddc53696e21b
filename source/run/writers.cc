#include <supple/run/writers.h>

#include <supple/base/files.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace Supple
{
  StateTable::StateTable(const std::string &folder,
                         Effort &effort,
                         const std::string &name,
                         const std::vector<std::string> &columns)
    : Writer(folder, effort)
    , file(folder + "/" + name)
    , columns(columns)
  {
  }


  void
  StateTable::open(const bool resumed, const unsigned int step)
  {
    table = resumed ? std::make_unique<CsvFile>(file, step + 1ul)
                    : std::make_unique<CsvFile>(file, columns);
  }


  bool
  StateTable::after_step(const Observation &now)
  {
    const PhaseTimer timer(effort, Phase::output);
    if (table)
      table->write_row(row(now));
    return true;
  }


  namespace
  {
    std::vector<std::string>
    history_columns(const bool with_contact, const bool with_space_error)
    {
      std::vector<std::string> names = Measurement::column_names(with_contact);
      if (with_space_error)
        names.push_back("space_error");
      return names;
    }
  } // namespace


  HistoryTable::HistoryTable(const std::string &folder,
                             Effort &effort,
                             const bool with_contact,
                             const SpaceEstimate *const space)
    : StateTable(folder, effort, files()[0], history_columns(with_contact, space != nullptr))
    , space(space)
  {
  }


  std::vector<std::string>
  HistoryTable::files()
  {
    return {"history.csv"};
  }


  std::vector<double>
  HistoryTable::row(const Observation &now) const
  {
    std::vector<double> row = now.measurement.row();
    if (space)
      row.push_back(space->of_work_after(now.measurement.step));
    return row;
  }


  ToolTables::ToolTables(const std::string &folder,
                         Effort &effort,
                         const std::vector<ToolParameters> &tools)
    : Writer(folder, effort)
    , tools(tools)
  {
  }


  std::vector<std::string>
  ToolTables::files()
  {
    return {"tool_*.csv"};
  }


  std::vector<std::string>
  ToolTables::columns()
  {
    return {"step",
            "time",
            "x",
            "y",
            "z",
            "fx",
            "fy",
            "fz",
            "tx",
            "ty",
            "tz",
            "work",
            "depth",
            "min_gap",
            "area"};
  }


  std::vector<double>
  ToolTables::row(const Measurement &now, const ToolReport &tool)
  {
    std::vector<double> row = {double(now.step), now.time};
    for (const auto *vector : {&tool.place, &tool.force, &tool.torque})
      for (unsigned int i = 0; i < 3; ++i)
        row.push_back((*vector)[i]);
    row.insert(row.end(), {tool.work, tool.depth, tool.gap, tool.area});
    return row;
  }


  void
  ToolTables::open(const bool resumed, const unsigned int step)
  {
    for (const ToolParameters &tool : tools)
      {
        const std::string file = folder + "/tool_" + tool.name + ".csv";
        tables.push_back(resumed ? std::make_unique<CsvFile>(file, step + 1ul)
                                 : std::make_unique<CsvFile>(file, columns()));
      }
  }


  bool
  ToolTables::after_step(const Observation &now)
  {
    const PhaseTimer timer(effort, Phase::output);
    for (std::size_t t = 0; t < tables.size(); ++t)
      tables[t]->write_row(row(now.measurement, now.measurement.contact->tools[t]));
    return true;
  }


  ProbeTable::ProbeTable(const std::string &folder, Effort &effort, const Probes &probes)
    : StateTable(folder, effort, files()[0], probes.column_names())
  {
  }


  std::vector<std::string>
  ProbeTable::files()
  {
    return {"probes.csv"};
  }


  std::vector<double>
  ProbeTable::row(const Observation &now) const
  {
    return now.probes;
  }


  ProfileTables::ProfileTables(const std::string &folder,
                               Effort &effort,
                               const Profiles &profiles,
                               const unsigned int every)
    : Writer(folder, effort)
    , profiles(profiles)
    , every(every)
    , tables(profiles.names().size())
  {
  }


  std::vector<std::string>
  ProfileTables::files()
  {
    return {"profile_*.csv"};
  }


  void
  ProfileTables::open(const bool resumed, const unsigned int /* step */)
  {
    const std::vector<std::string> names = profiles.names();
    for (unsigned int p = 0; p < tables.size(); ++p)
      {
        const std::string file = folder + "/profile_" + names[p] + ".csv";
        tables[p].file         = resumed ? std::make_unique<CsvFile>(file, tables[p].n_rows)
                                         : std::make_unique<CsvFile>(file, Profiles::column_names());
      }
  }


  bool
  ProfileTables::after_step(const Observation &now)
  {
    if (now.measurement.step % every == 0)
      write(now);
    return true;
  }


  void
  ProfileTables::end(const Observation &now)
  {
    write(now);
  }


  void
  ProfileTables::write(const Observation &now)
  {
    const unsigned int step = now.measurement.step;
    if (written && step == last_written_step)
      return;
    const PhaseTimer timer(effort, Phase::output);
    for (unsigned int p = 0; p < tables.size(); ++p)
      {
        const auto rows = profiles.rows(p, step, now.measurement.time, now.state.displacement);
        tables[p].n_rows += rows.size();
        if (tables[p].file)
          tables[p].file->write_rows(rows);
      }
    written           = true;
    last_written_step = step;
  }


  std::string
  ProfileTables::name() const
  {
    return "profiles";
  }


  nlohmann::json
  ProfileTables::save() const
  {
    std::vector<unsigned long> n_rows;
    for (const Table &table : tables)
      n_rows.push_back(table.n_rows);
    return {{"rows", n_rows}, {"written", written}, {"step", last_written_step}};
  }


  void
  ProfileTables::load(const nlohmann::json &saved)
  {
    for (unsigned int p = 0; p < tables.size(); ++p)
      tables[p].n_rows = saved.at("rows").at(p);
    written           = saved.at("written");
    last_written_step = saved.at("step");
  }


  FrameWriter::FrameWriter(const std::string &folder,
                           Effort &effort,
                           const Configuration &configuration,
                           const Forces &forces,
                           const OutputParameters &parameters,
                           const CellErrors *const errors,
                           const bool of_all_frames)
    : Writer(folder, effort)
    , frames(configuration, forces, parameters, folder, errors, of_all_frames)
  {
  }


  std::vector<std::string>
  FrameWriter::files()
  {
    return Frames::files();
  }


  void
  FrameWriter::open(const bool resumed, const unsigned int /* step */)
  {
    std::filesystem::create_directories(folder + "/solution");
    if (resumed && frames.n_written() == 0) // of a run before those that this one goes on from
      remove_files(folder, files());
  }


  std::string
  FrameWriter::objection(const Observation &now)
  {
    if ((frames.due(now.measurement) || now.last) && !frames.can_hold(now.measurement.step))
      return "the motion or its stress is larger than a frame can hold (3.4e38)";
    return "";
  }


  void
  FrameWriter::begin(const Observation &now, const bool resumed)
  {
    if (!resumed || frames.n_written() == 0)
      end(now);
  }


  bool
  FrameWriter::after_step(const Observation &now)
  {
    const PhaseTimer timer(effort, Phase::output);
    if (frames.due(now.measurement))
      frames.write(now.measurement);
    return true;
  }


  void
  FrameWriter::end(const Observation &now)
  {
    const PhaseTimer timer(effort, Phase::output);
    if (frames.can_hold(now.measurement.step))
      frames.write(now.measurement);
  }


  std::string
  FrameWriter::name() const
  {
    return "frames";
  }


  nlohmann::json
  FrameWriter::save() const
  {
    return frames.save();
  }


  void
  FrameWriter::load(const nlohmann::json &saved)
  {
    frames.load(saved);
  }


  Vector *
  FrameWriter::kept_vector()
  {
    return &frames.displacement_of_last();
  }


  ErrorTable::ErrorTable(const std::string &folder,
                         Effort &effort,
                         const StepDoubling *const second_run,
                         const SecondMesh *const second_mesh)
    : Writer(folder, effort)
    , second_run(second_run)
    , second_mesh(second_mesh)
  {
  }


  std::vector<std::string>
  ErrorTable::files()
  {
    return {"error.csv"};
  }


  void
  ErrorTable::open(const bool resumed, const unsigned int step)
  {
    std::vector<std::string> columns = {"step", "time"};
    if (second_run)
      columns.push_back("error");
    if (second_mesh)
      columns.push_back("distance_of_meshes");
    const std::string file = folder + "/" + files()[0];
    table                  = resumed ? std::make_unique<CsvFile>(file, columns, step)
                                     : std::make_unique<CsvFile>(file, columns);
  }


  void
  ErrorTable::begin(const Observation & /* now */, const bool /* resumed */)
  {
  }


  bool
  ErrorTable::after_step(const Observation &now)
  {
    const double unknown    = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> row = {double(now.measurement.step), now.measurement.time};
    if (second_run)
      row.push_back(second_run->error().value_or(unknown));
    if (second_mesh)
      row.push_back(second_mesh->distance().value_or(unknown));
    const bool known = std::any_of(row.begin() + 2, row.end(), [](const double number) {
      return std::isfinite(number);
    });
    if (known && table)
      table->write_row(row);
    return true;
  }
} // namespace Supple
