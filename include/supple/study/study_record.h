#ifndef supple_study_record_h
#define supple_study_record_h

#include <supple/linear_algebra/vector.h>
#include <supple/scene/parameters.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace Supple
{
  /** What a study keeps of a run: columns of history.csv and probes.csv over time, and its end. The
   * same on all processes. */
  class StudyRecord
  {
  public:
    enum class Status
    {
      done,
      failed, ///< the computation did not get to its end
      refused ///< the scene was found wrong before it began
    };

    Status status = Status::done;
    std::string reason;   ///< of a failure or refusal
    bool stopped = false; ///< for it took too long; then it counts as failed

    std::map<std::string, std::vector<double>> columns;
    Vector displacement;        ///< at the end
    double largest_motion = 0.; ///< of a vertex [m]
    double cell_size      = 0.; ///< cube root of the volume per cell, or root of the area [m]
    unsigned int n_cells  = 0;
    unsigned int steps    = 0;
    unsigned int rejected = 0;
    unsigned int failed   = 0;             ///< steps
    double end            = 0.;            ///< of the run [s]
    double seconds        = 0.;            ///< median of the timed runs
    std::map<std::string, double> summary; ///< numbers of summary.json, such as "solver/solves"
    std::vector<std::string> warnings;
    std::string space_error; ///< in words; empty where it is not known

    /** The names of the columns of history.csv and probes.csv that a scene gives. */
    static std::set<std::string>
    column_names(const Parameters &parameters);

    const std::vector<double> &
    column(const std::string &name) const
    {
      return columns.at(name);
    }

    /** Whether the run came to this time. */
    bool
    has(double time) const;

    /** A column between its rows: by cubic Hermite interpolation where it is the displacement of a
     * probe, whose velocity is kept, and linearly for all others. */
    double
    value(const std::string &name, double time) const;
  };


  /** The column with the velocity that belongs to a displacement "name.ux"; empty for others. */
  std::string
  rate_column(const std::string &name);
} // namespace Supple

#endif
