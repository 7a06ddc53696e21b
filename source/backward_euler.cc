#include <supple/backward_euler.h>

#include <supple/compatibility.h>
#include <supple/error.h>

#include <deal.II/lac/solver_cg.h>

#include <cmath>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    struct MassProduct
    {
      const ImplicitOperator &A;

      void
      vmult(Vector &y, const Vector &x) const
      {
        A.mass_vmult(y, x);
      }
    };


    struct MassDiagonal
    {
      const std::vector<double> &inverse;

      void
      vmult(Vector &y, const Vector &x) const
      {
        for (std::size_t node = 0; node < inverse.size(); ++node)
          for (unsigned int i = 0; i < 3; ++i)
            y.local_element(3 * node + i) = inverse[node] * x.local_element(3 * node + i);
      }
    };
  } // namespace


  BackwardEuler::ARKode::AdditionalData
  BackwardEuler::settings(const Parameters &parameters)
  {
    const bool linear = parameters.corotation.rotation == RotationMethod::none;

    ARKode::AdditionalData data;
    data.initial_time                          = 0.;
    data.final_time                            = 1e300;
    data.initial_step_size                     = parameters.time.step;
    data.output_period                         = 1e300;
    data.minimum_step_size                     = 0.;
    data.implicit_function_is_linear           = true;
    data.implicit_function_is_time_independent = linear;
    data.mass_is_time_independent              = true;
    return data;
  }


  BackwardEuler::BackwardEuler(const Model &model)
    : TimeIntegrator(model)
    , ode(settings(model.parameters), model.body.mesh.communicator)
  {
    model.body.initialize(scratch);
    model.body.initialize(force);
    model.body.initialize(velocity_increment);
    if (model.constraints.move())
      model.body.initialize(prescribed_acceleration);

    const auto &diagonal = model.implicit_operator.mass_matrix().diagonal;
    for (unsigned int node = 0; node < model.body.n_owned; ++node)
      inverse_mass.push_back(1. / diagonal[node]);

    set_equation_callbacks();
    set_solver_callbacks();
  }


  std::string
  BackwardEuler::name() const
  {
    return "backward Euler (ARKode)";
  }


  template <class Action>
  int
  BackwardEuler::guarded(const Action &action)
  {
    if (failure)
      return -1;
    try
      {
        action();
        return 0;
      }
    catch (...)
      {
        if (!failure) // what failed first is the reason for the rest
          failure = std::current_exception();
        return -1;
      }
  }


  void
  BackwardEuler::throw_what_failed()
  {
    if (failure)
      std::rethrow_exception(failure);
    if (!arkode_message.empty())
      throw ComputationError("SUNDIALS says " + arkode_message);
  }


  void
  BackwardEuler::set_equation_callbacks()
  {
    ode.implicit_function = [this](const double time, const State &y, State &f) {
      return guarded([&] {
        f.block(0) = y.block(1);
        net_force(time, y, f.block(1));
        if (!all_finite(f.block(1)))
          throw ComputationError("the forces are not finite numbers");
      });
    };

    ode.mass_times_vector = [this](const double, const State &v, State &Mv) {
      return guarded([&] {
        Mv.block(0) = v.block(0);
        mass_product(Mv.block(1), v.block(1));
        model.constraints.copy_held(Mv.block(1), v.block(1));
      });
    };

    ode.solve_mass = [this](SUNDIALS::SundialsOperator<State> &,
                            SUNDIALS::SundialsPreconditioner<State> &,
                            State &x,
                            const State &b,
                            const double) {
      return guarded([&] {
        x.block(0) = b.block(0);
        solve_mass(x.block(1), b.block(1));
      });
    };

    ode.output_step = [this](const double, const State &, const unsigned int) {
      throw_what_failed();
    };
    ode.custom_setup = [this](void *memory) { set_options(memory); };
  }


  void
  BackwardEuler::set_solver_callbacks()
  {
    // ARKode wants it to be there, but the linear systems are solved without it.
    ode.jacobian_times_vector =
      [](const State &, State &, const double, const State &, const State &) { return -1; };

    ode.jacobian_preconditioner_setup = [this](const double,
                                               const State &y,
                                               const State &,
                                               const int,
                                               int &jacobian_is_current,
                                               const double new_gamma) {
      return guarded([&] {
        gamma = new_gamma;
        model.implicit_operator.assemble(gamma);
        model.solver.prepare(y.block(0));
        jacobian_is_current = 1;
      });
    };

    ode.jacobian_preconditioner_solve = [this](const double,
                                               const State &,
                                               const State &,
                                               const State &r,
                                               State &z,
                                               const double,
                                               const double,
                                               const int) {
      return guarded([&] { solve_eliminated(r, z); });
    };

    ode.solve_linearized_system = [this](SUNDIALS::SundialsOperator<State> &,
                                         SUNDIALS::SundialsPreconditioner<State> &elimination,
                                         State &x,
                                         const State &b,
                                         const double) {
      return guarded([&] { elimination.vmult(x, b); });
    };
  }


  void
  BackwardEuler::set_options(void *arkode_memory)
  {
    Compatibility::Real one        = 1.;
    const ARKodeButcherTable table = ARKodeButcherTable_Create(1, 1, 0, &one, &one, &one, nullptr);
    AssertThrow(ARKStepSetTables(arkode_memory, 1, 0, table, nullptr) == 0, ExcInternalError());
    ARKodeButcherTable_Free(table);

    ARKStepSetFixedStep(arkode_memory, model.parameters.time.step);
    ARKStepSetMaxNumSteps(arkode_memory, -1);

    // The default interpolant is of too high an order for this table and would spoil the results.
    ARKStepSetInterpolantType(arkode_memory, ARK_INTERP_LAGRANGE);
    ARKStepSetInterpolantDegree(arkode_memory, 1);

    ARKStepSetPredictorMethod(arkode_memory, 0);

    // The force at the end of the step follows from the solution of the linear system.
    ARKStepSetDeduceImplicitRhs(arkode_memory, 1);
    Compatibility::collect_arkode_errors(arkode_memory, arkode_message);
  }


  void
  BackwardEuler::net_force(const double time, const State &y, Vector &net)
  {
    const DampingParameters &damping = model.parameters.damping;

    // For fixed rotations the force is linear: f_int(u) + b K' v = f_int(u + b v).
    if (damping.stiffness_factor > 0.)
      {
        scratch = y.block(0);
        scratch.add(damping.stiffness_factor, y.block(1));
        model.body.internal_force(net, scratch, model.effort);
      }
    else
      model.body.internal_force(net, y.block(0), model.effort);
    net.sadd(-1., 1., model.loads.force(time, previous.block(0)));

    if (damping.mass_factor > 0.)
      {
        mass_product(scratch, y.block(1));
        net.add(-damping.mass_factor, scratch);
      }
    if (damping.viscous > 0.)
      net.add(-damping.viscous, y.block(1));
    model.constraints.set_zero(net);
    if (model.constraints.move())
      model.constraints.copy_held(net, prescribed_acceleration);
  }


  void
  BackwardEuler::mass_product(Vector &y, const Vector &x) const
  {
    if (model.constraints.move())
      full_mass_product(y, x);
    else
      model.implicit_operator.mass_vmult(y, x);
  }


  void
  BackwardEuler::full_mass_product(Vector &y, const Vector &x) const
  {
    const GhostValues values(x);
    sum_into(y, [&](double *sum) { model.body.tetrahedra->add_mass_product(values.data(), sum); });
  }


  /** Backward Euler takes held vertices where they shall be: u1 = u0 + dt v1, v1 = v0 + dt a. */
  void
  BackwardEuler::set_prescribed_acceleration(const State &state, const double time)
  {
    const double dt = model.parameters.time.step;
    model.constraints.set_displacement(prescribed_acceleration, time);
    prescribed_acceleration -= state.block(0);
    prescribed_acceleration /= dt;
    prescribed_acceleration -= state.block(1);
    prescribed_acceleration /= dt;
  }


  void
  BackwardEuler::solve_eliminated(const State &r, State &z)
  {
    if (model.constraints.move())
      eliminate_prescribed(r);
    else
      {
        model.implicit_operator.stiffness_vmult(scratch, r.block(0));
        scratch.sadd(-gamma, 1., r.block(1));
      }
    model.constraints.set_zero(scratch);
    linear_iterations += model.solver.solve(z.block(1), scratch);
    if (model.constraints.move())
      model.constraints.copy_held(z.block(1), r.block(1));

    velocity_increment = z.block(1);
    z.block(0)         = r.block(0);
    z.block(0).add(gamma, z.block(1));
  }


  /** The right hand side r_v - g K' r_u - A z, where z is what is known of z_v: its held entries,
   * those of r_v. */
  void
  BackwardEuler::eliminate_prescribed(const State &r)
  {
    const DampingParameters &damping = model.parameters.damping;
    Vector known;
    model.body.initialize(known);
    model.constraints.copy_held(known, r.block(1));
    full_mass_product(scratch, known);
    scratch.sadd(-(1. + gamma * damping.mass_factor), 1., r.block(1));

    known *= gamma * gamma + gamma * damping.stiffness_factor;
    known.add(gamma, r.block(0));
    model.implicit_operator.stiffness_vmult(force, known);
    scratch -= force;
  }


  void
  BackwardEuler::solve_mass(Vector &x, const Vector &b)
  {
    const PhaseTimer timer(model.effort, Phase::solve);

    x = velocity_increment;
    if (model.constraints.move())
      {
        Vector known;
        model.body.initialize(known);
        model.constraints.copy_held(known, b);
        full_mass_product(scratch, known);
        scratch.sadd(-1., 1., b);
        model.constraints.set_zero(scratch);
        model.constraints.set_zero(x);
      }
    else
      scratch = b;

    SolverControl control(1000, 1e-13 * scratch.l2_norm() + std::numeric_limits<double>::min());
    SolverCG<Vector> cg(control);
    try
      {
        cg.solve(MassProduct{model.implicit_operator}, x, scratch, MassDiagonal{inverse_mass});
      }
    catch (const SolverControl::NoConvergence &)
      {
        throw ComputationError("the system with the mass matrix was not solved");
      }
    if (model.constraints.move())
      model.constraints.copy_held(x, b);
  }


  StepReport
  BackwardEuler::advance(State &state, const double time, const bool observed)
  {
    StepReport report;
    report.dt         = model.parameters.time.step;
    previous          = state;
    linear_iterations = 0;
    if (model.constraints.move())
      set_prescribed_acceleration(state, time);
    try
      {
        // The same sum as ARKode's own time: one step of just this size, with just this gamma.
        ode_time += report.dt;
        ode.solve_ode_incrementally(state, ode_time);
        throw_what_failed();
        if (!all_finite(state.block(0)) || !all_finite(state.block(1)))
          throw ComputationError("the motion is not finite any more");
      }
    catch (...)
      {
        state = previous;
        throw_what_failed();
        throw;
      }
    report.linear_iterations = linear_iterations;

    // dt/2 |v1 - v0| estimates the local error dt^2/2 |u''| of u.
    report.local_error =
      0.5 * report.dt * largest_vertex_distance(state.block(1), previous.block(1));

    if (observed)
      observe(state, time, report);
    model.body.update_rotations(state.block(0), model.effort);
    return report;
  }


  /**
   * Backward Euler with the rotations of the step gives, with the change d of a quantity over the
   * step, d(kinetic) + 1/2 dv.M dv + dt v1.D v1 + f_int(u1).du = f1.du, and all but the first term
   * on the left is what the step expended.
   */
  void
  BackwardEuler::observe(const State &state, const double time, StepReport &report)
  {
    const PhaseTimer timer(model.effort, Phase::diagnostics);
    const DampingParameters &damping = model.parameters.damping;
    const Vector &v                  = state.block(1);
    Vector du = state.block(0), dv = v;
    du -= previous.block(0);
    dv -= previous.block(1);

    full_mass_product(scratch, dv);
    report.expended = 0.5 * (dv * scratch);

    Effort uncounted; // these forces are for the eye alone
    model.body.internal_force(force, state.block(0), uncounted);
    report.expended += force * du;

    // Reactions: M a + D v + f_int - f, on all nodes.
    force.add(1. / report.dt, scratch);
    if (damping.any())
      {
        Vector damping_force = v;
        damping_force *= damping.viscous;
        full_mass_product(scratch, v);
        damping_force.add(damping.mass_factor, scratch);
        {
          const GhostValues values(v);
          sum_into(scratch, [&](double *sum) {
            model.body.tetrahedra->add_stiffness_product(values.data(), sum);
          });
        }
        damping_force.add(damping.stiffness_factor, scratch);
        report.expended += report.dt * (v * damping_force);
        force += damping_force;
      }
    force -= model.loads.force(time, previous.block(0));
    set_reactions(force);

    if (model.loads.any_applied())
      report.load_work = model.loads.applied_force(time, previous.block(0)) * du;
    if (model.constraints.move())
      report.load_work += reactions() * du;
  }
} // namespace Supple
