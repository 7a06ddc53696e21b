#ifndef supple_study_plan_h
#define supple_study_plan_h

#include <supple/scene/parameters.h>
#include <supple/study/study_parameters.h>

#include <string>
#include <vector>

namespace Supple
{
  /** One run of a study. */
  struct PlannedRun
  {
    std::string series; ///< method or variant, as written; may be empty
    std::string level;  ///< on which a method is run, as written; may be empty
    std::string curve;  ///< runs of the same curve differ in step, tolerance or mesh alone
    std::string name;   ///< "step 0.07", level or case, as written
    std::vector<Override> overrides;
    double step      = 0.; ///< of a method with fixed steps [s]
    double tolerance = 0.; ///< of a method with variable steps
    double cell_size = 0.; ///< of a level whose name says so [m]
    std::string right_if;  ///< its own or the study's condition; may be empty

    std::string
    label() const;

    /** The same as the name of a folder. */
    std::string
    folder_name() const;
  };


  /** "name [Section/Entry=value | Section/Entry=value]: rest", taken apart. */
  struct StudyItem
  {
    std::string title; ///< name and brackets as written
    std::string name;
    std::vector<Override> overrides;
    std::string rest; ///< behind the colon; empty if there is none
  };


  /** Items set apart by semicolons outside of brackets. @throws InputError */
  std::vector<StudyItem>
  study_items(const std::string &text, const std::string &place);


  /** What a study is going to run. */
  struct StudyPlan
  {
    enum class Kind
    {
      methods,
      levels,
      cases
    };

    Kind kind;
    std::vector<PlannedRun> runs;

    /** Of a study with an aim: those that may be tried; none: all. */
    std::vector<StudyItem> methods;

    /** Whether an aim is about the error in space too. */
    bool aims_at_mesh = false;

    /** From coarse to fine: the last one counts, the first one tells how good that is. */
    std::vector<PlannedRun> references;

    /** Of methods on several levels: the reference on each of these, from which errors in time are
     * told. */
    std::vector<PlannedRun> level_references;

    /** @throws InputError */
    explicit StudyPlan(const StudyParameters &study);

    /** The parameters of a run. @throws InputError */
    Parameters
    parameters(const PlannedRun &run) const;

    /**
     * The beginning of a message about what an entry of the study asks of its scene, if the command
     * line changed one of these entries of the scene: "--set: Time/Step = 0.03 does not go with ".
     * Else nothing: the study itself is to blame.
     */
    std::string
    changed_by_hand(const std::vector<std::string> &entries) const;

    /** A method with this step or tolerance. @param word steps or tolerances, or one of them
     * @throws InputError */
    PlannedRun
    method_run(const StudyItem &item,
               const std::string &word,
               const std::string &number,
               const std::string &place) const;

    /** The parameters that all runs start from. */
    const Parameters base;

  private:
    void
    plan_aim(const StudyParameters &study);

    void
    plan_methods(const StudyParameters &study);

    void
    plan_method_reference(const StudyParameters &study);

    /** Puts each run of a method on each level. */
    void
    plan_methods_on_levels(const StudyParameters &study);

    void
    plan_levels(const StudyParameters &study);

    void
    plan_cases(const StudyParameters &study);

    /** Refuses what is set on the command line, but set otherwise in each run. */
    void
    check_command_line() const;

    const TaskParameters task;
  };
} // namespace Supple

#endif
