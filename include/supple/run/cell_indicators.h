#ifndef supple_cell_indicators_h
#define supple_cell_indicators_h

#include <supple/run/listener.h>
#include <supple/run/space_error_tools.h>
#include <supple/time/time_integrator.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace Supple
{
  /**
   * Follows a pilot run and finds which cells have most of its error in space: of the energy, by
   * eta_e^2 of SpaceError, the largest at some times over the run; or of a probe in equilibrium, by
   * the weights of ProbeErrors in the last state.
   */
  class CellIndicators : public Listener
  {
  public:
    /** @param quantity "energy" or the name of a component of a probe's displacement; empty: of the
     * component of a probe that moves most, or of the energy if there is no probe
     * @throws InputError if the run has no error of that kind */
    CellIndicators(Problem &problem,
                   const TimeIntegrator &integrator,
                   const Probes &probes,
                   const std::string &quantity);

    bool
    after_step(const Observation &now) override;

    /** Relative error of the quantity in the last state; not a number if it is unknown. */
    double
    error() const
    {
      return relative_error;
    }

    /** The quantity; not empty after the run. */
    const std::string &
    of() const
    {
      return quantity;
    }

    /**
     * The cells with half of the error, those with most of it first (Doerfler 1996), and those that
     * have as much as the last of them, so that the choice does not depend on round-off. On the
     * first process, by their numbers in the whole mesh; collective.
     * @throws ComputationError if no cell has an error
     */
    std::vector<unsigned int>
    cells_to_cut() const;

  private:
    /** @throws InputError */
    void
    require_quantity() const;

    /** Of a state. @throws ComputationError if it has no error that means anything */
    void
    look(bool last);

    /** Sets the indicators and the error by a dual solution. @throws InputError if the component is
     * held or does not move, ComputationError */
    void
    look_at_probe();

    /** Sets the error of the energy of a static scene, if there is one. */
    void
    look_at_energy(const EnergyError &energy);

    /** Indicators of all cells by their numbers in the whole mesh, on the first process. */
    std::vector<double>
    gather() const;

    Problem &problem;
    const TimeIntegrator &integrator;
    const Probes &probes;
    std::string quantity;
    std::unique_ptr<SpaceErrorTools> tools; ///< from the first look on
    double next_time      = 0.;             ///< of a look [s]
    double relative_error = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> indicators; ///< of the cells of the body
  };
} // namespace Supple

#endif
