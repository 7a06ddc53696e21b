#ifndef supple_contact_stages_h
#define supple_contact_stages_h

#include <supple/time/contact_newton.h>
#include <supple/time/equation_of_motion.h>
#include <supple/time/sundials.h>

#include <sundials/sundials_nonlinearsolver.h>

#include <functional>

namespace Supple
{
  /** Finds the implicit stages of ARKode where tools may touch the body: a nonlinear solver of
   * SUNDIALS, whose own Newton's method takes each correction as it is. */
  class ContactStages
  {
  public:
    /**
     * @param arkode_memory of the integrator, which must outlive this
     * @param time_of       what ARKode's time is [s]
     */
    ContactStages(const Model &model,
                  EquationOfMotion &equation,
                  const Sundials::Context &context,
                  Sundials::Failure &failure,
                  void *arkode_memory,
                  const std::function<double(double)> &time_of);

    ~ContactStages();

    ContactStages(const ContactStages &) = delete;
    ContactStages &
    operator=(const ContactStages &) = delete;

  private:
    /** @return a code of SUNDIALS */
    int
    solve(N_Vector correction, N_Vector weights, double tolerance);

    const Model model;
    EquationOfMotion &equation;
    Sundials::Failure &failure;
    void *const arkode_memory;
    const std::function<double(double)> time_of;
    ContactNewton newton;
    unsigned long n_before = 0; ///< iterations before the last stage
    SUNNonlinearSolver solver;
  };
} // namespace Supple

#endif
