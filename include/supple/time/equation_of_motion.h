#ifndef supple_equation_of_motion_h
#define supple_equation_of_motion_h

#include <supple/solvers/mass_solver.h>
#include <supple/time/time_integrator.h>

namespace Supple
{
  /**
   * The equations integrators solve, on this process's nodes:
   *
   *   u' = v,   M_ff q' = f(t) - D v - f_int(u),   q = v + M_ff^-1 M_fh v_h,
   *
   * with the free degrees of freedom f and the held ones h, whose displacement g(t) and velocity
   * v_h = g'(t) are prescribed. In q, the momentum of the free ones over their mass, the
   * acceleration of the held ones does not appear: a motion may start with a jerk. Without motions
   * q is v.
   *
   * The unknowns are 6 n_owned doubles, u then q, with zeros where the body is held.
   */
  class EquationOfMotion
  {
  public:
    using Rotations = Configuration::Rotations;

    enum class HeldVelocity
    {
      derivative, ///< g'(t)
      difference  ///< (g(t) - g(t0)) / (t - t0) since the last begin_step(): backward Euler's
    };

    EquationOfMotion(const Model &model, Rotations rotations, HeldVelocity held_velocity);

    unsigned int
    n_unknowns() const
    {
      return 2 * n;
    }

    /** To be called at the start of each step, after that of the configuration. */
    void
    begin_step(double time);

    /** Those of the configuration. */
    void
    get_unknowns(double *y);

    /** Sets displacement and velocity of the configuration, held entries included, from the
     * unknowns; its passage ends at this time, and held vertices are at its part of their way. */
    void
    set_configuration(double time, const double *y);

    /** f = (v, net force) at time t */
    void
    evaluate(double *f, double time, const double *y);

    /**
     * Splits f = f^I + f^E for semi-implicit methods, from here on:
     *
     *   f^I = (v, f_d(t) - K' (u + b v) - a M v - c v),   f^E = (0, all other forces),
     *
     * K' with the rotations that the cells had at the last renew_splitting(), f_d the loads that do
     * not depend on the displacement: f^I is linear in the unknowns, and f^E what the rotations
     * have added since, and the loads that follow. Any K' is right; an old one makes long steps
     * unstable.
     */
    void
    split();

    /** To be called at the start of a step with its gamma, after begin_step(): takes the rotations
     * of the configuration for K' if a cell has turned by more than an angle [degrees] since, if
     * gamma is another one, or if it is @p wanted. */
    void
    renew_splitting(double gamma, double angle, bool wanted);

    /** f^I, with M_ff as for evaluate(). That of the start of the step is asked for in each of its
     * stages: without motions all but the loads is computed once. */
    void
    evaluate_implicit(double *f, double time, const double *y);

    /** f^E. */
    void
    evaluate_explicit(double *f, double time, const double *y);

    /** Prepares solve() for a gamma, with the K' of f^I. @throws ComputationError */
    void
    prepare_split(double gamma);

    /** (x_u, M_ff x_q) */
    void
    mass_product(double *y, const double *x);

    /** What M_ff^-1 is about to give: the increment of the velocities, to begin its solution with.
     */
    void
    foresee_increment(const double *velocities);

    /** Its inverse. @throws ComputationError */
    void
    solve_mass(double *x, const double *b);

    /** Prepares solve() at this state. @throws ComputationError */
    void
    linearize(double time, const double *y, double gamma);

    /**
     * Solves, with the gamma of the last linearize(),
     *
     *   [ I    -g I    ] [x_u]   [b_u]
     *   [ g K'  M + g D] [x_q] = [b_q]
     *
     * by elimination: (M + g D + g^2 K') x_q = b_q - g K' b_u, x_u = b_u + g x_q.
     * @throws ComputationError
     */
    void
    solve(double *x, const double *b);

    /** The same in Newton's method: where it converges slowly, the operator is first assembled anew
     * for the state of the last evaluate(). */
    void
    solve_newton(double *x, const double *b);

    /** force = f(t) - f_int - D v of the configuration, on all rows; what is counted of it goes to
     * @p effort. */
    void
    set_net_force(Vector &force, double time, Effort &effort);

    /** Prepares solve() for the same gamma at the state of the last evaluate(). @throws
     * ComputationError */
    void
    relinearize();

    /** The operator of the last linearize() becomes definite, if it is not in any case. */
    void
    make_definite();

    /** Prepares solve() for another gamma at the state of the last linearize(). */
    void
    set_gamma(double gamma);

    double
    current_gamma() const
    {
      return gamma;
    }

    void
    set_rotations(Rotations rotations);

    bool
    rotations_are_frozen() const
    {
      return model.configuration.rotations_are == Rotations::frozen;
    }

    /** To be called before the first step if save() will be. */
    void
    keep_origin()
    {
      keeps_origin = true;
    }

    /** What a run that goes on needs of the past; collective, counts on the first process.
     * @param with_operator whether the operator may serve further steps */
    nlohmann::json
    save(bool with_operator) const;

    /** The same taken back, with the configuration as it was then. Collective. */
    void
    load(const nlohmann::json &saved);

    const Model model;
    unsigned int linear_iterations = 0; ///< so far

  private:
    /** Sets the held entries of displacement and velocity, and the shift between q and v. */
    void
    prescribe(double time);

    void
    set_held_velocity(Vector &velocity, double time);

    /** shift = M_ff^-1 M_fh v_h */
    void
    set_shift(const Vector &held_velocity);

    /** f^I without the loads. */
    void
    evaluate_unloaded(double *f, double time, const double *y);

    /** f += (0, f_d) */
    void
    add_dead_loads(double *f, double time);

    /** The operator at the configuration. */
    void
    assemble();

    /** The same with other rotations than those of the last time. */
    void
    renew_rotations();

    /** The operator of which save() was called, and the configuration as it is. */
    void
    assemble_as_at(const nlohmann::json &saved);

    const unsigned int n;   ///< own degrees of freedom
    Tangent tangent;        ///< wanted
    bool gives_way = false; ///< a tangent that is not definite is replaced by one that is
    bool replaced  = false; ///< since the last begin_step()
    const HeldVelocity held_velocity;
    const bool inertia_couples; ///< a held vertex to its neighbours, by the mass matrix
    MassSolver mass_solver;

    double step_start         = 0.;
    double configuration_time = 0.;
    double prescribed_time    = -1.;
    Vector prescribed_displacement, prescribed_velocity, shift;

    double stage_time            = -1.; ///< of the last evaluate() [s]
    unsigned int stage_solutions = 0;   ///< corrections at that time
    double correction            = 0.;  ///< norm of the last one
    double contraction           = 1.;  ///< of the second correction over the first, lately

    double gamma = 0.;
    Vector force, scratch, solution;

    bool is_split  = false;
    bool splitting = false;           ///< was made
    bool at_start  = false;           ///< of a step: the rotations are those of its unknowns
    Vector kept_force;                ///< K' (u + b v) [N]
    bool has_start = false;           ///< what follows
    std::vector<double> start, rates; ///< unknowns at the start of a step, f^I there without loads

    /** Of what the operator was assembled. */
    struct Origin
    {
      Vector displacement; ///< [m]
      double time   = 0.;  ///< [s]
      double gamma  = 0.;  ///< [s]; 0 if there is no operator yet
      bool replaced = false;
    };
    Origin origin;
    bool keeps_origin = false;
  };
} // namespace Supple

#endif
