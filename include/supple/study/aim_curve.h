#ifndef supple_aim_curve_h
#define supple_aim_curve_h

#include <optional>
#include <vector>

namespace Supple
{
  /**
   * Error and run time of one method in time against its step or tolerance x, as far as they are
   * known from some runs, and where on this curve an aim is met soonest:
   *
   *   error ~ x^s,   seconds ~ error^(-1/p),
   *
   * with the order p, s = p for steps and s = p / (p + 1) for the tolerance of a step; s is
   * corrected by what two runs show.
   */
  class AimCurve
  {
  public:
    /** A run that takes this many times as long as the best one is stopped; one that is expected to
     * is not begun. */
    static constexpr double patience = 1.3;

    struct Trial
    {
      double x;       ///< step [s] or tolerance
      double error;   ///< relative; not a number where the run failed
      double seconds; ///< run time
    };

    AimCurve(unsigned int order, bool variable_steps);

    void
    add(const Trial &trial);

    /** The soonest of those that meet the aim; null if there is none. */
    const Trial *
    best(double aim) const;

    /** x of the next run, somewhat below the aim; none if the best one is close to it already, or
     * if nothing more can be expected. */
    std::optional<double>
    next(double aim) const;

    /** What a run that just meets the aim will take [s]; not a number where nothing is known. */
    double
    expected_seconds(double aim) const;

    /** How many times the run time half the error takes. */
    double
    price_of_half() const;

    const std::vector<Trial> &
    all() const
    {
      return trials;
    }

  private:
    /** s, from two runs if they tell. */
    double
    exponent() const;

    /** The run whose error is next to the aim; null if none has one. */
    const Trial *
    nearest(double aim) const;

    double order;
    double nominal; ///< s
    std::vector<Trial> trials;
  };
} // namespace Supple

#endif
