#include <supple/study/study_runner.h>

#include <supple/base/error.h>
#include <supple/base/stopwatch.h>
#include <supple/run/adaptation.h>
#include <supple/run/simulation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace Supple
{
  namespace
  {
    /** Keeps the wanted columns of a run. */
    class Recorder : public Listener
    {
    public:
      Recorder(const std::set<std::string> &wanted,
               const bool with_contact,
               const std::vector<std::string> &probe_columns,
               StudyRecord &record,
               const double budget,
               const MPI_Comm communicator)
        : record(record)
        , budget(budget)
        , communicator(communicator)
      {
        std::vector<std::string> names = Measurement::column_names(with_contact);
        n_history                      = names.size();
        names.insert(names.end(), probe_columns.begin(), probe_columns.end());
        for (std::size_t c = 0; c < names.size(); ++c)
          if (wanted.count(names[c]) > 0 && record.columns.count(names[c]) == 0)
            columns.emplace_back(c, &record.columns[names[c]]);
      }

      bool
      after_step(const Observation &now) override
      {
        const std::vector<double> row = now.measurement.row();
        for (const auto &[c, column] : columns)
          column->push_back(c < n_history ? row[c] : now.probes[c - n_history]);
        if (std::isfinite(budget) && !now.last)
          stop_if_too_slow(now.measurement.step);
        return true;
      }

    private:
      /** @throws ComputationError on all processes */
      void
      stop_if_too_slow(const unsigned int step)
      {
        const double seconds = dealii::Utilities::MPI::max(stopwatch.seconds(), communicator);
        if (step == 0 || seconds < budget)
          return;
        record.stopped = true;
        throw ComputationError("it takes longer than another run that is as good");
      }

      StudyRecord &record;
      const double budget; ///< [s]
      const MPI_Comm communicator;
      const Stopwatch stopwatch;
      std::size_t n_history; ///< columns of history.csv; those of probes.csv come after them
      std::vector<std::pair<std::size_t, std::vector<double> *>> columns;
    };
  } // namespace


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
    check_adaptation(parameters, communicator);
    Simulation(parameters, "", true, communicator).check();
  }


  double
  StudyRunner::seconds_of(const Summary &summary) const
  {
    double seconds = summary.run_seconds;
    for (const RefinementParameters::Pilot &pilot : summary.pilots)
      seconds += pilot.seconds;
    return dealii::Utilities::MPI::max(seconds, communicator);
  }


  StudyRecord
  StudyRunner::record(const Parameters &parameters,
                      const std::string &folder,
                      const double budget) const
  {
    StudyRecord record;
    Parameters scene;
    try
      {
        scene = adapted(parameters, false, communicator);
      }
    catch (const InterruptedError &)
      {
        throw;
      }
    catch (const ComputationError &error)
      {
        record.status = StudyRecord::Status::failed;
        record.reason = error.what();
        return record;
      }
    scene.output.report = false; // the study has one for all
    scene.checkpoint    = {};    // what goes on lacks the rows before
    Simulation simulation(scene, folder, true, communicator);

    Recorder recorder(
      wanted, scene.has_contact(), simulation.probe_columns(), record, budget, communicator);
    try
      {
        simulation.run(&recorder);
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
    record.displacement    = simulation.current_state().displacement;
    record.end             = simulation.time();
    record.summary         = summary.numbers();
    record.warnings        = summary.warnings;
    record.n_cells         = summary.size.cells;
    record.cell_size       = summary.size.cell_size;
    record.steps           = summary.steps;
    record.rejected        = summary.effort.rejected_steps;
    record.failed          = summary.effort.failed_steps;
    record.seconds         = seconds_of(summary);
    if (summary.space_errors)
      record.space_error = summary.space_errors->in_words();
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
        Simulation simulation(adapted(parameters, false, communicator), "", true, communicator);
        simulation.run();
        seconds.push_back(seconds_of(simulation.summary()));
      }
    std::sort(seconds.begin(), seconds.end());
    const std::size_t middle = seconds.size() / 2;
    return seconds.size() % 2 == 1 ? seconds[middle]
                                   : 0.5 * (seconds[middle - 1] + seconds[middle]);
  }
} // namespace Supple
