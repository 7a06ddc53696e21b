#ifndef supple_space_estimate_h
#define supple_space_estimate_h

#include <supple/observe/probe_errors.h>
#include <supple/run/listener.h>
#include <supple/run/space_error_tools.h>
#include <supple/time/time_integrator.h>

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace Supple
{
  /** What is known of the error in space of a state, as numbers and in words. */
  struct SpaceErrors
  {
    /** What the error of the energy is an error of. */
    enum class Of
    {
      work,   ///< of given loads
      forces, ///< at given displacements
      stress, ///< in the mean square: with loads and displacements given, errors of the energy
              ///< cancel
      swing
    };

    double time = 0.; ///< of the state [s]; the load factor of a static problem
    Of of       = Of::swing;
    EnergyError energy;
    EnergyError over_run; ///< sums over instants of the run, of which the state is the last
    std::optional<ProbeError> work; ///< by a dual solution, of nonlinear bodies under loads
    std::string unknown; ///< why the numbers of the energy mean nothing; empty if they do
    std::vector<ProbeError> probes;
    std::string probes_unknown; ///< why there are none, where there should be some

    /** "in space about 45 % of tip.uz (mesh)" */
    std::string
    in_words() const;

    /** What the user should know, in sentences. */
    std::vector<std::string>
    warnings() const;

    nlohmann::ordered_json
    to_json() const;

    /** What the work of the loads lacks of the right one. */
    double
    of_work() const
    {
      return work ? std::abs(work->relative()) : energy.of_work();
    }

  private:
    /** The error of the energy in words. */
    std::string
    of_energy_in_words() const;
  };


  /** Estimates the error in space of the last state and, if asked for, of each that gets a frame.
   */
  class SpaceEstimate : public Listener
  {
  public:
    /** @param frame_due whether a state gets a frame */
    SpaceEstimate(Problem &problem,
                  const TimeIntegrator &integrator,
                  const Probes &probes,
                  const std::function<bool(const Measurement &)> &frame_due);

    void
    begin(const Observation &now, bool resumed) override;

    bool
    after_step(const Observation &now) override;

    /** Of the last state; nothing if the run did not come to its end. */
    const std::optional<SpaceErrors> &
    at_the_end() const
    {
      return last;
    }

    /** EnergyError::of_work() after a step; not a number where it was not estimated. */
    double
    of_work_after(unsigned int step) const;

    /** For the frames. */
    const CellErrors &
    of_cells() const
    {
      return cell_errors;
    }

    double seconds = 0.; ///< that it took

  private:
    SpaceErrors
    estimate(const Observation &now);

    /** Whether a state of a motion is one of those over which the error of its swings is told: some
     * eight over the run, and one in fifty steps at most, so that they cost little. */
    bool
    is_time_to_look(const Measurement &now);

    /** What the error of the energy is an error of. */
    SpaceErrors::Of
    kind_of_error() const;

    /** Whether anything is held elsewhere than at its place at rest; collective. */
    bool
    body_is_moved() const;

    /** Why there can be no estimate by the energy; empty if there can. */
    std::string
    obstacle(const EnergyError &energy, double kinetic) const;

    /** Adds the errors of probes to those of a state in equilibrium. */
    void
    add_probes(SpaceErrors &errors);

    Problem &problem;
    const TimeIntegrator &integrator;
    const Probes &probes;
    const std::function<bool(const Measurement &)> frame_due;
    std::unique_ptr<SpaceErrorTools> tools; ///< from the first estimate on
    Vector loads;                           ///< at the time of the state [N]
    std::optional<SpaceErrors> last;
    CellErrors cell_errors;
    double of_work = std::numeric_limits<double>::quiet_NaN(); ///< of that state
    EnergyError over_run;                                      ///< sums so far
    double next_look          = 0.;                            ///< [s]
    unsigned int step_of_look = 0;
    double most_kinetic = 0., most_elastic = 0.; ///< energies so far [J]
  };
} // namespace Supple

#endif
