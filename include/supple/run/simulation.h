#ifndef supple_simulation_h
#define supple_simulation_h

#include <supple/base/csv_file.h>
#include <supple/base/progress.h>
#include <supple/observe/diagnostics.h>
#include <supple/observe/probes.h>
#include <supple/observe/profiles.h>
#include <supple/output/checkpoint.h>
#include <supple/output/frames.h>
#include <supple/run/step_doubling.h>
#include <supple/run/summary.h>
#include <supple/time/create_integrator.h>

#include <nlohmann/json_fwd.hpp>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace Supple
{
  /** One scene, from its parameters to its results. */
  class Simulation
  {
  public:
    /** An accepted state, and what was measured of it. */
    struct Observation
    {
      const Measurement &measurement;
      const std::vector<double> &probes; ///< as in a row of probes.csv
      const State &state;
    };

    using Observer = std::function<void(const Observation &)>;

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

    /**
     * @param observer is called on all processes with each accepted state, that at the start
     * included
     * @throws ComputationError with the step and the time, after all files are complete
     */
    void
    run(const Observer &observer = {});

    /** A single step, for those who don't run(). @throws ComputationError */
    void
    advance();

    bool
    finished() const;

    /** After the last accepted step [s]; the load factor of a static problem. */
    double
    time() const
    {
      return now.time;
    }

    /** Displacement and, if the problem is dynamic, velocity after the last accepted step. */
    const State &
    current_state() const
    {
      return state;
    }

    /** The rows that profile_NAME.csv would get now, on the first process. There must be such a
     * profile. */
    std::vector<std::vector<double>>
    profile(const std::string &name) const
    {
      return profiles.rows(profiles.number(name), step, now.time, state.block(0));
    }

    /** The names of the columns of probes.csv. */
    std::vector<std::string>
    probe_columns() const
    {
      return probes.column_names();
    }

    /** What summary.json tells; to be called after the run. */
    const Summary &
    summary() const
    {
      return *last_summary;
    }

    /** Says what would be run, as a table, with what was found in the mesh; runs nothing. */
    void
    check() const
    {
      print_description(true);
    }

  private:
    /** What is run, as a table; in detail with what was found in the mesh. */
    void
    print_description(bool in_detail) const;

    /** What the integrator works with. */
    Model
    model();

    void
    create_initial_state();

    /** The second run, which tells the error of this one. */
    void
    create_step_doubling();

    /** Sets the displacement of the rotation that the scene starts with. */
    void
    turn(Vector &displacement) const;

    void
    print_mesh_details() const;

    /** Which rigid motions of the body are free. */
    std::string
    free_rigid_motions() const;

    /** Of a plane body, to begin the description of its model with. */
    std::string
    section_in_words() const;

    /** What the user should know, in sentences. */
    std::vector<std::string>
    warnings() const;

    /** Those of them that come up in the course of a run. */
    std::vector<std::string>
    warnings_of_motion() const;

    /** A warning where cells are less than half or more than twice as large as at rest, or nothing:
     * a strain is not small there, however it is measured. */
    std::string
    strains_too_large() const;

    /** A warning where the time stepping itself drives the motion, or nothing. */
    std::string
    energy_from_nowhere() const;

    void
    open_output();

    /** Takes the results of an earlier run out of the folder, but for frames. */
    void
    clear_results() const;

    void
    clear_frames() const;

    /** On the first process, anew or after so many rows. */
    void
    open_tables();

    /** Goes on from the checkpoint in the output folder, if that is wanted and there is one. */
    void
    resume();

    /** Takes what a checkpoint has kept beside the vectors. */
    void
    load(const nlohmann::json &saved);

    void
    write_checkpoint();

    /** What a checkpoint keeps beside the state. */
    std::vector<Vector *>
    kept_vectors();

    void
    time_loop();

    /**
     * Measures the state after a step, which then is the present one.
     * @throws InputError at the start, ComputationError later, if something is no finite number or
     * the frame that is due could not hold it; the state then is the one before
     */
    void
    measure(unsigned int after_step, const StepReport &report);

    /** In words, what of a measurement, its probes and its frame is no finite number; or nothing.
     */
    std::string
    what_is_not_finite(const Measurement &next) const;

    /** Throws that, with the state set back. */
    void
    refuse(const std::string &what, const Measurement &next);

    /** A row of probes.csv. */
    std::vector<double>
    probe_values(const Measurement &measurement) const;

    /** Writes what was measured. */
    void
    record();

    /** Asks the second run for the error. */
    void
    estimate_error();

    /** Last frame and summary. */
    void
    finish(const std::string &status);

    Summary
    summarize(const std::string &status);

    /** On the first process. */
    void
    write_page(const nlohmann::ordered_json &summary) const;

    /** What the run has to say on the screen at its end. */
    void
    print_result() const;

    /** A sentence; empty where nothing is written. */
    std::string
    where_results_are(const std::string &which) const;

    double
    seconds_since_start() const;

    /** Without set-up, with the runs that this one goes on from. */
    double
    seconds_of_run() const;

    const Parameters parameters;
    const std::string folder;
    const MPI_Comm communicator;
    const bool stationary;
    const bool talks; ///< this process writes on the screen
    const bool writes_history;
    const bool writes_frames;
    const bool writes_report;
    bool observed = false; ///< somebody asks for energies and reactions
    Observer observer;
    Effort effort;
    const std::chrono::steady_clock::time_point start;

    const Mesh mesh;
    const Body body;
    const Constraints constraints;
    const Loads loads;
    const Probes probes;
    Profiles profiles;
    ImplicitOperator implicit_operator;
    std::unique_ptr<LinearSolver> solver;
    State state;
    std::unique_ptr<TimeIntegrator> integrator;
    Diagnostics diagnostics;
    Progress progress;
    std::unique_ptr<CsvFile> history;
    std::unique_ptr<CsvFile> probe_history;
    std::unique_ptr<CsvFile> error_history;
    std::unique_ptr<Frames> frames;
    std::string earlier_frames; ///< JSON of those before a stretch that writes none
    std::unique_ptr<StepDoubling> step_doubling;
    Checkpoint checkpoint;

    std::optional<Summary> last_summary;
    std::vector<std::string> warnings_told; ///< when the run began
    unsigned int step         = 0;
    bool resumed              = false;
    unsigned int steps_before = 0;  ///< of the runs that this one goes on from
    double seconds_before     = 0.; ///< of the runs that this one goes on from
    Measurement now;
    std::vector<double> probes_now; ///< the row of probes.csv
    State before;                   ///< the present step; counts where it is observed
    double error_estimate = 0.;     ///< sum of the local errors [m]
    Vector start_displacement;
    double largest_energy = 0.; ///< kinetic and elastic, so far [J]
    double largest_motion = 0.; ///< of a vertex from its place at the start, so far [m]
    double setup_seconds  = 0.;
    double run_seconds    = 0.; ///< without those of the second run
  };
} // namespace Supple

#endif
