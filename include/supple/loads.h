#ifndef supple_loads_h
#define supple_loads_h

#include <supple/body.h>
#include <supple/expression.h>

namespace Supple
{
  /** What pushes the body: gravity and a body force, both independent of the deformation. */
  class Loads
  {
  public:
    Loads(const Body &body, const Parameters &parameters);

    /** The load vector [N] at a time [s]; held entries are not set to zero. Valid until the next
     * call. */
    const Vector &
    force(double time) const;

    /** The part of force() that is no gravity, and does work which potential() does not count. */
    const Vector &
    body_force(double time) const;

    bool
    has_body_force() const
    {
      return !expression.is_zero();
    }

    /** Potential energy of gravity [J], zero at rest position. */
    double
    potential(const Vector &displacement) const;

  private:
    void
    evaluate(double time) const;

    const Body &body;
    const Expression expression;
    Vector gravity;
    mutable Vector applied, total;
    mutable bool evaluated = false;
    mutable double evaluation_time;
  };
} // namespace Supple

#endif
