#include <supple/study/study_runner.h>

#include <supple/base/error.h>
#include <supple/run/simulation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Supple
{
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


  void
  StudyRunner::check(const Parameters &parameters) const
  {
    Simulation(parameters, "", true, communicator);
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

    const Summary &summary = simulation.summary();
    record.displacement    = simulation.current_state().block(0);
    record.end             = simulation.time();
    record.summary         = summary.numbers();
    record.warnings        = summary.warnings;
    record.n_cells         = summary.size.cells;
    record.cell_size       = summary.size.cell_size;
    record.steps           = summary.steps;
    record.rejected        = summary.effort.rejected_steps;
    record.failed          = summary.effort.failed_steps;
    record.seconds         = dealii::Utilities::MPI::max(summary.run_seconds, communicator);
    if (summary.has_mass)
      record.largest_motion = summary.largest_motion;
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
        seconds.push_back(
          dealii::Utilities::MPI::max(simulation.summary().run_seconds, communicator));
      }
    std::sort(seconds.begin(), seconds.end());
    const std::size_t middle = seconds.size() / 2;
    return seconds.size() % 2 == 1 ? seconds[middle]
                                   : 0.5 * (seconds[middle - 1] + seconds[middle]);
  }
} // namespace Supple
