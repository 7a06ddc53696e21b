#include <supple/error.h>
#include <supple/identification_fit.h>

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


    /** As far as the function stays below a limit in one direction: the farthest point that was
     * seen to. COBYLA itself may end beyond the limit. */
    std::vector<double>
    farthest(Objective &function,
             const double limit,
             const std::vector<double> &start,
             const unsigned int direction,
             const bool upward)
    {
      Objective coordinate = [=](const std::vector<double> &x) {
        return upward ? -x[direction] : x[direction];
      };
      std::vector<double> reached = start;
      Objective excess            = [&](const std::vector<double> &x) {
        const double value = function(x);
        if (value <= limit && coordinate(x) < coordinate(reached))
          reached = x;
        return value / limit - 1.;
      };
      nlopt::opt opt = optimizer(nlopt::LN_COBYLA, 0.05, 1e-3);
      opt.set_min_objective(evaluate, &coordinate);
      opt.add_inequality_constraint(evaluate, &excess, 1e-4);
      std::vector<double> point = start;
      double value;
      opt.optimize(point, value);
      return reached;
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
    FitResult result{start, 0., {}, {}, 0};
    std::exception_ptr failure; // does not find its way through NLopt
    Objective objective = [&](const std::vector<double> &point) {
      try
        {
          ++result.n_values;
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
              const LayerPair end =
                square.pair(farthest(objective, limit, best, direction, upward));
              LayerPair &extent = upward ? result.highest : result.lowest;
              (direction == 0 ? extent.thickness : extent.ratio) =
                direction == 0 ? end.thickness : end.ratio;
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
