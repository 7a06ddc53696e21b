#include <supple/time/contact_stages.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace Supple
{
  namespace
  {
    /** What ARKode asks of a stage: z = z0 + c with
     *
     *   M c - gamma f(t, z0 + c) = s,
     *
     * of displacements, where M = I and f is the velocity, and of velocities. */
    struct StageData
    {
      double time, gamma;    ///< [s]
      const double *start;   ///< z0
      const double *data;    ///< s
      const double *weights; ///< of errors
      double tolerance;      ///< of the weighted mean square
      unsigned int n;        ///< own degrees of freedom
    };


    /**
     * A stage with the displacement as its unknown: the velocity v = (u - u^)/gamma obeys the first
     * half of the equations from the beginning on, and what is left of the second half, over gamma,
     * is a force.
     */
    class DynamicStage : public ImplicitStage
    {
    public:
      DynamicStage(const Model &model, EquationOfMotion &equation, const StageData &stage)
        : model(model)
        , contact(*model.forces.contact())
        , equation(equation)
        , stage(stage)
        , y(stage.start, stage.start + 2 * stage.n)
        , rates(2 * stage.n)
        , change(2 * stage.n)
        , inertia(2 * stage.n)
      {
        for (Vector *vector : {&force, &inertial_way, &product})
          model.body.initialize(*vector);
        equation.set_configuration(stage.time, y.data());
        inertial_way = model.configuration.velocity();
        model.constraints.set_zero(inertial_way);
        for (unsigned int i = 0; i < stage.n; ++i)
          {
            const double velocity = inertial_way.local_element(i);
            y[stage.n + i] -= velocity + stage.data[i] / stage.gamma;
            inertial_way.local_element(i) = stage.gamma * velocity + stage.data[i];
          }
      }

      void
      evaluate() override
      {
        const unsigned int n = stage.n;
        equation.evaluate(rates.data(), stage.time, y.data());
        for (unsigned int i = 0; i < 2 * n; ++i)
          change[i] = y[i] - stage.start[i];
        equation.mass_product(inertia.data(), change.data());
        for (unsigned int i = 0; i < n; ++i)
          force.local_element(i) =
            rates[n + i] - (inertia[n + i] - stage.data[n + i]) / stage.gamma;
        model.constraints.set_zero(force);
      }

      const Vector &
      residual() const override
      {
        return force;
      }

      void
      prepare(const bool definite) override
      {
        const bool touches = contact.acts(model.configuration) || contact.has_stiffness();
        if (model.forces.others_than_contact_are_linear() && !touches)
          equation.set_gamma(stage.gamma);
        else
          equation.linearize(stage.time, y.data(), stage.gamma);
        if (definite)
          equation.make_definite();
      }

      void
      solve(Vector &p, const Vector &b) override
      {
        right_side = b;
        right_side *= stage.gamma * stage.gamma;
        equation.linear_iterations += model.solver.solve(p, right_side);
      }

      void
      subtract_product(Vector &b, const Vector &w) override
      {
        const GhostValues values(w);
        sum_into(product, [&](double *sum) {
          model.forces.add_product(model.configuration, {0., 0., 1.}, values.data(), sum);
        });
        b -= product;
      }

      bool
      foresee(Vector &way) override
      {
        way = inertial_way;
        for (unsigned int i = 0; i < stage.n; ++i) // from where it is now
          way.local_element(i) -= y[i] - stage.start[i];
        return true;
      }

      void
      keep() override
      {
        kept = y;
      }

      void
      correct(const double part, const Vector &p) override
      {
        for (unsigned int i = 0; i < stage.n; ++i)
          {
            y[i]           = kept[i] + part * p.local_element(i);
            y[stage.n + i] = kept[stage.n + i] + part * p.local_element(i) / stage.gamma;
          }
        equation.set_configuration(stage.time, y.data());
      }

      bool
      is_done(const Vector &p) const override
      {
        double sum = 0.;
        for (unsigned int i = 0; i < stage.n; ++i)
          sum += std::pow(p.local_element(i) * stage.weights[i], 2) +
                 std::pow(p.local_element(i) / stage.gamma * stage.weights[stage.n + i], 2);
        const std::vector<double> here = {sum, 2. * stage.n};
        std::vector<double> all(2);
        dealii::Utilities::MPI::sum(here, model.body.mesh.communicator, all);
        return std::sqrt(all[0] / all[1]) <= stage.tolerance;
      }

      bool
      is_linear() const override
      {
        return equation.rotations_are_frozen() || model.forces.others_than_contact_are_linear();
      }

      /** Gives ARKode what it asks for. */
      void
      set_correction(double *c) const
      {
        for (unsigned int i = 0; i < 2 * stage.n; ++i)
          c[i] = y[i] - stage.start[i];
        equation.foresee_increment(c + stage.n);
      }

    private:
      const Model &model;
      const Contact &contact;
      EquationOfMotion &equation;
      const StageData stage;
      std::vector<double> y, kept;                ///< the unknowns
      std::vector<double> rates, change, inertia; ///< at hand
      Vector force, inertial_way, right_side, product;
    };
  } // namespace


  ContactStages::ContactStages(const Model &model,
                               EquationOfMotion &equation,
                               const Sundials::Context &context,
                               Sundials::Failure &failure,
                               void *const arkode_memory,
                               const std::function<double(double)> &time_of)
    : model(model)
    , equation(equation)
    , failure(failure)
    , arkode_memory(arkode_memory)
    , time_of(time_of)
    , newton(model)
    , solver(SUNNonlinSolNewEmpty(context))
  {
    solver->content       = this;
    solver->ops->gettype  = [](SUNNonlinearSolver) { return SUNNONLINEARSOLVER_ROOTFIND; };
    solver->ops->setsysfn = [](SUNNonlinearSolver, SUNNonlinSolSysFn) { return 0; };
    solver->ops->solve    = [](SUNNonlinearSolver self,
                            N_Vector,
                            N_Vector correction,
                            N_Vector weights,
                            sunrealtype tolerance,
                            Compatibility::Boolean,
                            void *) {
      return static_cast<ContactStages *>(self->content)->solve(correction, weights, tolerance);
    };
    solver->ops->getnumiters = [](SUNNonlinearSolver self, long int *n) {
      const auto &stages = *static_cast<const ContactStages *>(self->content);
      *n                 = stages.newton.n_iterations - stages.n_before;
      return 0;
    };
    ARKStepSetNonlinearSolver(arkode_memory, solver);
  }


  ContactStages::~ContactStages()
  {
    SUNNonlinSolFreeEmpty(solver);
  }


  int
  ContactStages::solve(const N_Vector correction, const N_Vector weights, const double tolerance)
  {
    sunrealtype time, gamma;
    N_Vector start, now, rate, data;
    void *user_data;
    ARKStepGetNonlinearSystemData(
      arkode_memory, &time, &start, &now, &rate, &gamma, &data, &user_data);
    n_before         = newton.n_iterations;
    const int status = failure.guard([&] {
      DynamicStage stage(model,
                         equation,
                         {time_of(time),
                          gamma,
                          Sundials::data(start),
                          Sundials::data(data),
                          Sundials::data(weights),
                          tolerance,
                          equation.n_unknowns() / 2});
      newton.solve(stage);
      stage.set_correction(Sundials::data(correction));
    });
    return status > 0 ? SUN_NLS_CONV_RECVR : status;
  }
} // namespace Supple
