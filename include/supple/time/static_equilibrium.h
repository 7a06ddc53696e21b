#ifndef supple_static_equilibrium_h
#define supple_static_equilibrium_h

#include <supple/time/time_integrator.h>

namespace Supple
{
  /**
   * Equilibrium f_int(u) = s f under the loads at time 1, with the load factor s growing in steps
   * to 1.
   *
   * Each step is Newton's method with the consistent tangent of polar rotations, at first with the
   * strains that the correction before foresaw (the mixed integration points of Magisano, Leonetti
   * and Garcea 2017): a slender body that bends is stretched where it goes straight instead of
   * around, and the stress of that would spoil the tangent. Its full corrections reach most
   * equilibria in a few steps. Where they do not, or reach one of more energy than at first or with
   * more cells inside out, the step begins anew: with the strains as they are or, where that does
   * not lead downhill in the energy W(u) - s f.u, with the definite projection of the tangent,
   * which does. A line search makes sure that a correction does not go too far. Linear elasticity
   * needs one correction, and one operator for all steps, unless a load follows the body.
   *
   * What is out of balance is measured by the loads on the body at rest and by the reactions. Those
   * to a load that follows grow with the displacement without bound: they count up to the forces at
   * the start of the step.
   *
   * Where tools may touch the body they move with the load factor, and ContactNewton finds the
   * equilibrium of each step.
   */
  class StaticEquilibrium : public TimeIntegrator
  {
  public:
    StaticEquilibrium(const Model &model);

    StepReport
    advance(bool observed) override;

    std::string
    name() const override;

    nlohmann::json
    save() override;

    void
    load(const nlohmann::json &saved) override;

  private:
    class ContactStage;

    /** s f - f_int(u), with the rotations updated to u; the held entries are the reactions with a
     * minus sign. */
    void
    update_residual(double load_factor);

    /** Keeps the size of the loads on the body at rest. */
    void
    measure_loads();

    /** Loads at rest and reactions, which the forces out of balance are compared with [N]. */
    double
    size_of_forces(double load_factor) const;

    /** Adds as much of the correction as lowers the energy W(u) - s f.u, with the work of loads
     * that follow in place of f.u. */
    void
    add_correction(double load_factor);

    void
    assemble(Tangent tangent, double load_factor);

    /** Sets the correction. @return the iterations of the linear solver */
    unsigned int
    find_correction(double load_factor);

    /** The same by the frozen operator, made once if it never changes. */
    unsigned int
    find_frozen_correction(double load_factor);

    /** @throws ComputationError: Newton's method is not done, and what may help
     * @param imbalance relative to loads and reactions */
    [[noreturn]] void
    throw_not_converged(double imbalance) const;

    /** Cells inside out; collective. */
    unsigned int
    n_inverted() const;

    void
    count_correction(unsigned int n_linear_iterations, StepReport &report);

    /** W(u) - s f.u, with the work of loads that follow on the way from @p start in place of f.u.
     */
    double
    energy_along(const Vector &start, double load_factor) const;

    /** Whether what is out of balance is small beside the loads and the reactions, or beside
     * round-off. */
    bool
    is_balanced(double load_factor) const;

    /** Newton's corrections with foreseen strains, until there is balance or that is not to be
     * expected. @throws ComputationError */
    void
    correct_by_foreseen_strains(double load_factor, StepReport &report);

    /** The same; false, and nothing changed, if that leads to no equilibrium that is better than
     * the start. */
    bool
    reach_by_foreseen_strains(double load_factor, StepReport &report);

    /** Newton's iterations of a load step in which tools may touch the body. */
    void
    find_equilibrium_in_contact(double load_factor, StepReport &report);

    /** Newton's iterations of one load step. */
    void
    find_equilibrium(double load_factor, StepReport &report);

    /** The same with a load that follows the body.
     * @throws ComputationError, for an equilibrium with more cells inside out than before too */
    void
    find_equilibrium_of_followed(double load_factor, StepReport &report);

    /** Sets reactions, and the forces that are counted as work, in equilibrium at a load factor.
     * @param imbalance s f - f_int(u) */
    void
    set_forces(const Vector &imbalance, double load_factor);

    /** What loads and reactions do in a step, by the mean of both ends: that at the start when
     * called first, then that at the end [J]. */
    double
    half_work(const Vector &way) const;

    /** The work by which a growing part of the potential raises it, at half the step [J]. */
    double
    work_of_growth(double growth);

    const bool loads_follow;
    const bool operator_changes;
    double force_accuracy  = 0.; ///< what round-off leaves of forces in balance [N]
    double load_size       = 0.; ///< of the loads on the body at rest [N]
    double forces_at_start = 0.; ///< size of the forces at the start of the step [N]
    bool prepared          = false;
    bool started           = false; ///< forces at the end of the last step are known
    unsigned int n_done    = 0;     ///< load steps
    Vector residual, correction, free_residual, loads, working;
  };
} // namespace Supple

#endif
