#ifndef supple_backward_euler_h
#define supple_backward_euler_h

#include <supple/time_integrator.h>

#include <deal.II/sundials/arkode.h>

#include <exception>

namespace Supple
{
  /**
   * Backward Euler with fixed step by SUNDIALS ARKode, rotations frozen at the start of each step:
   *
   *   (M + dt D + dt^2 K') v1 = M v0 + dt (f1 - K' (X + u0) + f0),   u1 = u0 + dt v1
   *
   * ARKode sees the 2n equations u' = v, M v' = f - D v - f_int(u), which are linear within a step;
   * its linear systems [ I    -g I    ] [z_u]   [r_u] [ g K'  M + g D] [z_v] = [r_v] are solved by
   * elimination: (M + g D + g^2 K') z_v = r_v - g K' r_u, z_u = r_u + g z_v.
   */
  class BackwardEuler : public TimeIntegrator
  {
  public:
    explicit BackwardEuler(const Model &model);

    StepReport
    advance(State &state, double time, bool observed) override;

    std::string
    name() const override;

  private:
    using ARKode = dealii::SUNDIALS::ARKode<State>;

    static ARKode::AdditionalData
    settings(const Parameters &parameters);

    /** f and M: what ARKode is to solve. */
    void
    set_equation_callbacks();

    /** How its linear systems are solved. */
    void
    set_solver_callbacks();

    void
    set_options(void *arkode_memory);

    /** f - D v - f_int(u), zero where the body is held. */
    void
    net_force(double time, const State &y, Vector &force);

    void
    solve_eliminated(const State &r, State &z);

    /** y = M x for free rows; held entries of x count if anything is moved, and are zero otherwise.
     */
    void
    mass_product(Vector &y, const Vector &x) const;

    /** y = M x on all rows, held ones included. */
    void
    full_mass_product(Vector &y, const Vector &x) const;

    void
    set_prescribed_acceleration(const State &state, double time);

    void
    eliminate_prescribed(const State &r);

    /** x = M^-1 b, starting from the increment that the last step's linear system gave. */
    void
    solve_mass(Vector &x, const Vector &b);

    void
    observe(const State &state, double time, StepReport &report);

    /** Keeps what is thrown inside a callback, since SUNDIALS in between knows no exceptions. */
    template <class Action>
    int
    guarded(const Action &action);

    void
    throw_what_failed();

    ARKode ode;
    double ode_time = 0.; ///< ARKode's time [s]
    double gamma    = 0.;
    State previous;
    Vector scratch, force;
    Vector prescribed_acceleration;   ///< of the held degrees of freedom [m/s^2]
    Vector velocity_increment;        ///< z_v of the last linear system
    std::vector<double> inverse_mass; ///< of each owned node's diagonal entry
    unsigned int linear_iterations = 0;
    std::exception_ptr failure;
    std::string arkode_message;
  };
} // namespace Supple

#endif
