#ifndef supple_study_runner_h
#define supple_study_runner_h

#include <supple/scene/parameters.h>
#include <supple/study/study_record.h>

#include <limits>
#include <set>
#include <string>

namespace Supple
{
  struct Summary;

  /** Runs scenes for a study. */
  class StudyRunner
  {
  public:
    /** @param columns to be kept beside the time; those that a scene lacks are left out */
    StudyRunner(const std::set<std::string> &columns, MPI_Comm communicator);

    /** Builds what a run needs, its mesh included, and runs nothing. @throws InputError */
    void
    check(const Parameters &parameters) const;

    /**
     * Runs a scene once and keeps what is asked for.
     * @param folder of its files; empty: none
     * @param budget a run that takes longer is stopped [s]
     * @return a record that may be of a failure
     * @throws InputError, InterruptedError
     */
    StudyRecord
    record(const Parameters &parameters,
           const std::string &folder,
           double budget = std::numeric_limits<double>::infinity()) const;

    /** The median of the run time of some runs that measure and write nothing, largest over all
     * processes [s]. @throws ComputationError */
    double
    time(const Parameters &parameters, unsigned int repeats) const;

  private:
    /** Run time, and that of the pilot runs that refined the mesh; largest over all processes [s].
     */
    double
    seconds_of(const Summary &summary) const;

    const std::set<std::string> wanted;
    const MPI_Comm communicator;
  };
} // namespace Supple

#endif
