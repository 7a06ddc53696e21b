#include <supple/error.h>
#include <supple/identification_fit.h>

#include <boost/math/tools/minima.hpp>

#include <nlopt.hpp>

#include <algorithm>
#include <cmath>
#include <exception>

namespace Supple
{
  namespace
  {
    using Objective = std::function<double(const std::vector<double> &)>;


    /** The signature that NLopt calls; no gradient is asked for. */
    double
    evaluate(const std::vector<double> &point, std::vector<double> &, void *objective)
    {
      return (*static_cast<Objective *>(objective))(point);
    }


    /** Thickness and ratio as a point of the unit square. */
    class UnitSquare
    {
    public:
      UnitSquare(const LayerPair &lowest, const LayerPair &highest)
        : lowest(lowest)
        , highest(highest)
      {
      }

      std::vector<double>
      point(const LayerPair &pair) const
      {
        return {(pair.thickness - lowest.thickness) / (highest.thickness - lowest.thickness),
                std::log(pair.ratio / lowest.ratio) / std::log(highest.ratio / lowest.ratio)};
      }

      LayerPair
      pair(const std::vector<double> &point) const
      {
        return {lowest.thickness + point[0] * (highest.thickness - lowest.thickness),
                lowest.ratio * std::pow(highest.ratio / lowest.ratio, point[1])};
      }

    private:
      const LayerPair lowest, highest;
    };


    nlopt::opt
    optimizer(const nlopt::algorithm algorithm, const double step, const double accuracy)
    {
      nlopt::opt opt(algorithm, 2);
      opt.set_lower_bounds(0.);
      opt.set_upper_bounds(1.);
      opt.set_initial_step(step);
      opt.set_xtol_abs(accuracy);
      opt.set_maxeval(300);
      return opt;
    }


    /**
     * Least value along one coordinate of the unit square, where the other one is fixed: looked for
     * by Brent's method around where it was last.
     * @param point its free coordinate is set to where the least value is
     */
    double
    least_value(Objective &function, std::vector<double> &point, const unsigned int fixed)
    {
      constexpr double reach = 0.1; // of the square's side
      constexpr int bits     = 9;   // of the accuracy of that

      const unsigned int free   = 1 - fixed;
      const double last         = point[free];
      const auto [place, value] = boost::math::tools::brent_find_minima(
        [&](const double x) {
          point[free] = x;
          return function(point);
        },
        std::max(0., last - reach),
        std::min(1., last + reach),
        bits);
      point[free] = place;
      return value;
    }


    /**
     * How far one coordinate goes in a direction until the least value over the other one passes a
     * limit: along the valley in growing steps, then back in halves.
     */
    double
    farthest(Objective &function,
             const double limit,
             std::vector<double> point,
             const unsigned int direction,
             const bool upward)
    {
      constexpr double first_step = 0.01, longest_step = 0.05, accuracy = 2e-3;

      const double end = upward ? 1. : 0.;
      bool passed      = false;
      for (double step = first_step; step > accuracy && point[direction] != end;)
        {
          std::vector<double> next = point;
          next[direction]          = std::clamp(point[direction] + (upward ? step : -step), 0., 1.);
          if (least_value(function, next, direction) <= limit)
            point = next;
          else
            passed = true;
          step = passed ? 0.5 * step : std::min(2. * step, longest_step);
        }
      return point[direction];
    }
  } // namespace


  FitResult
  fit_pair(const std::function<double(const LayerPair &)> &function,
           const LayerPair &start,
           const LayerPair &lowest,
           const LayerPair &highest,
           const double tolerance)
  {
    const UnitSquare square(lowest, highest);
    FitResult result{start, 0., {}, {}};
    std::exception_ptr failure; // does not find its way through NLopt
    Objective objective = [&](const std::vector<double> &point) {
      try
        {
          return function(square.pair(point));
        }
      catch (...)
        {
          failure = std::current_exception();
          throw nlopt::forced_stop();
        }
    };
    try
      {
        nlopt::opt opt = optimizer(nlopt::LN_BOBYQA, 0.1, 1e-4);
        opt.set_min_objective(evaluate, &objective);
        std::vector<double> best = square.point(start);
        for (double &x : best)
          x = std::clamp(x, 0., 1.);
        opt.optimize(best, result.value);
        result.pair = result.lowest = result.highest = square.pair(best);

        const double limit = (1. + tolerance) * result.value;
        for (const unsigned int direction : {0, 1})
          for (const bool upward : {false, true})
            {
              std::vector<double> end = best;
              end[direction]          = farthest(objective, limit, best, direction, upward);
              LayerPair &extent       = upward ? result.highest : result.lowest;
              (direction == 0 ? extent.thickness : extent.ratio) =
                direction == 0 ? square.pair(end).thickness : square.pair(end).ratio;
            }
      }
    catch (const std::exception &exception)
      {
        if (failure)
          std::rethrow_exception(failure);
        throw ComputationError(std::string("The search for the best pair failed: ") +
                               exception.what() + ".");
      }
    return result;
  }
} // namespace Supple
