#include <supple/study/study.h>

#include <supple/base/error.h>
#include <supple/base/files.h>
#include <supple/base/interrupt.h>
#include <supple/base/progress.h>
#include <supple/base/stopwatch.h>
#include <supple/base/text.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using dealii::Utilities::MPI::n_mpi_processes;
  using dealii::Utilities::MPI::this_mpi_process;

  Study::Study(const StudyParameters &study,
               const std::string &folder,
               const bool quiet,
               const MPI_Comm communicator)
    : parameters(study)
    , output(folder, quiet, communicator)
    , plan(parameters)
    , quantities(parameters, plan)
    , runner(quantities.needed(), communicator)
  {
    check_parameters();
    table.kind        = plan.kind;
    table.name        = parameters.name;
    table.error_names = quantities.error_names();
    table.value_names = quantities.value_names();
    table.judged      = std::any_of(plan.runs.begin(), plan.runs.end(), [](const PlannedRun &run) {
      return !run.right_if.empty();
    });
    table.targets     = parameters.targets;
    state_facts();
  }


  void
  Study::check_parameters() const
  {
    for (const auto &list : {plan.references, plan.level_references})
      for (const PlannedRun &run : list)
        plan.parameters(run);
    if (plan.kind == StudyPlan::Kind::cases)
      return; // a refusal is a result there
    for (const PlannedRun &run : plan.runs)
      plan.parameters(run);
  }


  void
  Study::check() const
  {
    output.say("Study " + parameters.name + " of scene " + plan.base.scene_name + ": " +
               std::to_string(plan.runs.size()) + " runs and " +
               std::to_string(plan.references.size() + plan.level_references.size()) +
               " for the reference");
    for (const auto &list : {plan.references, plan.level_references, plan.runs})
      for (const PlannedRun &run : list)
        {
          std::string result = "can be run";
          try
            {
              runner.check(plan.parameters(run));
            }
          catch (const InputError &error)
            {
              if (plan.kind != StudyPlan::Kind::cases)
                throw InputError("Run '" + run.label() + "': " + error.what());
              result = std::string("refused: ") + error.what();
            }
          output.say("  " + run.label() + ": " + result);
        }
  }


  void
  Study::state_facts()
  {
    table.facts.push_back(parameters.scene_in_words());
    std::string set;
    for (const Override &override : parameters.command_line)
      set += (set.empty() ? "`" : ", `") + override.text + "`";
    if (!set.empty())
      table.facts.push_back("Set on the command line: " + set + ".");
    if (!table.error_names.empty())
      table.facts.push_back("Error: " + quantities.error_meaning() + ".");
    const unsigned int n_ranks = n_mpi_processes(output.communicator);
    table.facts.push_back(
      (parameters.repeats == 0 ? std::string("Seconds: run time with all measurements")
                               : "Seconds: run time without set-up and output, median of " +
                                   std::to_string(parameters.repeats)) +
      (n_ranks == 1 ? ", 1 process." : ", " + std::to_string(n_ranks) + " processes."));
    if (table.judged)
      table.facts.push_back("Right: `" + parameters.right_if +
                            "`, unless the study has another condition for the case.");
  }


  void
  Study::run()
  {
    const InterruptGuard interrupt;
    const Stopwatch stopwatch;
    for (const auto &list : {plan.references, plan.level_references})
      for (const PlannedRun &run : list)
        runner.check(plan.parameters(run)); // what is refused leaves an earlier study as it is
    output.open(study_files(),
                [this] { write_whole_file(output.folder + "/study.csv", table.csv()); });
    output.say("Supple " SUPPLE_VERSION ", study " + parameters.name + ": " +
               std::to_string(plan.runs.size()) + " runs of scene " + plan.base.scene_name);
    try
      {
        run_references();
        for (const PlannedRun &run : plan.runs)
          {
            run_level_reference(run);
            table.add(run_one(run));
            output.say(table.line(table.rows.back()));
            write(false);
            if (interrupt.requested(output.communicator))
              throw InterruptedError("");
          }
      }
    catch (const InterruptedError &)
      {
        write(true);
        throw InterruptedError("Interrupted after " + std::to_string(table.rows.size()) + " of " +
                               std::to_string(plan.runs.size()) +
                               " runs; the table of these is in " + output.folder + ".");
      }
    write(true);

    if (plan.kind != StudyPlan::Kind::cases)
      for (const std::string &sentence : table.sentences())
        output.say(sentence);
    output.say("done in " + readable_duration(stopwatch.seconds()) + ": " + output.folder +
               "/study.md");
    require_any_right();
  }


  void
  Study::require_any_right() const
  {
    const bool any = std::any_of(table.rows.begin(), table.rows.end(), [](const StudyRow &row) {
      return row.status == StudyRecord::Status::done && row.verdict != "wrong";
    });
    if (any || table.rows.empty())
      return;
    const StudyRow &first = table.rows.front();
    throw ComputationError("None of the " + std::to_string(table.rows.size()) +
                           " runs of the study is done" + (table.judged ? " and right" : "") +
                           "; the first: " + first.run.label() + ": " + first.status_text() +
                           (first.verdict.empty() ? "" : ", " + first.verdict) +
                           ". The table is in " + output.folder + ".");
  }


  void
  Study::run_references()
  {
    std::vector<StudyRecord> records;
    for (const PlannedRun &run : plan.references)
      {
        records.push_back(runner.record(plan.parameters(run), ""));
        const StudyRecord &record = records.back();
        if (record.status != StudyRecord::Status::done)
          throw ComputationError("The reference (" + run.label() + ") failed: " + record.reason);
        output.say("  reference: " + run.label() + ", " + digits(record.seconds, 3) + " s");
      }
    if (records.empty())
      return;
    reference        = records.back();
    std::string text = "Reference: " + plan.references.back().label();
    if (records.size() > 1)
      {
        // The finer one at all of its times against the coarser one in between, too.
        const auto errors     = plan.kind == StudyPlan::Kind::methods
                                  ? quantities.errors(records.back(), &records.front())
                                  : quantities.errors(records.front(), &records.back());
        table.reference_error = errors.front();
        text +=
          "; its own error is at most its distance from " + plan.references.front().label() + ":";
        for (std::size_t i = 0; i < errors.size(); ++i)
          text += (i == 0 ? " " : ", ") + percent(errors[i]) + " of " + table.error_names[i];
        output.say("  its own error: " + percent(table.reference_error));
      }
    table.facts.push_back(text + ".");
    const auto in_space = reference->summary.find("error_estimate/space/work");
    if (!plan.level_references.empty())
      table.facts.push_back(
        "The mesh of the reference has an error of its own, by which errors in space may be "
        "wrong: " +
        (in_space == reference->summary.end()
           ? "it is not known"
           : "about " + percent(in_space->second) + " of the elastic energy") +
        ".");
  }


  void
  Study::run_level_reference(const PlannedRun &run)
  {
    if (run.level.empty() || (level_reference && level_of_reference == run.level))
      return;
    const auto planned =
      std::find_if(plan.level_references.begin(),
                   plan.level_references.end(),
                   [&](const PlannedRun &other) { return other.level == run.level; });
    level_reference    = runner.record(plan.parameters(*planned), "");
    level_of_reference = run.level;
    if (level_reference->status != StudyRecord::Status::done)
      throw ComputationError("The reference (" + planned->label() +
                             ") failed: " + level_reference->reason);
    level_error = quantities.errors(*level_reference, &*reference).front();
    output.say("  reference: " + planned->label() + ", " + digits(level_reference->seconds, 3) +
               " s, in space " + percent(level_error));
  }


  StudyRow
  Study::run_one(const PlannedRun &run) const
  {
    StudyRow row;
    row.run = run;
    try
      {
        const Parameters scene = plan.parameters(run);
        const StudyRecord record =
          runner.record(scene,
                        parameters.histories ? output.folder + "/runs/" + run.folder_name()
                                             : std::string());
        measure(row, record);
        if (record.status == StudyRecord::Status::done && parameters.repeats > 0)
          row.seconds = runner.time(scene, parameters.repeats);
      }
    catch (const InputError &error)
      {
        row.status = StudyRecord::Status::refused;
        row.reason = error.what();
      }
    catch (const InterruptedError &)
      {
        throw;
      }
    catch (const ComputationError &error)
      {
        row.status = StudyRecord::Status::failed;
        row.reason = error.what();
      }
    if (!run.right_if.empty())
      row.verdict = row.status == StudyRecord::Status::refused ? "refused"
                    : row.status == StudyRecord::Status::failed
                      ? "failed"
                      : quantities.verdict(run,
                                           row.values,
                                           table.rows.empty() ? std::vector<double>()
                                                              : table.rows.back().values,
                                           row.warnings);
    return row;
  }


  void
  Study::measure(StudyRow &row, const StudyRecord &record) const
  {
    row.take(record);
    row.size = row.run.cell_size > 0. ? row.run.cell_size : record.cell_size;
    if (plan.kind == StudyPlan::Kind::methods)
      row.size = record.end / record.steps;
    row.values = quantities.values(record);
    if (record.status != StudyRecord::Status::done)
      return;
    row.errors = quantities.errors(record, reference ? &*reference : nullptr);
    if (!level_reference)
      return;
    row.error_in_space = level_error;
    row.error_in_time  = quantities.errors(record, &*level_reference).front();
  }


  void
  Study::write(const bool with_plots) const
  {
    if (!output.root)
      return;
    write_study(output.folder, table);
    if (with_plots && plan.kind != StudyPlan::Kind::cases)
      output.say(plot_study(table, output.folder));
  }
} // namespace Supple
