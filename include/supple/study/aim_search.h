#ifndef supple_aim_search_h
#define supple_aim_search_h

#include <supple/base/interrupt.h>
#include <supple/base/stopwatch.h>
#include <supple/base/task_output.h>
#include <supple/study/aim_curve.h>
#include <supple/study/mesh_search.h>
#include <supple/study/study_parameters.h>
#include <supple/study/study_plan.h>
#include <supple/study/study_quantities.h>
#include <supple/study/study_runner.h>
#include <supple/study/study_table.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Supple
{
  /**
   * The soonest run of a scene whose error is below an aim. The error is that in time, and what is
   * looked for are method, and step or tolerance; if the aim is about the mesh too, the error in
   * time may have a part of it, and MeshSearch looks for a mesh with the rest. Static scenes have a
   * mesh alone.
   *
   * First a reference is made so good that two runs of it, one with a tenth of the tolerance of the
   * other, are apart by half the aim at most. Then each method is tried with the step or tolerance
   * that what is known so far promises to meet the aim (AimCurve); a run that takes longer than
   * the best one so far is stopped. An error counts with that of the reference on top.
   *
   * Into its folder it writes study.csv, study.md and report.html, as a Study.
   */
  class AimSearch
  {
  public:
    /** @param quiet no words on the screen
     * @throws InputError */
    AimSearch(const StudyParameters &parameters,
              const std::string &folder,
              bool quiet,
              MPI_Comm communicator);

    /** Builds what a run of each method needs, and runs nothing. @throws InputError */
    void
    check() const;

    /** @throws ComputationError if nothing meets the aim, or the reference can't tell;
     * InterruptedError */
    void
    run();

  private:
    /** Finds the soonest run in time. */
    void
    search_in_time(const InterruptGuard &interrupt);

    /** Finds the soonest mesh for the runs that are good enough in time. @return what was found, in
     * sentences @throws ComputationError if nothing meets the aim */
    std::vector<std::string>
    search_mesh(const InterruptGuard &interrupt);

    /** Both searches. @return what was found, in sentences */
    std::vector<std::string>
    search_all(const InterruptGuard &interrupt);

    /** @throws InterruptedError if the user has asked for it */
    void
    stop_if(const InterruptGuard &interrupt) const;

    /** @throws ComputationError that nothing moves */
    [[noreturn]] void
    refuse_rest() const;

    /** The runs that are good enough in time, the soonest first. */
    std::vector<MeshSearch::InTime>
    good_in_time() const;

    /** A method that may win. */
    struct Candidate
    {
      StudyItem method;
      bool variable_steps;
      unsigned int order;
      AimCurve curve;
      std::vector<std::size_t> rows; ///< of the table, one for each run of the curve
    };

    bool
    is_stationary() const;

    /** " in time" where the aim is about more than that. */
    std::string
    in_time() const;

    std::vector<Candidate>
    candidates() const;

    /** Adds both kinds of steps of a method that the scene can have. */
    void
    add_candidates(std::vector<Candidate> &list, const StudyItem &method) const;

    PlannedRun
    planned(const Candidate &candidate, double x) const;

    /** Two runs of a method of high order, and how far they are apart. @throws ComputationError */
    void
    find_reference();

    /** @throws InputError if the scene can't have any of the methods of a reference */
    Candidate
    candidate_of_reference() const;

    /** @throws ComputationError that the aim is below what can be told */
    [[noreturn]] void
    refuse_aim(double told) const;

    /** All errors that the aim is about, the largest of them. */
    double
    error_of(const StudyRecord &run, const StudyRecord &right) const;

    void
    search(Candidate &candidate);

    /** x of the first run. */
    double
    first_guess(const Candidate &candidate) const;

    /** @return whether it may still win */
    bool
    try_run(Candidate &candidate, double x);

    /** Adds a run to the table and to what is known of its method. */
    void
    add_trial(Candidate &candidate, double x, const PlannedRun &run, const StudyRecord &record);

    /** Whether the reference is made by this method. */
    bool
    is_of_reference(const Candidate &candidate) const;

    /** The same of a run that was made on the way to the reference. */
    void
    take_from_reference(double tolerance, const StudyRecord &record);

    /** The candidate with the soonest run that meets the aim, or null. */
    const Candidate *
    winner() const;

    /** Sentence, entries for the scene, errors and prices. */
    std::vector<std::string>
    result(const Candidate &best) const;

    /** The same of a mesh. */
    std::vector<std::string>
    result(const MeshSearch::Found &mesh) const;

    /** "Entries for the scene: ..." */
    std::string
    entries_of(const PlannedRun &run) const;

    /** The soonest run of a candidate that meets the aim, or null. */
    const AimCurve::Trial *
    best_trial(const Candidate &candidate) const;

    /** A run of a candidate in the table. */
    const StudyRow &
    row_of(const Candidate &candidate, const AimCurve::Trial &trial) const;

    /** The soonest run of a candidate that meets the aim, in the table. */
    const StudyRow &
    best_row(const Candidate &candidate) const;

    void
    write() const;

    const StudyParameters parameters;
    TaskOutput output;
    const StudyPlan plan;
    const StudyQuantities quantities;
    const StudyRunner runner;
    const double whole_aim; ///< relative
    const double aim;       ///< of it in time
    std::optional<StudyRecord> reference;
    std::string reference_method;
    double reference_error   = 0.; ///< relative
    double reference_seconds = 0.; ///< until the reference was there
    double best_seconds;           ///< of a run that meets the aim, so far
    std::vector<Candidate> list;
    std::vector<std::string> space_errors; ///< of each row, in words
    StudyTable table;
    const Stopwatch stopwatch;
  };
} // namespace Supple

#endif
