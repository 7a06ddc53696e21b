#ifndef supple_simulation_h
#define supple_simulation_h

#include <supple/base/progress.h>
#include <supple/observe/diagnostics.h>
#include <supple/observe/probes.h>
#include <supple/observe/profiles.h>
#include <supple/run/cell_indicators.h>
#include <supple/run/checkpoints.h>
#include <supple/run/course.h>
#include <supple/run/description.h>
#include <supple/run/interruption.h>
#include <supple/run/listener.h>
#include <supple/run/problem.h>
#include <supple/run/results.h>
#include <supple/run/second_mesh.h>
#include <supple/run/skipped_pulses.h>
#include <supple/run/space_estimate.h>
#include <supple/run/step_doubling.h>
#include <supple/run/summary.h>
#include <supple/run/writers.h>
#include <supple/time/time_integrator.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Supple
{
  /** One scene, from its parameters to its results. */
  class Simulation
  {
  public:
    /**
     * Builds all that the scene needs and validates it; writes nothing.
     * @param folder of the results; if empty, the run writes nothing either
     * @param quiet  no words on the screen
     * @throws InputError
     */
    Simulation(const Parameters &scene,
               const std::string &folder,
               bool quiet,
               MPI_Comm communicator);

    /** What one run leaves to another that goes on from its last state: see go_on_from(). */
    struct Legacy
    {
      std::shared_ptr<const Mesh> mesh;
      State state;
      double time = 0.; ///< [s]
      Effort effort;
      Vector reactions;         ///< of what holds the body [N]
      std::vector<Vector> kept; ///< of listeners
      std::string rest;         ///< of course, cells, diagnostics and listeners, packed
    };

    /**
     * Builds all that the rest of a run needs whose scene has changed, but for its mesh.
     * @param quiet, folder as above
     * @throws InputError if the scene is wrong
     */
    Simulation(const Parameters &scene,
               const std::shared_ptr<const Mesh> &mesh,
               const std::string &folder,
               bool quiet);

    /**
     * Runs the scene; to be called once.
     * @param guest a listener beside those that write the results, or null
     * @throws InputError if the start is wrong or the results can't be written, ComputationError
     * with the step and the time, after all files are complete
     */
    void
    run(Listener *guest = nullptr);

    /** What run() does before the first step. The files are there then.
     * @throws InputError as run() */
    void
    begin(Listener *guest = nullptr);

    /** What run() does after the last step. */
    void
    end();

    /** What run() does where a listener asks to stop. @throws InterruptedError */
    [[noreturn]] void
    interrupt();

    /** Begins where another run has stopped, which must be gone, and goes on with its files.
     * @throws InputError if the state is none of this scene */
    void
    go_on_from(const Legacy &legacy, Listener *guest = nullptr);

    /** For another run that goes on from here. Collective. */
    Legacy
    leave();

    /** Takes a step, and ends the run where it fails. @return whether no listener asks to stop.
     * @throws ComputationError with step and time, after all files are complete */
    bool
    step();

    /** Takes a single step. @return whether no listener asks to stop. @throws ComputationError */
    bool
    advance();

    bool
    finished() const;

    /** After the last accepted step [s]; the load factor of a static problem. */
    double
    time() const
    {
      return course.now.time;
    }

    const Measurement &
    measurement() const
    {
      return course.now;
    }

    /** A row of probes.csv of the last accepted state. */
    const std::vector<double> &
    probe_row() const
    {
      return probes_now;
    }

    /** What is run, with its present state. */
    const Problem &
    present() const
    {
      return problem;
    }

    /** Variable steps end at a time [s] at the latest. */
    void
    stop_at(const double time)
    {
      integrator->stop_at(time);
    }

    /** Forces of what holds the body, after an observed step [N]. */
    const Vector &
    reactions() const
    {
      return integrator->reactions();
    }

    /** Sums of the local errors so far [m]. */
    double
    error_estimate() const
    {
      return course.error_estimate;
    }

    /** How far the farthest vertex has been from its place at the start [m]. */
    double
    largest_motion() const
    {
      return course.largest_motion;
    }

    /** What the user should know by now, in sentences. */
    std::vector<std::string>
    warnings() const
    {
      return description().warnings();
    }

    /** Displacement and, if the problem is dynamic, velocity after the last accepted step. */
    const State &
    current_state() const
    {
      return problem.configuration.state;
    }

    /** The rows that profile_NAME.csv would get now, on the first process. There must be such a
     * profile. */
    std::vector<std::vector<double>>
    profile(const std::string &name) const;

    /** The names of the columns of probes.csv. */
    std::vector<std::string>
    probe_columns() const
    {
      return probes.column_names();
    }

    /** A guest of the run that finds where the mesh is too coarse. It must not outlive this.
     * @param quantity energy or a column of probes.csv
     * @throws InputError if the scene can't be refined by that */
    std::unique_ptr<CellIndicators>
    make_indicators(const std::string &quantity);

    /** A scene with the vertices that its points choose on the mesh of this one. Collective. */
    Parameters
    with_chosen_vertices(const Parameters &scene) const;

    /** What summary.json tells; to be called after the run. */
    const Summary &
    summary() const
    {
      return *last_summary;
    }

    /** Measures the start, and says what would be run, as a table, with what was found in the mesh;
     * runs nothing. @throws InputError if the start is not one of finite numbers */
    void
    check();

  private:
    /** The second run, which tells the error of this one; null if nobody asks for it. */
    std::unique_ptr<StepDoubling>
    make_second_run();

    /** The runs on other meshes, which tell the error of this one; null if nobody asks for them. */
    std::unique_ptr<SecondMesh>
    make_second_mesh();

    /** A run of another scene. @param after_step is called after each of its steps */
    Companion::Run
    other_run(const Parameters &scene, const std::function<void()> &after_step) const;

    /** What estimates the error in space of this run; null if nobody asks for it. */
    std::unique_ptr<SpaceEstimate>
    make_space_estimate();

    /** Of the run, without those of others that move along. */
    double
    own_seconds() const;

    /** All that follow the run, each by one line. */
    void
    add_listeners(Listener *guest);

    Observation
    observation() const;

    Description
    description() const;

    /** Accepts the state after a step, which then is the present one, and looks at it if somebody
     * asks. @throws InputError and ComputationError as observe() */
    void
    measure(unsigned int after_step, const StepReport &report);

    /**
     * Measures energies and probes of the state after a step.
     * @throws InputError at the start, ComputationError later, if something is no finite number or
     * a listener objects; the state then is the one before
     */
    void
    observe(unsigned int after_step, const StepReport &report);

    /** A row of probes.csv. */
    std::vector<double>
    probe_values(const Measurement &next) const;

    /** Why the run must not accept what was measured, in words; empty if it may. */
    std::string
    objection(const Measurement &next) const;

    /** Throws that, with the state set back. */
    [[noreturn]] void
    refuse(const std::string &what, const Measurement &next);

    Simulation(std::shared_ptr<Problem> of_scene, const std::string &folder, bool quiet);

    /** Does something, and ends the run where it fails, as run() says. @return what it returns */
    bool
    tell_failures(const std::function<bool()> &action);

    /** Prints what is run, and has the listeners begin. */
    void
    open();

    /** Ends the run in the step that failed. @throws ComputationError with step and time */
    [[noreturn]] void
    fail(const std::string &why);

    /** Lets the listeners write what they have for the end, and writes the summary. */
    void
    finish(const std::string &status);

    Summary
    summarize(const std::string &status);

    Course course;    // first, for it takes the time
    const bool talks; ///< this process writes on the screen
    const std::shared_ptr<Problem> own_problem;
    Problem &problem;
    const Probes probes;
    const Profiles profiles;
    const std::unique_ptr<TimeIntegrator> integrator;
    Diagnostics diagnostics;
    const std::unique_ptr<StepDoubling> second_run; ///< if the scene asks for it
    const std::unique_ptr<SecondMesh> second_mesh;  ///< if the scene asks for it
    SkippedPulses pulses;
    const Vector start_displacement;

    Results results;
    std::unique_ptr<SpaceEstimate> space;
    FrameWriter *frames      = nullptr; ///< of the results
    Checkpoints *checkpoints = nullptr; ///< of the results
    Interruption interruption;
    Listeners listeners;
    bool observed = false; ///< somebody asks for energies and reactions
    bool refused  = false; ///< the last step was measured, but its state is the one before
    bool probed   = false; ///< somebody asks for values of probes

    std::vector<double> probes_now;         ///< the row of probes.csv
    std::vector<std::string> warnings_told; ///< when the run began
    Progress progress;
    std::optional<Summary> last_summary;
  };
} // namespace Supple

#endif
