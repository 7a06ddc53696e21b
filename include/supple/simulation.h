#ifndef supple_simulation_h
#define supple_simulation_h

#include <supple/diagnostics.h>
#include <supple/frames.h>
#include <supple/probes.h>
#include <supple/progress.h>
#include <supple/tables.h>
#include <supple/time_integrator.h>

#include <chrono>
#include <memory>
#include <string>

namespace Supple
{
  /** One scene, from its parameters to its results. */
  class Simulation
  {
  public:
    /**
     * Builds all that the scene needs and validates it; writes nothing.
     * @param folder of the results
     * @param quiet  no words on the screen
     * @throws InputError
     */
    Simulation(const Parameters &scene,
               const std::string &folder,
               bool quiet,
               MPI_Comm communicator);

    /** @throws ComputationError with the step and the time, after all files are complete */
    void
    run();

    /** What would be run, as a table; in detail with what was found in the mesh. */
    void
    print_description(bool in_detail) const;

  private:
    /** What the integrator works with. */
    Model
    model();

    void
    create_initial_state();

    /** Sets the displacement of the rotation that the scene starts with. */
    void
    turn(Vector &displacement) const;

    void
    print_mesh_details() const;

    /** What the user should know, in sentences. */
    std::vector<std::string>
    warnings() const;

    /** A warning where the time stepping itself drives the motion, or nothing. */
    std::string
    energy_from_nowhere() const;

    void
    open_output();

    void
    time_loop();

    void
    advance();

    void
    record(const StepReport &report);

    /** Last frame and summary. */
    void
    finish(const std::string &status);

    double
    seconds_since_start() const;

    const Parameters parameters;
    const std::string folder;
    const MPI_Comm communicator;
    const bool stationary;
    const bool talks;  ///< this process writes on the screen
    const bool writes; ///< history or frames are wanted
    Effort effort;
    const std::chrono::steady_clock::time_point start;

    const Mesh mesh;
    const Body body;
    const Constraints constraints;
    const Loads loads;
    const Probes probes;
    ImplicitOperator implicit_operator;
    std::unique_ptr<LinearSolver> solver;
    State state;
    std::unique_ptr<TimeIntegrator> integrator;
    Diagnostics diagnostics;
    Progress progress;
    std::unique_ptr<CsvFile> history;
    std::unique_ptr<CsvFile> probe_history;
    std::unique_ptr<Frames> frames;

    unsigned int step = 0;
    Measurement now;
    double error_estimate = 0.; ///< sum of the local errors [m]
    Vector start_displacement;
    double largest_energy = 0.; ///< kinetic and elastic, so far [J]
    double largest_motion = 0.; ///< of a vertex from its place at the start, so far [m]
    double setup_seconds  = 0.;
  };
} // namespace Supple

#endif
