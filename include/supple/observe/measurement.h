#ifndef supple_measurement_h
#define supple_measurement_h

#include <supple/contact/tool_report.h>

#include <array>
#include <optional>
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
    double total      = 0.; ///< kinetic + elastic + potential + that of contact [J]

    /** Of loads without a potential, of moved vertices and of the change of gravity in time, since
     * the start [J]. */
    double work = 0.;

    std::array<double, 3> linear_momentum{{}};  ///< [kg m/s]
    std::array<double, 3> angular_momentum{{}}; ///< [kg m^2/s]

    double min_volume_ratio        = 1.;
    double max_volume_ratio        = 1.;
    unsigned int inverted          = 0;
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;
    double seconds                 = 0.; ///< since the start of the run

    /** Of the tools that touch the body. */
    struct Contact
    {
      double energy  = 0.; ///< of the barrier, part of `total` [J]
      double rubbed  = 0.; ///< turned into heat by friction since the start [J]
      double min_gap = 0.; ///< the least to the core of a tool [m]; never 0 or less
      double creep   = 0.; ///< the greatest speed of a place that friction could hold [m/s]
      std::vector<ToolReport> tools;
    };

    std::optional<Contact> contact; ///< in scenes with tools

    /** @param with_contact whether there are tools */
    static std::vector<std::string>
    column_names(bool with_contact);

    std::vector<double>
    row() const;

    /** What is no finite number, as "kinetic, total"; empty where all are. */
    std::string
    not_finite() const;
  };


  /** The worst of a run. */
  struct Extremes
  {
    unsigned int energy_rises = 0;  ///< steps in which the total energy rose by more than the work
    double energy_risen       = 0.; ///< in these steps together [J]
    double energy_gained = 0.; ///< the largest fall of `dissipated` from what it was before [J]
    double motion_energy = 0.; ///< the largest sum of kinetic and elastic energy [J]
    unsigned int most_inverted = 0; ///< cells
    double min_volume_ratio    = 1.;
    double max_volume_ratio    = 1.;
    unsigned int not_finite    = 0; ///< measurements that are not finite: a run ends at the first
    unsigned int releases = 0; ///< steps in which the body leaves the last tool that it touched
    std::vector<double> gaps;  ///< the least of each tool [m]
  };
} // namespace Supple

#endif
