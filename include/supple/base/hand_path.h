#ifndef supple_hand_path_h
#define supple_hand_path_h

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <memory>

namespace Supple
{
  /**
   * The place of something that a hand moves, in time: it goes straight to each new place and rests
   * there. Only the last way is kept, so that times before it have the place at its start.
   */
  class HandPath
  {
  public:
    /** @param place [m] @param time at which the hand takes it [s] */
    HandPath(const dealii::Tensor<1, 3> &place, const double time)
      : begin(time)
      , from(place)
      , to(place)
      , start(time)
    {
    }

    /** Goes from where it is at @p time [s] to @p place [m] within a @p duration [s] above 0. */
    void
    move(const dealii::Tensor<1, 3> &place, const double time, const double duration)
    {
      from  = at(time);
      to    = place;
      start = time;
      span  = duration;
    }

    /** Its place at a time [m]. */
    dealii::Tensor<1, 3>
    at(const double time) const
    {
      const double part = span > 0. ? std::clamp((time - start) / span, 0., 1.) : 1.;
      return part == 1. ? to : (1. - part) * from + part * to;
    }

    /** Where it rests, or goes to [m]. */
    const dealii::Tensor<1, 3> &
    goal() const
    {
      return to;
    }

    const double begin; ///< from when on the hand has it [s]

  private:
    dealii::Tensor<1, 3> from, to;
    double start, span = 0.;
  };


  using SharedHandPath = std::shared_ptr<const HandPath>;
} // namespace Supple

#endif
