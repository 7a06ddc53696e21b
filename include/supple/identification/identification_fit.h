#ifndef supple_identification_fit_h
#define supple_identification_fit_h


#include <functional>

namespace Supple
{
  /** Thickness of the upper layer [m], and its Young modulus over that of the lower one. */
  struct LayerPair
  {
    double thickness;
    double ratio;
  };


  /** A pair, and the value of the function there. */
  struct FitPoint
  {
    LayerPair pair;
    double value;
  };


  /** Where a function of the pair is least, and where it is nearly so. */
  struct FitResult
  {
    FitPoint best;
    /** Of all pairs whose value is within the tolerance those of least and greatest thickness, and
     * of least and greatest ratio. */
    FitPoint thinnest, thickest, softest, hardest;
  };


  /**
   * The least value of a function by BOBYQA (Powell 2009, in NLopt) and the extent of the set where
   * it is at most 1 + tolerance times that: how far one of thickness and logarithm of the ratio
   * goes until the least value over the other passes that limit. At such an end the value is at the
   * limit to a thousandth of it, or below where the bounds come first. No derivatives are needed.
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
