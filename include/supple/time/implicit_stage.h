#ifndef supple_implicit_stage_h
#define supple_implicit_stage_h

#include <supple/linear_algebra/vector.h>

namespace Supple
{
  /**
   * What a stage of an implicit method, or a load step, asks of the displacement u: that it makes
   *
   *   E(u) = |u - u^|_M^2 / (2 g^2) + W(u) + B(u) - f.u
   *
   * least, with g and u^ of the stage; without the first term in a static problem. It keeps the
   * configuration where the correction of Newton's method takes it.
   */
  class ImplicitStage
  {
  public:
    virtual ~ImplicitStage() = default;

    /** Computes residual() for the configuration as it is, with what is moved as its passage says.
     * @throws ComputationError */
    virtual void
    evaluate() = 0;

    /** -E' [N], zero where the body is held. */
    virtual const Vector &
    residual() const = 0;

    /** Prepares solve() for the configuration. @param definite whether the operator must be
     * @throws ComputationError */
    virtual void
    prepare(bool definite) = 0;

    /** Sets a correction of the displacement [m], E'' p = b. @throws ComputationError */
    virtual void
    solve(Vector &p, const Vector &b) = 0;

    /** b -= E'' w for a displacement w of held vertices alone [m]. */
    virtual void
    subtract_product(Vector &b, const Vector &w) = 0;

    /** Sets the way that inertia alone would take from here [m]. @return false in a static problem
     */
    virtual bool
    foresee(Vector &way) = 0;

    /** Keeps the configuration, for correct() to begin with. */
    virtual void
    keep() = 0;

    /** Takes the configuration to the one that was kept and this part of a correction. What is held
     * goes as the passage says. */
    virtual void
    correct(double part, const Vector &p) = 0;

    /** Whether residual() or the next correction is so small that the stage is done; collective. */
    virtual bool
    is_done(const Vector &p) const = 0;

    /** Whether E' is linear but for contact, and E'' of the last prepare() the same everywhere. */
    virtual bool
    is_linear() const = 0;
  };
} // namespace Supple

#endif
