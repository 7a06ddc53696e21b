#ifndef supple_study_h
#define supple_study_h

#include <supple/base/task_output.h>
#include <supple/study/study_parameters.h>
#include <supple/study/study_plan.h>
#include <supple/study/study_quantities.h>
#include <supple/study/study_runner.h>
#include <supple/study/study_table.h>

#include <memory>
#include <optional>
#include <string>

namespace Supple
{
  /**
   * Many runs of one scene, compared: methods in time with their steps or tolerances, meshes from
   * coarse to fine, or a list of cases. Error against run time, observed orders, and which run
   * gives an error soonest.
   *
   * Into its folder it writes study.csv, study.md, report.html, plots of error against run time and
   * against step or cell size (SVG, PNG and the script of gnuplot they are made by), and a folder
   * for each run.
   * The tables are complete after each run.
   */
  class Study
  {
  public:
    /**
     * Reads the scene and the parameters of all runs.
     * @param quiet no words on the screen
     * @throws InputError
     */
    Study(const StudyParameters &parameters,
          const std::string &folder,
          bool quiet,
          MPI_Comm communicator);

    /** Builds what each run needs, its mesh included, and runs nothing. @throws InputError */
    void
    check() const;

    /** A run that fails stays in the table. @throws ComputationError if the reference fails,
     * InterruptedError */
    void
    run();

  private:
    /** Of all runs and references. @throws InputError */
    void
    check_parameters() const;

    /** @throws ComputationError if every run has failed, was refused or is wrong */
    void
    require_any_right() const;

    /** What the table says of how it came about. */
    void
    state_facts();

    void
    run_references();

    StudyRow
    run_one(const PlannedRun &run) const;

    /** Runs the reference on the level of a run, if that is another one than before. */
    void
    run_level_reference(const PlannedRun &run);

    /** What was measured of a run. */
    void
    measure(StudyRow &row, const StudyRecord &record) const;

    /** Tables, and at the end plots. */
    void
    write(bool with_plots) const;

    const StudyParameters parameters;
    TaskOutput output;
    const StudyPlan plan;
    const StudyQuantities quantities;
    const StudyRunner runner;
    std::optional<StudyRecord> reference;
    std::optional<StudyRecord> level_reference; ///< of methods on levels
    std::string level_of_reference;             ///< the level of that
    double level_error = 0.;                    ///< of that, in space; relative
    StudyTable table;
  };
} // namespace Supple

#endif
