#include <supple/time/static_equilibrium.h>

#include <supple/base/error.h>
#include <supple/time/contact_newton.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace Supple
{
  namespace
  {
    /** As long as it lives a configuration may foresee strains. */
    struct StrainsForeseen
    {
      Configuration &configuration;

      explicit StrainsForeseen(Configuration &configuration)
        : configuration(configuration)
      {
      }

      ~StrainsForeseen()
      {
        configuration.forget_strains();
      }

      StrainsForeseen(const StrainsForeseen &) = delete;
      StrainsForeseen &
      operator=(const StrainsForeseen &) = delete;
    };
  } // namespace


  /** A load step of which tools are a part. */
  class StaticEquilibrium::ContactStage : public ImplicitStage
  {
  public:
    ContactStage(StaticEquilibrium &statics, const double load_factor, StepReport &report)
      : statics(statics)
      , model(statics.model)
      , load_factor(load_factor)
      , report(report)
      , goal(model.configuration.displacement())
    {
      model.configuration.passage.to = load_factor;
      model.constraints.set_displacement(goal, load_factor);
    }

    void
    evaluate() override
    {
      statics.update_residual(load_factor);
      if (!all_finite(statics.residual))
        throw ComputationError("the forces are not finite any more");
    }

    const Vector &
    residual() const override
    {
      return statics.free_residual;
    }

    void
    prepare(const bool definite) override
    {
      const Tangent choice = model.time.tangent;
      if (!model.forces.have_energy() || choice == Tangent::frozen)
        statics.assemble(Tangent::frozen, load_factor);
      else
        statics.assemble(definite || choice == Tangent::definite ? Tangent::definite
                                                                 : Tangent::consistent,
                         load_factor);
    }

    void
    solve(Vector &p, const Vector &b) override
    {
      statics.count_correction(model.solver.solve(p, b), report);
    }

    void
    subtract_product(Vector &b, const Vector &w) override
    {
      const GhostValues values(w);
      sum_into(statics.correction, [&](double *sum) {
        model.forces.add_product(model.configuration, {0., 0., 1.}, values.data(), sum);
      });
      b -= statics.correction;
    }

    bool
    foresee(Vector &) override
    {
      return false;
    }

    void
    keep() override
    {
      kept = model.configuration.displacement();
    }

    void
    correct(const double part, const Vector &p) override
    {
      Vector &displacement = model.configuration.state.displacement;
      displacement         = kept;
      displacement.add(part, p);
      model.constraints.set_held_on_way(displacement,
                                        model.configuration.start_of_step().displacement,
                                        goal,
                                        model.configuration.passage.part);
    }

    bool
    is_done(const Vector &) const override
    {
      return statics.is_balanced(load_factor);
    }

    bool
    is_linear() const override
    {
      return model.forces.others_than_contact_are_linear();
    }

  private:
    StaticEquilibrium &statics;
    const Model &model;
    const double load_factor;
    StepReport &report;
    Vector goal; ///< of what is held [m]
    Vector kept;
  };


  StaticEquilibrium::StaticEquilibrium(const Model &model)
    : TimeIntegrator(model, 1.)
    , loads_follow(model.forces.loads_follow())
    , operator_changes(model.forces.change_operator() || loads_follow)
  {
    for (Vector *vector : {&residual, &correction, &free_residual, &loads, &working})
      model.body.initialize(*vector);
    force_accuracy = model.forces.round_off(model.configuration);
    measure_loads();
  }


  std::string
  StaticEquilibrium::name() const
  {
    return operator_changes ? "static, Newton's method in load steps"
                            : "static, one linear solution a load step";
  }


  nlohmann::json
  StaticEquilibrium::save()
  {
    return {{"time", time}, {"done", n_done}};
  }


  void
  StaticEquilibrium::load(const nlohmann::json &saved)
  {
    time   = saved.at("time");
    n_done = saved.at("done");
  }


  void
  StaticEquilibrium::update_residual(const double load_factor)
  {
    model.configuration.update_rotations(model.effort);
    model.forces.set_force(residual, model.configuration, 1., model.effort, load_factor);
    free_residual = residual;
    model.constraints.set_zero(free_residual);
  }


  void
  StaticEquilibrium::measure_loads()
  {
    Vector &displacement = model.configuration.state.displacement;
    const Vector start   = displacement;
    displacement         = 0.;
    model.forces.set_loads(loads, model.configuration, 1.);
    load_size    = loads.l2_norm();
    displacement = start;
  }


  double
  StaticEquilibrium::size_of_forces(const double load_factor) const
  {
    const double forces  = residual.l2_norm();
    const bool runs_away = loads_follow && !model.forces.contact(); // what is touched holds it
    return load_factor * load_size + (runs_away ? std::min(forces, forces_at_start) : forces);
  }


  void
  StaticEquilibrium::add_correction(const double load_factor)
  {
    Configuration &configuration = model.configuration;
    Vector &displacement         = configuration.state.displacement;
    if (!operator_changes || !model.forces.have_energy())
      {
        displacement.add(model.forces.largest_step(configuration, correction), correction);
        update_residual(load_factor);
        return;
      }

    // line search by halves
    const Vector start            = displacement;
    const double energy_before    = model.forces.energy(configuration, 1., load_factor);
    const double imbalance_before = free_residual.l2_norm();
    const double slope            = free_residual * correction; // minus the derivative, positive
    const double largest          = model.forces.largest_step(configuration, correction);
    for (double part = largest; part > 1e-3 * largest; part *= 0.5)
      {
        displacement = start;
        displacement.add(part, correction);
        update_residual(load_factor);

        // Near the equilibrium the energy changes by less than it is accurate; the forces tell
        // more.
        if (energy_along(start, load_factor) <= energy_before - 1e-4 * part * slope ||
            free_residual.l2_norm() <= imbalance_before)
          return;
      }
    throw ComputationError("no part of Newton's correction lowers the energy");
  }


  StepReport
  StaticEquilibrium::advance(const bool observed)
  {
    Configuration &configuration = model.configuration;
    const double load_factor     = double(n_done + 1) / model.time.n_steps;
    StepReport report;
    report.time = load_factor;
    report.dt   = load_factor - time;
    configuration.begin_step(time);
    if (observed && !started)
      {
        Effort uncounted; // these forces are for the eye alone
        model.forces.set_force(residual, configuration, 1., uncounted, time);
        set_forces(residual, time);
      }
    try
      {
        if (loads_follow)
          find_equilibrium_of_followed(load_factor, report);
        else
          find_equilibrium(load_factor, report);
      }
    catch (...)
      {
        configuration.reject(model.effort);
        throw;
      }
    if (observed)
      {
        Vector way = configuration.displacement();
        way -= configuration.start_of_step().displacement;
        report.load_work = half_work(way);
        set_forces(residual, load_factor);
        report.load_work += half_work(way) + work_of_growth(load_factor - time);
        add_work_of_tools(report, 0.5);
      }
    started = observed;
    time    = load_factor;
    ++n_done;
    return report;
  }


  void
  StaticEquilibrium::set_forces(const Vector &imbalance, const double load_factor)
  {
    correction = imbalance;
    correction *= -1.;
    set_reactions(correction);
    if (!model.forces.do_work())
      return;
    model.forces.set_working(working, model.configuration, 1.);
    working *= load_factor;
  }


  double
  StaticEquilibrium::half_work(const Vector &way) const
  {
    return 0.5 * (working * way + reactions() * way);
  }


  double
  StaticEquilibrium::work_of_growth(const double growth)
  {
    const Configuration &configuration = model.configuration;
    model.forces.set_loads(loads, configuration, 1.);
    if (model.forces.do_work())
      {
        model.forces.set_working(correction, configuration, 1.);
        loads -= correction;
      }
    return -0.5 * growth *
           (loads * configuration.displacement() +
            loads * configuration.start_of_step().displacement);
  }


  void
  StaticEquilibrium::assemble(const Tangent tangent, const double load_factor)
  {
    model.forces.update_tangent(tangent, model.configuration, 1., model.effort, load_factor);
    model.implicit_operator.assemble_stiffness();
    model.solver.prepare(model.configuration.displacement());
  }


  unsigned int
  StaticEquilibrium::find_frozen_correction(const double load_factor)
  {
    if (model.forces.change_operator() || !prepared)
      assemble(Tangent::frozen, load_factor);
    prepared = true;
    return model.solver.solve(correction, free_residual);
  }


  unsigned int
  StaticEquilibrium::find_correction(const double load_factor)
  {
    const Tangent choice = model.time.tangent;
    if (!operator_changes || !model.forces.have_energy() || choice == Tangent::frozen)
      return find_frozen_correction(load_factor);
    if (choice != Tangent::definite)
      try
        {
          assemble(Tangent::consistent, load_factor);
          const unsigned int n_iterations = model.solver.solve(correction, free_residual);
          if (choice == Tangent::consistent || free_residual * correction > 0.)
            return n_iterations;
        }
      catch (const ComputationError &)
        {
          if (choice == Tangent::consistent)
            throw;
        }
    assemble(Tangent::definite, load_factor);
    return model.solver.solve(correction, free_residual);
  }


  void
  StaticEquilibrium::throw_not_converged(const double imbalance) const
  {
    std::ostringstream text;
    text << "Newton's method is not done after " << model.time.newton_limit
         << " iterations: the forces are out of balance by " << imbalance
         << " of the loads and reactions";
    if (!loads_follow)
      text << ". More load steps (Time/Steps) may help";
    throw ComputationError(text.str());
  }


  unsigned int
  StaticEquilibrium::n_inverted() const
  {
    return dealii::Utilities::MPI::sum(
      model.forces.elastic().deformation(model.configuration).inverted,
      model.body.mesh.communicator);
  }


  void
  StaticEquilibrium::find_equilibrium_of_followed(const double load_factor, StepReport &report)
  {
    const unsigned int n_inverted_before = n_inverted();
    try
      {
        find_equilibrium(load_factor, report);
        const unsigned int n = n_inverted();
        if (n > n_inverted_before)
          throw ComputationError("the forces are in balance only with " + std::to_string(n) +
                                 (n == 1 ? " cell inside out" : " cells inside out"));
      }
    catch (const ComputationError &error)
      {
        throw ComputationError("no equilibrium was found: " + std::string(error.what()) +
                               ". The body may not bear the pressure (Loads/Pressure), which "
                               "grows with the surface that it follows. A smaller pressure, or "
                               "more load steps (Time/Steps), may help");
      }
  }


  void
  StaticEquilibrium::count_correction(const unsigned int n_linear_iterations, StepReport &report)
  {
    report.linear_iterations += n_linear_iterations;
    ++report.newton_iterations;
    ++model.effort.newton_iterations;
  }


  double
  StaticEquilibrium::energy_along(const Vector &start, const double load_factor) const
  {
    const double work =
      loads_follow ? load_factor * model.forces.work_along(model.configuration, 1., start) : 0.;
    return model.forces.energy(model.configuration, 1., load_factor) - work;
  }


  bool
  StaticEquilibrium::is_balanced(const double load_factor) const
  {
    return free_residual.l2_norm() <=
           model.time.newton_tolerance * size_of_forces(load_factor) + force_accuracy;
  }


  void
  StaticEquilibrium::correct_by_foreseen_strains(const double load_factor, StepReport &report)
  {
    constexpr unsigned int most_corrections = 8;

    Configuration &configuration = model.configuration;
    const StrainsForeseen until_the_end(configuration);
    const unsigned int most = std::min(most_corrections, model.time.newton_limit);
    for (unsigned int n = 0; n < most && !is_balanced(load_factor); ++n)
      {
        const double before = free_residual.l2_norm();
        assemble(Tangent::consistent, load_factor);
        count_correction(model.solver.solve(correction, free_residual), report);
        configuration.foresee_strains();
        configuration.state.displacement.add(model.forces.largest_step(configuration, correction),
                                             correction);
        update_residual(load_factor);
        // The first correction stretches what turns; from then on the forces must come to balance.
        if (!all_finite(residual) || (n > 0 && free_residual.l2_norm() > before))
          return;
      }
  }


  bool
  StaticEquilibrium::reach_by_foreseen_strains(const double load_factor, StepReport &report)
  {
    const Tangent choice = model.time.tangent;
    if (!model.forces.have_energy() || choice == Tangent::frozen || choice == Tangent::definite)
      return false;
    Vector &displacement         = model.configuration.state.displacement;
    const Vector start           = displacement;
    const double energy_at_first = model.forces.energy(model.configuration, 1., load_factor);
    const unsigned int n_inverted_before = n_inverted();
    try
      {
        correct_by_foreseen_strains(load_factor, report);
        if (all_finite(residual) && is_balanced(load_factor) && n_inverted() <= n_inverted_before &&
            energy_along(start, load_factor) <= energy_at_first)
          return true;
      }
    catch (const ComputationError &)
      {
        // then the safe way may do
      }
    displacement = start;
    update_residual(load_factor);
    return false;
  }


  void
  StaticEquilibrium::find_equilibrium_in_contact(const double load_factor, StepReport &report)
  {
    ContactStage stage(*this, load_factor, report);
    ContactNewton(model).solve(stage);
    update_residual(load_factor);
  }


  void
  StaticEquilibrium::find_equilibrium(const double load_factor, StepReport &report)
  {
    if (model.forces.contact())
      {
        find_equilibrium_in_contact(load_factor, report);
        return;
      }
    const bool linear = model.forces.are_linear();

    if (model.constraints.move())
      model.constraints.set_displacement(model.configuration.state.displacement, load_factor);
    update_residual(load_factor);
    forces_at_start = residual.l2_norm();
    if (!linear && all_finite(residual) && reach_by_foreseen_strains(load_factor, report))
      return;
    for (unsigned int n = 0;; ++n)
      {
        if (!all_finite(residual))
          throw ComputationError("the forces are not finite any more");
        if (linear ? n == 1 : is_balanced(load_factor))
          return;
        if (n == model.time.newton_limit)
          throw_not_converged(free_residual.l2_norm() / size_of_forces(load_factor));

        const unsigned int n_linear_iterations = find_correction(load_factor);
        add_correction(load_factor);
        count_correction(n_linear_iterations, report);
      }
  }
} // namespace Supple
