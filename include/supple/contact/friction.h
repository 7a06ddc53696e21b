#ifndef supple_friction_h
#define supple_friction_h

#include <supple/contact/contact_pairs.h>

#include <functional>
#include <vector>

namespace Supple
{
  /**
   * Coulomb's friction of a step, made smooth (Li et al., ACM Trans. Graphics 39 (2020) 49): where
   * the surface touched a tool or itself at its start, the slip s is how far both sides have moved
   * along each other since. With the slip resolution v of a step dt, h = v dt and y = |s|,
   *
   *   D = sum mu lambda f0(y),   f0 = y^2/h - y^3/(3 h^2) + h/3 for y < h, or else y,
   *
   * is a potential of the friction -mu lambda f0'(y) s/y, with normal forces lambda and normals of
   * the start of the step.
   */
  class Friction
  {
  public:
    /** @param coefficients mu of each tool, and last that between bodies
     * @param slip_resolution v [m/s] */
    Friction(const std::vector<double> &coefficients, double slip_resolution);

    /** Whether there is any. */
    bool
    any() const;

    /** Whether there were touches on this process at the start of the step. */
    bool
    acts() const
    {
      return !touches.empty();
    }

    /** Where surface and tools touch at the start of a step, with the forces [N]. */
    using Touches = std::vector<std::pair<ContactPair, double>>;

    /** Begins a step. @param surface_places of the touches [m] */
    void
    begin_step(const Touches &touches, const std::vector<Arrow> &surface_places);

    /** How a place of a touch has moved so far. */
    struct Slip
    {
      const ContactPair *pair; ///< at the start of the step
      double limit;            ///< mu lambda [N]
      Arrow start;             ///< where it touched at the start of the step [m]
      Arrow way;               ///< s [m]
      double resolution;       ///< h [m]

      /** D [J] */
      double
      potential() const;

      /** On the surface [N]. */
      Arrow
      force() const;

      /** Minus the derivative of the force by the place on the surface [N/m]: definite. */
      dealii::Tensor<2, 3>
      stiffness() const;

      /** What has become heat [J]. */
      double
      heat() const;

    private:
      /** mu lambda f0'/y [N/m] */
      double
      secant() const;
    };

    /** Of a pair, now: sum c_i x_i, and where what was at a place of the other side is [m]. */
    using Places = std::function<std::pair<Arrow, Arrow>(const ContactPair &, const Arrow &)>;

    /** Slips now. @param duration since the start of the step [s] */
    std::vector<Slip>
    slips(const Places &places, double duration) const;

    const double slip_resolution; ///< v [m/s]

  private:
    struct Touch
    {
      ContactPair pair;
      double limit;
      Arrow place; ///< on the surface at the start of the step [m]
    };

    const std::vector<double> coefficients;
    std::vector<Touch> touches;
  };
} // namespace Supple

#endif
