#include <supple/time/static_equilibrium.h>

#include <supple/base/error.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace Supple
{
  StaticEquilibrium::StaticEquilibrium(const Model &model)
    : TimeIntegrator(model, 1.)
  {
    model.body.initialize(residual);
    model.body.initialize(correction);
    model.body.initialize(free_residual);
    force_accuracy = std::sqrt(
      dealii::Utilities::MPI::sum(model.body.round_off_square(), model.body.mesh.communicator));
  }


  std::string
  StaticEquilibrium::name() const
  {
    return model.body.rotation == RotationMethod::none ? "static, one linear solution a load step"
                                                       : "static, Newton's method in load steps";
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
  StaticEquilibrium::update_residual(const Vector &displacement, const double load_factor)
  {
    model.body.update_rotations(displacement, model.effort);
    model.body.internal_force(residual, displacement, model.effort);
    residual.sadd(-1., load_factor, model.loads.force(1., displacement));
    free_residual = residual;
    model.constraints.set_zero(free_residual);
  }


  double
  StaticEquilibrium::energy(const Vector &displacement, const double load_factor) const
  {
    const GhostValues values(displacement);
    const double elastic = model.body.sums(values.data(), nullptr).elastic;
    return dealii::Utilities::MPI::sum(elastic, model.body.mesh.communicator) -
           load_factor * (model.loads.force(1., displacement) * displacement);
  }


  void
  StaticEquilibrium::add_correction(Vector &displacement, const double load_factor)
  {
    if (model.body.rotation != RotationMethod::polar) // linear: exact; Gram-Schmidt: no energy
      {
        displacement += correction;
        update_residual(displacement, load_factor);
        return;
      }

    // line search by halves
    const Vector start            = displacement;
    const double energy_before    = energy(start, load_factor);
    const double imbalance_before = free_residual.l2_norm();
    const double slope            = free_residual * correction; // minus the derivative, positive
    for (double part = 1.; part > 1e-3; part *= 0.5)
      {
        displacement = start;
        displacement.add(part, correction);
        update_residual(displacement, load_factor);

        // Near the equilibrium the energy changes by less than it is accurate; the forces tell
        // more.
        if (energy(displacement, load_factor) <= energy_before - 1e-4 * part * slope ||
            free_residual.l2_norm() <= imbalance_before)
          return;
      }
    throw ComputationError("no part of Newton's correction lowers the energy");
  }


  StepReport
  StaticEquilibrium::advance(State &state, const bool observed)
  {
    Vector &u                = state.block(0);
    const Vector start       = u;
    const double load_factor = double(n_done + 1) / model.time.n_steps;
    StepReport report;
    report.time = load_factor;
    report.dt   = load_factor - time;
    try
      {
        find_equilibrium(u, load_factor, report);
      }
    catch (...)
      {
        u = start;
        model.body.update_rotations(u, model.effort);
        throw;
      }
    time = load_factor;
    ++n_done;

    if (observed)
      {
        correction = residual;
        correction *= -1.;
        set_reactions(correction);
        correction = u;
        correction -= start;
        if (model.loads.any_applied())
          report.load_work = load_factor * (model.loads.applied_force(1., u) * correction);
      }
    return report;
  }


  void
  StaticEquilibrium::assemble(const Vector &u, const Tangent tangent)
  {
    model.body.update_rotation_stiffness(tangent, u, model.effort);
    model.implicit_operator.assemble_stiffness();
    model.solver.prepare(u);
  }


  unsigned int
  StaticEquilibrium::find_correction(const Vector &u)
  {
    using Choice        = TimeParameters::TangentChoice;
    const Choice choice = model.time.tangent;
    if (model.body.rotation != RotationMethod::polar || choice == Choice::frozen)
      {
        assemble(u, Tangent::frozen);
        return model.solver.solve(correction, free_residual);
      }
    if (choice != Choice::definite)
      try
        {
          assemble(u, Tangent::consistent);
          const unsigned int n_iterations = model.solver.solve(correction, free_residual);
          if (choice == Choice::consistent || free_residual * correction > 0.)
            return n_iterations;
        }
      catch (const ComputationError &)
        {
          if (choice == Choice::consistent)
            throw;
        }
    assemble(u, Tangent::definite);
    return model.solver.solve(correction, free_residual);
  }


  void
  StaticEquilibrium::find_equilibrium(Vector &u, const double load_factor, StepReport &report)
  {
    const TimeParameters &settings = model.time;
    const bool linear              = model.forces_are_linear();

    if (model.constraints.move())
      model.constraints.set_displacement(u, load_factor);
    update_residual(u, load_factor);
    for (;;)
      {
        if (!all_finite(residual))
          throw ComputationError("the forces are not finite any more");

        // What is out of balance is small beside the loads and the reactions, or beside round-off.
        const double size = load_factor * model.loads.force(1., u).l2_norm() + residual.l2_norm();
        const double balance = free_residual.l2_norm();
        if (linear ? report.newton_iterations == 1
                   : balance <= settings.newton_tolerance * size + force_accuracy)
          return;
        if (report.newton_iterations == settings.newton_limit)
          {
            std::ostringstream text;
            text << "Newton's method is not done after " << settings.newton_limit
                 << " iterations: the forces are out of balance by " << balance / size
                 << " of the loads and reactions. More load steps (Time/Steps) may help";
            throw ComputationError(text.str());
          }

        if (model.body.rotation == RotationMethod::none)
          {
            if (!prepared)
              assemble(u, Tangent::frozen);
            prepared = true;
            report.linear_iterations += model.solver.solve(correction, free_residual);
          }
        else
          report.linear_iterations += find_correction(u);
        add_correction(u, load_factor);
        ++report.newton_iterations;
        ++model.effort.newton_iterations;
      }
  }
} // namespace Supple
