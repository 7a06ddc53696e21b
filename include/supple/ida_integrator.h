#ifndef supple_ida_integrator_h
#define supple_ida_integrator_h

#include <supple/dynamic_integrator.h>

namespace Supple
{
  /**
   * Backward differentiation formulas with variable steps and order by SUNDIALS's IDA, of order one
   * (backward Euler) up to the one the scene allows: 0 = (u' - v, M_ff q' - net force).
   */
  class IdaIntegrator : public DynamicIntegrator
  {
  public:
    explicit IdaIntegrator(const Model &model);

    ~IdaIntegrator() override;

    std::string
    name() const override;

  private:
    StepReport
    take_step(State &state) override;

    void
    create_memory();

    void
    set_linear_system();

    /** F(t, y, y') */
    void
    residual(double time, const double *y, const double *rate, double *F);

    /** Consistent rates, and a first step whose displacement stays within the tolerance. */
    void
    start(const State &state);

    void
    count_rejected_steps() const;

    Sundials::StateVector rates, error;
    std::vector<double> work_space;
    void *memory           = nullptr;
    bool started           = false;
    long newton_iterations = 0;
  };
} // namespace Supple

#endif
