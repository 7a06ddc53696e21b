#ifndef supple_identification_fit_h
#define supple_identification_fit_h

#include <supple/layered_model.h>

#include <functional>

namespace Supple
{
  /** Where a function of the pair is least, and where it is nearly so. */
  struct FitResult
  {
    LayerPair pair;
    double value;
    LayerPair lowest, highest; ///< of all pairs whose value is within the tolerance
  };


  /**
   * The least value of a function by BOBYQA (Powell 2009, in NLopt) and the extent of the set where
   * it is at most 1 + tolerance times that: how far one of thickness and logarithm of the ratio
   * goes until the least value over the other passes that limit. No derivatives are needed.
   * @param start   inside the bounds
   * @param lowest  bounds of the search
   * @param highest
   * @throws ComputationError
   */
  FitResult
  fit_pair(const std::function<double(const LayerPair &)> &function,
           const LayerPair &start,
           const LayerPair &lowest,
           const LayerPair &highest,
           double tolerance);
} // namespace Supple

#endif
