#ifndef supple_skipped_pulses_h
#define supple_skipped_pulses_h

#include <supple/run/listener.h>
#include <supple/run/time_dependence.h>

#include <string>
#include <vector>

namespace Supple
{
  /**
   * Looks at the loads and prescribed motions that depend on time between the ends of each step,
   * where a method may not have asked for them: a pulse there leaves no trace in the motion, nor in
   * an estimate of the error.
   */
  class SkippedPulses : public Listener
  {
  public:
    /** @param steps those of the run, must outlive this
     * @param box of the body, at a few points of which expressions of the place are taken */
    SkippedPulses(const Parameters &parameters,
                  const TimeParameters &steps,
                  const dealii::BoundingBox<3> &box);

    void
    begin(const Observation &now, bool resumed) override;

    bool
    after_step(const Observation &now) override;

    std::string
    name() const override;

    nlohmann::json
    save() const override;

    void
    load(const nlohmann::json &saved) override;

    /** A sentence for each load or motion that rises and falls, or falls and rises, within one step
     * by more than a quarter of all that it did in the run. */
    std::vector<std::string>
    warnings() const;

  private:
    /** One component of a load or motion. */
    struct Course
    {
      TimeDependence of;
      double lowest, highest;    ///< in the run so far
      double excess = 0.;        ///< the most by which it left the range of its values at both ends
      double from = 0., to = 0.; ///< the step in which it did [s]
    };

    /** Where to look at it: on a grid between the ends, at its instants and amid them. */
    static std::vector<double>
    times_between(double from, double to, const std::vector<double> &instants);

    void
    look(Course &course, double from, double to) const;

    const TimeParameters &steps;

    std::vector<Course> courses;
    double time = 0.; ///< up to which they were looked at [s]
  };
} // namespace Supple

#endif
