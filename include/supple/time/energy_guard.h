#ifndef supple_energy_guard_h
#define supple_energy_guard_h

#include <supple/time/time_integrator.h>

namespace Supple
{
  /** Detects steps in which the total energy of the body rises by more than the work of the step,
   * StepReport::load_work. */
  class EnergyGuard
  {
  public:
    explicit EnergyGuard(const Model &model);

    /** Where the energy is counted from: the configuration at this time, with its rotations. */
    void
    start(double time, const Vector &momentum);

    /** Whether it has risen in a step, by more than the work of the loads and round-off. */
    bool
    rises(const StepReport &report);

    /** The last configuration that was looked at becomes the start. */
    void
    accept();

  private:
    /** Kinetic, elastic and potential [J]. */
    double
    energy(double time, const Vector &momentum) const;

    const Model model;
    double first   = 0.; ///< at the start [J]
    double last    = 0.; ///< of the configuration that was looked at last [J]
    double largest = 0.; ///< size of the energies so far [J]
  };
} // namespace Supple

#endif
