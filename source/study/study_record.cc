#include <supple/study/study_record.h>

#include <supple/base/error.h>
#include <supple/input/entries.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Supple
{
  namespace
  {
    bool
    ends_with(const std::string &text, const std::string &end)
    {
      return text.size() >= end.size() &&
             text.compare(text.size() - end.size(), end.size(), end) == 0;
    }


    /** What is not finite stands as null in the summary. */
    double
    number(const nlohmann::json &json)
    {
      return json.is_number() ? json.get<double>() : std::numeric_limits<double>::quiet_NaN();
    }


    double
    run_seconds(const nlohmann::json &summary, const MPI_Comm communicator)
    {
      return dealii::Utilities::MPI::max(number(summary["seconds"]["run"]), communicator);
    }
  } // namespace


  std::string
  rate_column(const std::string &name)
  {
    for (const char direction : {'x', 'y', 'z'})
      if (ends_with(name, std::string(".u") + direction))
        return name.substr(0, name.size() - 2) + "v" + direction;
    return "";
  }


  std::set<std::string>
  StudyRecord::column_names(const Parameters &parameters)
  {
    const auto names = Measurement::column_names();
    std::set<std::string> all(names.begin(), names.end());
    const ProbeParameters &probes = parameters.probes;
    for (const auto &[entry, list] : {std::make_pair("Probes/Points", probes.points),
                                      std::make_pair("Probes/Boundaries", probes.boundaries),
                                      std::make_pair("Probes/Regions", probes.regions)})
      for (const auto &[name, text] : named_list(list, parameters.origin(entry)))
        for (const char quantity : {'u', 'v', 'f'})
          for (const char direction : {'x', 'y', 'z'})
            all.insert(name + "." + quantity + direction);
    return all;
  }


  bool
  StudyRecord::has(const double time) const
  {
    const std::vector<double> &times = column("time");
    return times.size() > 1 && time >= times.front() && time <= times.back() * (1. + 1e-12);
  }


  double
  StudyRecord::value(const std::string &name, const double time) const
  {
    const std::vector<double> &times = column("time"), &values = column(name);
    const auto after       = std::upper_bound(times.begin(), times.end(), time);
    const std::size_t next = std::clamp<std::size_t>(after - times.begin(), 1, times.size() - 1);
    const std::size_t last = next - 1;
    const double length    = times[next] - times[last];
    const double s         = std::clamp((time - times[last]) / length, 0., 1.);

    const auto rates = columns.find(rate_column(name));
    if (rates == columns.end())
      return (1. - s) * values[last] + s * values[next];
    const double r = 1. - s;
    return r * r * ((1. + 2. * s) * values[last] + s * length * rates->second[last]) +
           s * s * ((1. + 2. * r) * values[next] - r * length * rates->second[next]);
  }


  StudyRunner::StudyRunner(const std::set<std::string> &columns, const MPI_Comm communicator)
    : wanted([&] {
      std::set<std::string> all = columns;
      for (const std::string &name : columns)
        all.insert(rate_column(name));
      all.insert("time");
      all.erase("");
      return all;
    }())
    , communicator(communicator)
  {
  }


  StudyRecord
  StudyRunner::record(const Parameters &parameters, const std::string &folder) const
  {
    Simulation simulation(parameters, folder, true, communicator);
    StudyRecord record;

    // Where each wanted column stands: in the history, or behind it in the row of the probes.
    std::vector<std::string> names = Measurement::column_names();
    const std::size_t n_history    = names.size();
    for (const std::string &name : simulation.probe_columns())
      names.push_back(name);
    std::vector<std::pair<std::size_t, std::vector<double> *>> kept;
    for (std::size_t c = 0; c < names.size(); ++c)
      if (wanted.count(names[c]) > 0 && record.columns.count(names[c]) == 0)
        kept.emplace_back(c, &record.columns[names[c]]);

    try
      {
        simulation.run([&](const Simulation::Observation &now) {
          const std::vector<double> row = now.measurement.row();
          for (const auto &[c, column] : kept)
            column->push_back(c < n_history ? row[c] : now.probes[c - n_history]);
        });
      }
    catch (const InterruptedError &)
      {
        throw;
      }
    catch (const ComputationError &error)
      {
        record.status = StudyRecord::Status::failed;
        record.reason = error.what();
      }

    record.displacement = simulation.current_state().block(0);
    record.summary      = simulation.summary();
    record.end          = simulation.time();
    const auto summary  = nlohmann::json::parse(record.summary);
    record.n_cells      = summary["cells"];
    record.cell_size    = summary["cell_size"];
    record.warnings     = summary["warnings"].get<std::vector<std::string>>();
    record.steps        = summary["steps"];
    record.rejected     = summary["rejected_steps"];
    record.failed       = summary["failed_steps"];
    if (summary.contains("error_estimate"))
      record.largest_motion = number(summary["error_estimate"]["largest_motion"]);
    record.seconds = run_seconds(summary, communicator);
    return record;
  }


  double
  StudyRunner::time(const Parameters &parameters, const unsigned int repeats) const
  {
    std::vector<double> seconds;
    for (unsigned int i = 0; i < repeats; ++i)
      {
        Simulation simulation(parameters, "", true, communicator);
        simulation.run();
        const auto summary = nlohmann::json::parse(simulation.summary());
        seconds.push_back(run_seconds(summary, communicator));
      }
    std::sort(seconds.begin(), seconds.end());
    const std::size_t middle = seconds.size() / 2;
    return seconds.size() % 2 == 1 ? seconds[middle]
                                   : 0.5 * (seconds[middle - 1] + seconds[middle]);
  }
} // namespace Supple
