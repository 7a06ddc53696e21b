#ifndef supple_diagnostics_h
#define supple_diagnostics_h

#include <supple/forces/forces.h>
#include <supple/mechanics/body.h>
#include <supple/observe/measurement.h>
#include <supple/time/step_report.h>

#include <nlohmann/json_fwd.hpp>

namespace Supple
{
  /** How far the body is from its shape at rest: the largest distance of a vertex from it when it
   * is turned and shifted to fit best, in the mean square over all vertices (Kabsch 1976); about an
   * axis it is shifted alone [m]. */
  double
  distance_from_shape(const Body &body, const Vector &displacement);


  /**
   * Energies, momenta and volumes of the body. In a dynamic problem
   *   total + dissipated + rubbed - work
   * stays what it was at the start, up to the tolerance of the linear solver: dissipated is found
   * from what each step expended, not from this balance. It grows all the time with linear and
   * polar rotations.
   */
  class Diagnostics
  {
  public:
    Diagnostics(const Configuration &configuration, const Forces &forces, bool stationary);

    /** To be called once per step, with the rotations of the displacement. What is no finite number
     * is given back, but not kept. */
    Measurement
    measure(unsigned int step, double time, double seconds, const StepReport &report);

    /** What a checkpoint has to keep of it. */
    nlohmann::json
    save() const;

    void
    load(const nlohmann::json &saved);

    /** Books as work what a change of the scene at a time [s] has done to the energies of the
     * state, of which load() has those before. Collective. */
    void
    book_change(double time);

    const Extremes &
    extremes() const
    {
      return worst;
    }

  private:
    /** Energies, momenta and volumes; neither dissipated nor work.
     * @param momentum M v, or null if it must be computed */
    Measurement
    measure_body(double time, const Vector *momentum) const;

    /** Completes the energy of the barrier by what tools meet, and what they have done. */
    void
    measure_contact(Measurement::Contact &now, const StepReport &report) const;

    void
    note_contact(const Measurement::Contact &contact);

    void
    note_extremes(const Measurement &measurement, double rise);

    const Configuration &configuration;
    const Forces &forces;
    const bool stationary;
    Extremes worst;
    double largest_energy  = 0.;
    bool first             = true;
    double elastic         = 0.;
    double total           = 0.;
    double dissipated      = 0.;
    double most_dissipated = 0.; ///< so far
    double work            = 0.;
    Measurement::Contact contact; ///< of the last step
  };
} // namespace Supple

#endif
