#ifndef supple_diagnostics_h
#define supple_diagnostics_h

#include <supple/time/time_integrator.h>

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <string>
#include <vector>

namespace Supple
{
  /** One row of history.csv. */
  struct Measurement
  {
    unsigned int step = 0;
    double time       = 0.; ///< [s]; the load factor of a static problem
    double dt         = 0.;

    double kinetic    = 0.; ///< [J]
    double elastic    = 0.; ///< [J]
    double potential  = 0.; ///< of gravity [J], zero at rest position
    double dissipated = 0.; ///< by damping and by the time stepping since the start [J]
    double total      = 0.; ///< kinetic + elastic + potential [J]
    double work       = 0.; ///< of the body force since the start [J]

    std::array<double, 3> linear_momentum{{}};  ///< [kg m/s]
    std::array<double, 3> angular_momentum{{}}; ///< [kg m^2/s]

    double min_volume_ratio        = 1.;
    double max_volume_ratio        = 1.;
    unsigned int inverted          = 0;
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;
    double seconds                 = 0.; ///< since the start of the run

    static std::vector<std::string>
    column_names();

    std::vector<double>
    row() const;

    /** What is no finite number, as "kinetic, total"; empty where all are. */
    std::string
    not_finite() const;
  };


  /** The worst of a run. */
  struct Extremes
  {
    unsigned int energy_rises  = 0;  ///< steps in which the total energy rose by more than the work
    double energy_risen        = 0.; ///< in these steps together [J]
    unsigned int most_inverted = 0;  ///< cells
    double min_volume_ratio    = 1.;
    double max_volume_ratio    = 1.;
    unsigned int not_finite =
      0; ///< measurements with something that is none; a run ends at the first
  };


  /** How far the body is from its shape at rest: the largest distance of a vertex from it when it
   * is turned and shifted to fit best, in the mean square over all vertices (Kabsch 1976); about an
   * axis it is shifted alone [m]. */
  double
  distance_from_shape(const Body &body, const Vector &displacement);


  /**
   * Energies, momenta and volumes of the body. In a dynamic problem
   *   total + dissipated - work
   * stays what it was at the start, up to the tolerance of the linear solver: dissipated is found
   * from what each step expended, not from this balance. It grows all the time with linear and
   * polar rotations.
   */
  class Diagnostics
  {
  public:
    Diagnostics(const Body &body, const Loads &loads, bool stationary);

    /** To be called once per step, with the rotations of @p state. What is no finite number is
     * given back, but not kept. */
    Measurement
    measure(unsigned int step,
            double time,
            double seconds,
            const State &state,
            const StepReport &report);

    /** What a checkpoint has to keep of it. */
    nlohmann::json
    save() const;

    void
    load(const nlohmann::json &saved);

    const Extremes &
    extremes() const
    {
      return worst;
    }

  private:
    /** Energies, momenta and volumes; neither dissipated nor work. */
    Measurement
    measure_body(const State &state, double load_factor) const;

    void
    note_extremes(const Measurement &measurement, double rise);

    const Body &body;
    const Loads &loads;
    const bool stationary;
    Extremes worst;
    double largest_energy = 0.;
    bool first            = true;
    double elastic        = 0.;
    double total          = 0.;
    double dissipated     = 0.;
    double work           = 0.;
  };
} // namespace Supple

#endif
