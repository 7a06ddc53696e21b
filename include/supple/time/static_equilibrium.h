#ifndef supple_static_equilibrium_h
#define supple_static_equilibrium_h

#include <supple/time/time_integrator.h>

namespace Supple
{
  /**
   * Equilibrium f_int(u) = s f under the loads at time 1, with the load factor s growing in steps
   * to 1.
   *
   * Each step is Newton's method with the consistent tangent of polar rotations; where that does
   * not lead downhill in the energy W(u) - s f.u, with its definite projection, which does. A line
   * search makes sure that a correction does not go too far. Linear elasticity needs one
   * correction, and one operator for all steps.
   */
  class StaticEquilibrium : public TimeIntegrator
  {
  public:
    StaticEquilibrium(const Model &model);

    StepReport
    advance(State &state, bool observed) override;

    std::string
    name() const override;

    nlohmann::json
    save() override;

    void
    load(const nlohmann::json &saved) override;

  private:
    /** s f - f_int(u), with the rotations updated to u; the held entries are the reactions with a
     * minus sign. */
    void
    update_residual(const Vector &displacement, double load_factor);

    /** W(u) - s f.u [J], with the rotations of the last update. */
    double
    energy(const Vector &displacement, double load_factor) const;

    /** Adds as much of the correction as lowers the energy. */
    void
    add_correction(Vector &displacement, double load_factor);

    void
    assemble(const Vector &displacement, Tangent tangent);

    /** Sets the correction. @return the iterations of the linear solver */
    unsigned int
    find_correction(const Vector &displacement);

    /** Newton's iterations of one load step. */
    void
    find_equilibrium(Vector &displacement, double load_factor, StepReport &report);

    double force_accuracy = 0.; ///< what round-off leaves of forces in balance [N]
    bool prepared         = false;
    unsigned int n_done   = 0; ///< load steps
    Vector residual, correction, free_residual;
  };
} // namespace Supple

#endif
