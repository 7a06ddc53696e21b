#include <supple/identification/identification_fit.h>

#include <supple/base/error.h>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <nlopt.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <tuple>

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
     * around where it was last, at some places and then by Brent's method around the best of them,
     * for there may be several minima: deviations have kinks where a point passes a vertex.
     * @param point its free coordinate is set to where the least value is
     */
    double
    least_value(Objective &function, std::vector<double> &point, const unsigned int fixed)
    {
      constexpr double reach = 0.1; // of the square's side
      constexpr int n_places = 3;   // on each side
      constexpr int bits     = 7;   // of the accuracy of the distance between them

      const unsigned int free = 1 - fixed;
      const auto value_at     = [&](const double x) {
        point[free] = x;
        return function(point);
      };
      const double last = point[free];
      double place = last, value = value_at(last);
      for (int k = -n_places; k <= n_places; ++k)
        {
          const double x = last + k * reach / n_places;
          if (k == 0 || x < 0. || x > 1.)
            continue;
          const double other = value_at(x);
          if (other < value)
            {
              value = other;
              place = x;
            }
        }
      const auto found =
        boost::math::tools::brent_find_minima(value_at,
                                              std::max(0., place - reach / n_places),
                                              std::min(1., place + reach / n_places),
                                              bits);
      if (found.second < value)
        std::tie(place, value) = found;
      point[free] = place;
      return value;
    }


    /** A point of the unit square, and the value there. */
    struct Place
    {
      std::vector<double> point;
      double value;
    };


    /**
     * How far one coordinate goes in a direction until the least value over the other one passes a
     * limit: along the valley in growing steps, then between the last two by TOMS 748.
     */
    Place
    farthest(Objective &function,
             const double limit,
             const Place &start,
             const unsigned int direction,
             const bool upward)
    {
      constexpr double first_step = 0.01, longest_step = 0.05, accuracy = 1e-4, at_limit = 1e-3;

      const double end = upward ? 1. : 0.;
      Place inside     = start;
      const auto go_to = [&](const double coordinate) {
        std::vector<double> point = inside.point;
        point[direction]          = coordinate;
        const double value        = least_value(function, point, direction);
        return Place{point, value};
      };
      Place outside = inside;
      for (double step = first_step; outside.value <= limit;
           step        = std::min(2. * step, longest_step))
        {
                 inside = outside;
                 if (inside.point[direction] == end)
            return inside;
          outside = go_to(std::clamp(inside.point[direction] + (upward ? step : -step), 0., 1.));
        }

      const auto excess = [&](const double coordinate) {
        const Place place = go_to(coordinate);
        const bool near   = std::abs(place.value - limit) <= at_limit * limit;
        if (near || place.value <= limit)
          inside = place;
        return near ? 0. : place.value - limit;
      };
      const auto [first, last] = upward ? std::tie(inside, outside) : std::tie(outside, inside);
      boost::uintmax_t n_most  = 12;
      boost::math::tools::toms748_solve(
        excess,
        double(first.point[direction]),
        double(last.point[direction]),
        first.value - limit,
        last.value - limit,
        [](const double a, const double b) { return b - a < accuracy; },
        n_most);
      return inside;
    }


    /** The least value from a start on, and how far values reach that are not much larger. */
    FitResult
    search(Objective &objective,
           const UnitSquare &square,
           const std::vector<double> &start,
           const double tolerance)
    {
      nlopt::opt opt = optimizer(nlopt::LN_BOBYQA, 0.1, 1e-4);
      opt.set_min_objective(evaluate, &objective);
      Place best{start, 0.};
      for (double &x : best.point)
        x = std::clamp(x, 0., 1.);
      opt.optimize(best.point, best.value);

      const auto as_pair = [&](const Place &place) {
        return FitPoint{square.pair(place.point), place.value};
      };
      const auto end = [&](const unsigned int direction, const bool upward) {
        return as_pair(farthest(objective, (1. + tolerance) * best.value, best, direction, upward));
      };
      return {as_pair(best), end(0, false), end(0, true), end(1, false), end(1, true)};
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
    FitResult result;
    Place least{square.point(start), std::numeric_limits<double>::infinity()}; // so far
    std::exception_ptr failure; // does not find its way through NLopt
    Objective objective = [&](const std::vector<double> &point) {
      try
        {
          const double value = function(square.pair(point));
          if (value < least.value)
            least = {point, value};
          return value;
        }
      catch (...)
        {
          failure = std::current_exception();
          throw nlopt::forced_stop();
        }
    };
    try
      {
        // The search along the valley may find a better minimum than the optimizer did.
        constexpr int most_searches = 4;
        constexpr double better     = 1. - 1e-4;
        for (int n = 0; n < most_searches && (n == 0 || least.value < better * result.best.value);
             ++n)
          result = search(objective, square, least.point, tolerance);
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
