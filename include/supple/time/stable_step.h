#ifndef supple_stable_step_h
#define supple_stable_step_h

#include <supple/solvers/implicit_operator.h>

#include <complex>
#include <cstdio> // for the next
#include <string>

#include <arkode/arkode_butcher.h>

namespace Supple
{
  /** What an explicit method can do for a body, see find_stable_step(). */
  struct StableStep
  {
    double step;      ///< the largest step that is stable [s]
    double frequency; ///< of the body's fastest oscillation [rad/s]
    double limit;     ///< frequency times stable step of the undamped body

    /** In words. */
    std::string
    description() const;
  };


  /**
   * By what a step of an explicit Runge-Kutta method multiplies y in y' = lambda y, z = step
   * lambda: R(z) = 1 + z b^T (1 - z A)^-1 (1, ..., 1)^T, a polynomial.
   */
  std::complex<double>
  stability_function(const ARKodeButcherTable &table, std::complex<double> z);


  /**
   * The largest frequency omega [rad/s] with K u = omega^2 M u for the free degrees of freedom,
   * lumped masses and the rotations the body has now: by the Lanczos process in deal.II's conjugate
   * gradients. It is found from below, to about four digits. Rotations hardly change it: each cell
   * has the same stiffest motion however it is turned.
   */
  double
  largest_frequency(const ImplicitOperator &A);


  /**
   * The largest step an explicit method can take over a motion of this duration: none of the
   * oscillations
   *
   *   lambda^2 + d lambda + omega^2 = 0,  d = a + b omega^2 + c/m,  0 < omega <=
   * largest_frequency(),
   *
   * with the damping of the scene (c/m being that of the lightest vertex or of the heaviest) grows
   * to more than twice its size until the end, or in a hundred steps if there are fewer. Damping by
   * stiffness shortens the step; other damping may make it longer.
   */
  StableStep
  find_stable_step(const ImplicitOperator &A, const ARKodeButcherTable &table, double duration);
} // namespace Supple

#endif
