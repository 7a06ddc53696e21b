#ifndef supple_study_table_h
#define supple_study_table_h

#include <supple/study/study_plan.h>
#include <supple/study/study_record.h>

#include <limits>
#include <string>
#include <vector>

namespace Supple
{
  /** A run of a study when it is done, failed or refused. */
  struct StudyRow
  {
    PlannedRun run;
    StudyRecord::Status status = StudyRecord::Status::done;
    std::string reason; ///< of a failure or refusal
    std::vector<std::string> warnings;
    std::vector<double> errors; ///< relative; not-a-number where there is none
    double error_in_space = std::numeric_limits<double>::quiet_NaN(); ///< of methods on levels
    double error_in_time  = std::numeric_limits<double>::quiet_NaN(); ///< of methods on levels
    std::vector<double> values;
    std::string verdict;
    double size           = 0.; ///< mean step [s] or size of the cells [m]
    double seconds        = 0.;
    unsigned int n_cells  = 0;
    unsigned int steps    = 0;
    unsigned int rejected = 0; ///< steps
    unsigned int failed   = 0; ///< steps

    std::vector<double> orders; ///< observed, from the row before of the same series to this one
    bool on_front = false;      ///< no other run is both better and quicker

    /** Takes what a record tells of a run beside its errors and values. */
    void
    take(const StudyRecord &record);

    /** The error that orders, front and plots are about; not-a-number if there is none. */
    double
    error() const;

    /** "done", "failed: ..." or "refused: ..." */
    std::string
    status_text() const;

    /** What went wrong, or the warnings. */
    std::string
    note() const;
  };


  /** The results of a study, and what follows from them. Knows nothing of how they came about. */
  struct StudyTable
  {
    StudyPlan::Kind kind;
    std::string name;               ///< of the study
    std::vector<std::string> facts; ///< sentences to stand before the table
    std::vector<std::string> error_names, value_names;
    double reference_error = 0.;    ///< relative; 0 where the values are exact
    bool judged            = false; ///< rows have verdicts
    std::vector<double> targets;
    std::vector<StudyRow> rows;

    /** Whether methods are run on several levels, so that errors in space and time are told. */
    bool
    on_levels() const;

    /** Adds a row and finds orders and front anew. */
    void
    add(const StudyRow &row);

    /** For each target the run that reaches it soonest: "1 % : trbdf2, tolerance 1e-2, 0.6 s". */
    std::vector<std::string>
    sentences() const;

    std::string
    csv() const;

    std::string
    markdown() const;

    /** A row for the screen. */
    std::string
    line(const StudyRow &row) const;

  private:
    void
    find_orders();

    void
    find_front();
  };


  /** "0.83 %", or "unknown" of what is no finite number */
  std::string
  percent(double part);


  /**
   * Writes scripts for gnuplot with the data in them, and has them draw SVG and PNG: error against
   * run time, and error against step or cell size.
   * @return what went wrong, in a sentence; empty if nothing did
   */
  std::string
  plot_study(const StudyTable &table, const std::string &folder);


  /** Writes report.html: the table, and plots of error against run time. @throws WriteError */
  void
  write_report(const std::string &folder, const StudyTable &table);


  /** The names of all files that a study leaves in its folder, for remove_files(). */
  std::vector<std::string>
  study_files();


  /** Writes study.csv, study.md and report.html. @throws WriteError */
  void
  write_study(const std::string &folder, const StudyTable &table);
} // namespace Supple

#endif
