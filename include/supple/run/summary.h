#ifndef supple_summary_h
#define supple_summary_h

#include <supple/mesh/refinement_parameters.h>
#include <supple/observe/measurement.h>
#include <supple/run/second_mesh.h>
#include <supple/run/space_estimate.h>
#include <supple/run/step_doubling.h>
#include <supple/time/model.h>
#include <supple/time/stable_step.h>

#include <nlohmann/json_fwd.hpp>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /** What summary.json tells of a run. */
  struct Summary
  {
    /** The body, and what the processes share. */
    struct Size
    {
      unsigned int cells    = 0;
      unsigned int vertices = 0;
      unsigned int dofs     = 0;
      unsigned int held     = 0; ///< degrees of freedom
      unsigned int ranks    = 1;
      unsigned int threads  = 1;  ///< of the process with most
      double volume         = 0.; ///< [m^3]
      double cell_size      = 0.; ///< cube root of the volume per cell, or root of the area [m]
      double diameter       = 0.; ///< [m]
    };

    struct Solver
    {
      std::string name, reason;
      std::string stand_in; ///< empty if there is none
      double tolerance = 0.;
    };

    /** How evenly the work is spread over several processes. */
    struct Spread
    {
      using Range = dealii::Utilities::MPI::MinMaxAvg;

      Range cells, ghost_vertices;
      std::vector<std::pair<unsigned int, Range>> coarse_levels; ///< nodes of all, and of a process
      std::vector<Range> seconds;                                ///< of each phase
    };

    /** Gathers what is known without the course of the run, at its end; collective. */
    Summary(const Parameters &parameters, const Model &model);

    nlohmann::ordered_json
    to_json() const;

    /** All numbers of summary.json by their place in it, such as "solver/solves". */
    std::map<std::string, double>
    numbers() const;

    std::string scene;
    std::string status; ///< done, interrupted or failed: why
    std::vector<std::string> warnings;
    Size size;
    Solver solver;
    Effort effort;
    std::optional<Spread> spread; ///< of several processes
    bool has_mass             = false;
    unsigned int tools        = 0; ///< that may touch the body
    bool damped               = false;
    double distance_from_rest = 0.; ///< of the vertex that is farthest from its place at rest [m]
    double distance_from_shape =
      0.; ///< the same, from the body at rest that is shifted and turned [m]

    std::string integrator;
    std::optional<StableStep> stable_step; ///< of an explicit method
    unsigned int steps                = 0;
    double setup_seconds              = 0.;
    double run_seconds                = 0.;
    double estimate_seconds           = 0.;      ///< of the error in space, not in run_seconds
    double error_estimate             = 0.;      ///< [m]
    bool local_errors_add_up          = true;    ///< to about the error of the run
    double largest_motion             = 0.;      ///< of a vertex from its place at the start [m]
    const StepDoubling *step_doubling = nullptr; ///< if there is a second run
    const SecondMesh *second_mesh     = nullptr; ///< if there is one
    std::optional<SpaceErrors> space_errors;     ///< if they were estimated

    /** What the steps of an undamped motion have taken of its energy; 0 where that is not known. */
    double
    energy_lost_by_steps() const
    {
      return has_mass && has_energy && !damped && observed && extremes.motion_energy > 0.
               ? std::max(0., last.dissipated / extremes.motion_energy)
               : 0.;
    }

    /** Cells lock, as far as that is known. */
    bool
    cells_lock() const
    {
      return space_errors && space_errors->energy.locks();
    }

    std::vector<RefinementParameters::Pilot> pilots; ///< runs that refined the mesh
    unsigned int frames = 0;
    bool history        = false;
    bool probes         = false;
    bool observed       = false; ///< whether energies were measured
    bool has_energy     = true;  ///< the elastic forces have one
    Measurement last;
    Extremes extremes;
  };
} // namespace Supple

#endif
