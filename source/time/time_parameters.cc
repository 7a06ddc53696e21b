#include <supple/time/time_parameters.h>

#include <supple/base/error.h>
#include <supple/input/entries.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using dealii::ParameterHandler;
  using namespace Entries;

  namespace
  {
    using Method = TimeMethod;

    const std::vector<std::pair<std::string, Method>> methods = {
      {"backward euler", Method::backward_euler},
      {"implicit backward euler", Method::implicit_backward_euler},
      {"implicit midpoint", Method::implicit_midpoint},
      {"sdirk2", Method::sdirk2},
      {"trbdf2", Method::trbdf2},
      {"esdirk3", Method::esdirk3},
      {"esdirk4", Method::esdirk4},
      {"esdirk5", Method::esdirk5},
      {"imex3", Method::imex3},
      {"imex4", Method::imex4},
      {"imex5", Method::imex5},
      {"explicit2", Method::explicit2},
      {"explicit3", Method::explicit3},
      {"explicit4", Method::explicit4},
      {"explicit5", Method::explicit5},
      {"ida", Method::ida}};


    void
    declare_method(ParameterHandler &prm, TimeMethod &method)
    {
      add_choice(
        prm,
        "Method",
        method,
        methods,
        "How a dynamic problem steps in time. backward euler: first order, one linear system a "
        "step, the rotations of the cells frozen at its start; it damps. implicit backward euler: "
        "the same with rotations that follow, by Newton's method. implicit midpoint: second order, "
        "damps nothing. sdirk2, trbdf2, esdirk3, esdirk4, esdirk5: diagonally implicit Runge-Kutta "
        "methods of that order. imex3, imex4, imex5: semi-implicit Runge-Kutta methods of that "
        "order, whose stages are one linear system each, all with the same matrix: the rotations "
        "of "
        "the cells follow explicitly, which limits the step. explicit2 to explicit5: Runge-Kutta "
        "methods for soft or tiny bodies with lumped mass. ida: backward differentiation with "
        "variable steps.");
    }
  } // namespace


  std::string
  TimeParameters::method_name() const
  {
    for (const auto &[name, candidate] : methods)
      if (candidate == method)
        return name;
    return "";
  }


  bool
  TimeParameters::is_explicit() const
  {
    return method == Method::explicit2 || method == Method::explicit3 ||
           method == Method::explicit4 || method == Method::explicit5;
  }


  bool
  TimeParameters::ends_with_stage() const
  {
    switch (method)
      {
        case TimeMethod::backward_euler:
        case TimeMethod::implicit_backward_euler:
        case TimeMethod::trbdf2:
        case TimeMethod::esdirk3:
        case TimeMethod::esdirk4:
        case TimeMethod::esdirk5:
          return true;
        default:
          return false;
      }
  }


  bool
  TimeParameters::is_semi_implicit() const
  {
    return method == Method::imex3 || method == Method::imex4 || method == Method::imex5;
  }


  MatrixUse
  TimeParameters::matrix_use() const
  {
    if (problem == Problem::dynamic && is_semi_implicit())
      return MatrixUse::many_systems;
    const bool one = problem == Problem::dynamic && method == TimeMethod::backward_euler;
    return one ? MatrixUse::one_system : MatrixUse::some_systems;
  }


  unsigned int
  TimeParameters::order() const
  {
    switch (method)
      {
        case Method::backward_euler:
        case Method::implicit_backward_euler:
          return 1;
        case Method::implicit_midpoint:
        case Method::sdirk2:
        case Method::trbdf2:
        case Method::explicit2:
          return 2;
        case Method::esdirk3:
        case Method::imex3:
        case Method::explicit3:
          return 3;
        case Method::esdirk4:
        case Method::imex4:
        case Method::explicit4:
          return 4;
        case Method::esdirk5:
        case Method::imex5:
        case Method::explicit5:
          return 5;
        case Method::ida:
          return maximum_order;
      }
    return 1;
  }


  bool
  TimeParameters::has_variable_steps() const
  {
    return adaptive || method == Method::ida;
  }


  double
  TimeParameters::end() const
  {
    return problem == Problem::stationary ? 1. : n_steps * step;
  }


  double
  TimeParameters::next_stop(const double time) const
  {
    const double later = time + 2. * moment();
    double stop        = last_end();
    const auto instant = std::upper_bound(instants.begin(), instants.end(), later);
    if (instant != instants.end())
      stop = std::min(stop, *instant);
    if (stop_interval > 0.)
      stop = std::min(stop, stop_interval * (std::floor(later / stop_interval) + 1.));
    return stop;
  }


  bool
  TimeParameters::is_instant(const double time) const
  {
    const auto next = std::lower_bound(instants.begin(), instants.end(), time - moment());
    return next != instants.end() && *next <= time + moment();
  }


  double
  TimeParameters::derivative_interval() const
  {
    return 1e-4 * step;
  }


  void
  TimeParameters::check(const ParameterFile &scene) const
  {
    if (adaptive &&
        (method == Method::backward_euler || method == Method::implicit_backward_euler ||
         method == Method::implicit_midpoint))
      throw InputError(scene.origin("Time/Variable steps") + ": " + method_name() +
                       " has no error estimate to choose steps by. Take ida with Maximum order = 1 "
                       "(backward Euler with variable steps), trbdf2 or esdirk4.");
    if (energy_guard == EnergyGuard::reject && has_variable_steps())
      throw InputError(
        scene.origin("Time/Energy guard") +
        ": only fixed steps can be done again. Take warn, or Variable steps = false.");

    if (method == Method::ida && maximum_order > 5)
      throw InputError(scene.origin("Time/Maximum order") + ": it can be 5 at most.");
    if (estimate_error && problem == Problem::stationary)
      throw InputError(scene.origin("Time/Estimate error") +
                       ": a static problem has no steps in time; it must be false.");
  }


  void
  TimeParameters::declare_tolerances(ParameterHandler &prm)
  {
    add(prm,
        "Relative tolerance",
        relative_tolerance,
        "none",
        Range::between(0, 1),
        "Variable steps: the local error of each displacement and velocity may be this fraction of "
        "it.");
    add(prm,
        "Displacement tolerance",
        displacement_tolerance,
        "m",
        Range::at_least(0),
        "Variable steps: what is added to that. 0: the relative tolerance times 1 % of the "
        "diameter.");
    add(prm,
        "Velocity tolerance",
        velocity_tolerance,
        "m/s",
        Range::at_least(0),
        "Variable steps: the same for velocities. 0: that of the displacement over the time a "
        "pressure "
        "wave takes through the body.");
    add(prm,
        "Longest step",
        longest_step,
        "s",
        Range::at_least(0),
        "Variable steps: no step is longer. 0: any. Those of explicit methods are "
        "never longer than the stable step.");
    add(
      prm,
      "Maximum order",
      maximum_order,
      "none",
      Range::whole_number(1),
      "ida: highest order of its formulas, 1 to 5. Orders above 2 are not stable for motions that "
      "hardly decay.");
  }


  void
  TimeParameters::declare_renewal_angle(ParameterHandler &prm)
  {
    add(prm,
        "Renewal angle",
        renewal_angle,
        "degrees",
        Range::at_least(0),
        "imex3 to imex5: the matrix has the rotations of the cells as they were when it was made, "
        "and is made anew when one has turned by more than this, when a variable step is another "
        "one, or after a step that was rejected. 0: in every step. 180: never for that reason. It "
        "changes the error little, but an old matrix makes long steps unstable.");
  }


  void
  TimeParameters::declare_newton(ParameterHandler &prm)
  {
    add(prm,
        "Newton tolerance",
        newton_tolerance,
        "none",
        Range::between(0, 1),
        "A static step is done when the forces out of balance are below this fraction of the loads "
        "on the body at rest and of the reactions; a stage of a fixed step when its correction is "
        "below this fraction of the "
        "motion "
        "or of 1 % of the body's diameter.");
    add(prm,
        "Newton iterations",
        newton_limit,
        "none",
        Range::whole_number(1),
        "A static step, or a stage of a fixed step, that needs more has failed.");
    add_choice(
      prm,
      "Tangent",
      tangent,
      {{"auto", Tangent::automatic},
       {"frozen", Tangent::frozen},
       {"consistent", Tangent::consistent},
       {"definite", Tangent::definite}},
      "The operator of Newton's method for polar rotations: as if the rotations stayed what they "
      "are, the derivative of the force, or its projection cell by cell to one that is not "
      "indefinite. auto takes the derivative, and the projection where that fails.");
    add(prm,
        "Retries",
        n_retries,
        "none",
        Range::whole_number(0),
        "A fixed step that fails is tried again in halves, at most this many times.");
  }


  void
  TimeParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Time");
    add_choice(prm,
               "Problem",
               problem,
               {{"dynamic", Problem::dynamic}, {"static", Problem::stationary}},
               "Motion in time, or equilibrium under the loads at time 1, which grow in steps.");
    declare_method(prm, method);
    add(prm,
        "Step",
        step,
        "s",
        Range::between(0, infinity),
        "Time step of a dynamic problem; with variable steps the first one that is tried.");
    add(
      prm,
      "Steps",
      n_steps,
      "none",
      Range::whole_number(1),
      "Number of time steps, or of load steps of a static problem. With variable steps the motion "
      "ends at this many times Step all the same.");
    add_choice(
      prm,
      "Variable steps",
      adaptive,
      {{"true", true}, {"false", false}},
      "Whether the step follows from the tolerances below. Methods with an error estimate: sdirk2, "
      "trbdf2, esdirk3 to esdirk5, imex3 to imex5, explicit2 to explicit5; ida always.");
    declare_tolerances(prm);
    declare_renewal_angle(prm);
    declare_newton(prm);
    add_choice(
      prm,
      "Energy guard",
      energy_guard,
      {{"off", EnergyGuard::off}, {"warn", EnergyGuard::warn}, {"reject", EnergyGuard::reject}},
      "What is done when the total energy rises by more than the work of a step: nothing, a "
      "warning at the end, or the step is done again, backward euler with rotations that follow, "
      "and then in halves, as often as Retries says (fixed steps only). Where the energy still "
      "rises in the smallest of them, the guard gives up for the rest of that step, which may "
      "raise it further, and warns as with warn.");
    add_choice(
      prm,
      "Estimate error",
      estimate_error,
      {{"true", true}, {"false", false}},
      "Whether a second run with half the step, or a tenth of the tolerances, moves along: how far "
      "the two are apart tells the error. It takes two to three times the time of the run; errors "
      "above a tenth of the motion a third run, and four times more (doc/error.md).");
    prm.leave_subsection();
  }
} // namespace Supple
