#ifndef supple_time_dependence_h
#define supple_time_dependence_h

#include <supple/base/expression.h>
#include <supple/scene/parameters.h>

#include <deal.II/base/bounding_box.h>

#include <string>
#include <vector>

namespace Supple
{
  /** One component of a load or prescribed motion that depends on time. */
  struct TimeDependence
  {
    std::string entry, text; ///< what sets it, and as what
    Expression value;
    std::vector<dealii::Point<3>> points; ///< at which its values may differ
    std::vector<double> numbers;          ///< in its text, perhaps times [s], ascending
  };


  /** All of a dynamic scene. @param box of the body */
  std::vector<TimeDependence>
  time_dependences(const Parameters &parameters, const dealii::BoundingBox<3> &box);


  /**
   * The times [s] after the start and before the end at which one of these jumps, or bends at a
   * number of its text (or a quotient or sum of two of them): ascending.
   *
   * Jumps are looked for by bisection between 2000 times, and beside these numbers; a pulse that is
   * shorter, and whose ends are no such numbers, is not found.
   */
  std::vector<double>
  instants_of(const std::vector<TimeDependence> &dependences, double end);


  /** The parameters of time of a scene, with what its loads, motions and frames ask of variable
   * steps. */
  TimeParameters
  time_with_instants(const Parameters &parameters, const dealii::BoundingBox<3> &box);
} // namespace Supple

#endif
