#ifndef supple_ida_integrator_h
#define supple_ida_integrator_h

#include <supple/time/dynamic_integrator.h>

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

    nlohmann::json
    save() override;

    void
    load(const nlohmann::json &saved) override;

  private:
    StepReport
    take_step() override;

    bool
    make_safer() override
    {
      return false; // its steps are chosen by its error
    }

    void
    create_memory();

    void
    set_linear_system();

    /** Assembles the operator anew where it has served many steps. @throws ComputationError */
    void
    keep_up_to_date();

    /** F(t, y, y') */
    void
    residual(double time, const double *y, const double *rate, double *F);

    /** Consistent rates, and a first step whose displacement stays within the tolerance. */
    void
    start();

    /** Has IDA begin at order one. @param end_of_run [s] */
    void
    begin_at(double at, double first_size, double end_of_run);

    bool
    repeat_past() override;

    void
    set_end(double end_of_run);

    /** So far. */
    void
    count_rejections();

    Sundials::StateVector rates, error;
    std::vector<double> work_space;
    void *memory           = nullptr;
    bool started           = false;
    long newton_iterations = 0;
    long linearized_at     = 0; ///< the step in which the operator was assembled
  };
} // namespace Supple

#endif
