#ifndef supple_checkpoints_h
#define supple_checkpoints_h

#include <supple/observe/diagnostics.h>
#include <supple/output/checkpoint.h>
#include <supple/run/course.h>
#include <supple/run/problem.h>
#include <supple/run/writers.h>
#include <supple/time/time_integrator.h>

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <string>
#include <vector>

namespace Supple
{
  /** Checkpoints of a run: its state, and what integrator, diagnostics and listeners keep. */
  class Checkpoints : public Writer
  {
  public:
    /** @param diagnostics null if nobody asks for energies
     *  @param listeners   of the run */
    Checkpoints(const std::string &folder,
                Problem &problem,
                TimeIntegrator &integrator,
                Diagnostics *diagnostics,
                Course &course,
                const Listeners &listeners);

    static std::vector<std::string>
    files();

    void
    open(bool resumed, unsigned int step) override;

    /** Goes on from the checkpoint in the folder, if that is wanted and there is one.
     * @throws InputError if it is not one of this scene */
    void
    resume();

    void
    begin(const Observation &now, bool resumed) override;

    bool
    after_step(const Observation &now) override;

    void
    interrupted(const Observation &now) override;

    /** @throws InputError on all processes if the run to go on from has come further than this one
     * is to go: its last rows would be lost */
    void
    require_later_end() const;

  private:
    /** @throws InputError, nlohmann::json::exception if something is missing */
    void
    take(const nlohmann::json &saved);

    void
    write(bool in_haste);

    /** Those of the state, and those of the listeners. */
    std::vector<Vector *>
    kept_vectors() const;

    Problem &problem;
    TimeIntegrator &integrator;
    Diagnostics *const diagnostics;
    Course &course;
    const Listeners &listeners;
    Checkpoint checkpoint;

    /** What listeners keep, with that of the checkpoint for those that this run does not have. */
    std::unique_ptr<nlohmann::json> kept;
  };
} // namespace Supple

#endif
