#include <supple/parameters.h>

#include <supple/entries.h>
#include <supple/error.h>
#include <supple/expression.h>

#include <deal.II/base/utilities.h>

namespace Supple
{
  using dealii::ParameterHandler;
  namespace Patterns = dealii::Patterns;
  using namespace Entries;

  void
  CorotationParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Corotation");
    add_choice(
      prm,
      "Rotation",
      rotation,
      {{"none", RotationMethod::none},
       {"gram-schmidt", RotationMethod::gram_schmidt},
       {"polar", RotationMethod::polar}},
      "How the rotation of a cell is taken from its deformation gradient. none is linear "
      "elasticity, "
      "right for small rotations only. polar is the nearest rotation. gram-schmidt is there for "
      "comparison: its force has no energy and depends on the orientation of the axes.");
    prm.leave_subsection();
  }


  void
  DampingParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Damping");
    add(prm,
        "Mass factor",
        mass_factor,
        "1/s",
        Range::at_least(0),
        "Rayleigh damping: a in D = a M + b K'.");
    add(prm,
        "Stiffness factor",
        stiffness_factor,
        "s",
        Range::at_least(0),
        "Rayleigh damping: b in D = a M + b K'.");
    add(prm,
        "Viscous",
        viscous,
        "N s/m",
        Range::at_least(0),
        "Damping coefficient of each vertex against a resting world.");
    prm.leave_subsection();
  }


  bool
  DampingParameters::any() const
  {
    return mass_factor > 0. || stiffness_factor > 0. || viscous > 0.;
  }


  void
  ConstraintParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Constraints");
    add(prm,
        "Clamped boundaries",
        clamped_boundaries,
        "none",
        RangeList::boundary_ids(),
        "Boundaries whose vertices keep their place.");
    add(prm,
        "Clamped region",
        clamped_region,
        "none",
        Range::expressions(1),
        "Vertices at which this expression, such as y > 11.9, is true (not zero) keep their place. "
        "Empty: none.");
    for (unsigned int i = 0; i < 3; ++i)
      add(prm,
          std::string("Boundaries held along ") + "xyz"[i],
          sliding_boundaries[i],
          "none",
          RangeList::boundary_ids(),
          std::string("Boundaries whose vertices do not move along ") + "xyz"[i] +
            " but may slide otherwise: planes of symmetry.");
    prm.leave_subsection();
  }


  void
  MotionParameters::declare(ParameterHandler &prm, const std::string &section)
  {
    prm.enter_subsection(section);
    prm.add_parameter(
      "Of",
      of,
      "Which vertices are moved. Empty: none. Unit: m. Range: vertex and an index of the mesh, "
      "nearest to and a point, boundary and ids, region and an expression of x, y, z, or all.",
      dealii::Patterns::Anything());
    prm.add_parameter(
      "Displacement",
      displacement,
      "Displacement of these vertices from rest in time; in a static problem t is the load factor, "
      "from 0 to 1. A step at once is 0.01, a ramp 0.01*min(t/0.1, 1). Unit: m. Range: three "
      "expressions of x, y, z, t set apart by semicolons, or "
      "the "
      "word free for a direction that is not prescribed.",
      dealii::Patterns::Anything());
    prm.leave_subsection();
  }


  std::string
  Parameters::motion_section(const unsigned int motion)
  {
    return motion == 0 ? "Motion" : "Motion " + std::to_string(motion + 1);
  }


  void
  LoadParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Loads");
    add(prm,
        "Gravity",
        gravity,
        "m/s^2",
        RangeList::three(Range::finite()),
        "Acceleration by gravity.");
    add(prm,
        "Body force",
        body_force,
        "N/m^3",
        Range::expressions(3),
        "Force per volume at rest position and time.");
    add(prm,
        "Nodal force",
        nodal_force,
        "N",
        Range::expressions(3),
        "Force on each single vertex, at its place at rest and time.");
    prm.add_parameter(
      "Nodal force on",
      nodal_force_on,
      "Which vertices the nodal force acts on. Unit: none. Range: as Of in subsection Motion.",
      dealii::Patterns::Anything());
    add(prm,
        "Traction",
        traction,
        "Pa",
        Range::expressions(3),
        "Force per area at rest, at the place at rest and time.");
    add(prm,
        "Traction on",
        traction_on,
        "none",
        RangeList::boundary_ids(),
        "Where the traction acts.");
    add(prm,
        "Pressure",
        pressure,
        "Pa",
        Range::expressions(1),
        "Pressure that pushes on the surface from outside the body, such as blood on the wall of a "
        "vein; it may "
        "depend on t.");
    add(prm,
        "Pressure on",
        pressure_on,
        "none",
        RangeList::boundary_ids(),
        "Where the pressure acts.");
    add_choice(prm,
               "Pressure follows",
               pressure_follows,
               {{"true", true}, {"false", false}},
               "Whether the pressure acts on the surface as it is deformed (at the start of each "
               "step) or as it is at "
               "rest.");
    prm.leave_subsection();
  }


  void
  StartParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Start");
    add(prm,
        "Displacement",
        displacement,
        "m",
        Range::expressions(3),
        "Displacement at time 0, after the rotation below; zero where the body is held.");
    add(prm,
        "Velocity",
        velocity,
        "m/s",
        Range::expressions(3),
        "Velocity at time 0; zero where the body is held.");
    add(prm,
        "Rotation",
        rotation,
        "degrees",
        RangeList::three(Range::finite()),
        "Rotation of the body at time 0: the axis, as long as the angle. What is held keeps its "
        "place.");
    add(prm,
        "Rotation center",
        rotation_center,
        "m",
        RangeList::three(Range::finite()),
        "A point on the axis of this rotation.");
    prm.leave_subsection();
  }


  namespace
  {
    using Method = TimeParameters::Method;

    const std::vector<std::pair<std::string, Method>> methods = {
      {"backward euler", Method::backward_euler},
      {"implicit backward euler", Method::implicit_backward_euler},
      {"implicit midpoint", Method::implicit_midpoint},
      {"sdirk2", Method::sdirk2},
      {"trbdf2", Method::trbdf2},
      {"esdirk3", Method::esdirk3},
      {"esdirk4", Method::esdirk4},
      {"esdirk5", Method::esdirk5},
      {"explicit2", Method::explicit2},
      {"explicit3", Method::explicit3},
      {"explicit4", Method::explicit4},
      {"explicit5", Method::explicit5},
      {"ida", Method::ida}};
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
        case Method::explicit3:
          return 3;
        case Method::esdirk4:
        case Method::explicit4:
          return 4;
        case Method::esdirk5:
        case Method::explicit5:
          return 5;
        case Method::ida:
          return 0;
      }
    return 0;
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
  TimeParameters::derivative_interval() const
  {
    return 1e-4 * step;
  }


  void
  TimeParameters::check(const Parameters &parameters) const
  {
    if (adaptive &&
        (method == Method::backward_euler || method == Method::implicit_backward_euler ||
         method == Method::implicit_midpoint))
      throw InputError(parameters.origin("Time/Variable steps") + ": " + method_name() +
                       " has no error estimate to choose steps by. Take ida with Maximum order = 1 "
                       "(backward Euler with variable steps), trbdf2 or esdirk4.");
    if (energy_guard == EnergyGuard::reject && has_variable_steps())
      throw InputError(
        parameters.origin("Time/Energy guard") +
        ": only fixed steps can be done again. Take warn, or Variable steps = false.");

    if (method == Method::ida && maximum_order > 5)
      throw InputError(parameters.origin("Time/Maximum order") + ": it can be 5 at most.");
    if (is_explicit() && !parameters.material.lumped && parameters.material.vertex_mass == 0.)
      throw InputError(
        parameters.origin("Time/Method") +
        ": an explicit method needs a diagonal mass matrix: Material/Mass = lumped.");
    if (estimate_error && problem == Problem::stationary)
      throw InputError(parameters.origin("Time/Estimate error") +
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
        "Variable steps: no step is longer. 0: any.");
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
  TimeParameters::declare_newton(ParameterHandler &prm)
  {
    add(prm,
        "Newton tolerance",
        newton_tolerance,
        "none",
        Range::between(0, 1),
        "A static step is done when the forces out of balance are below this fraction of the loads "
        "and reactions; a stage of a fixed step when its correction is below this fraction of the "
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
      {{"auto", TangentChoice::automatic},
       {"frozen", TangentChoice::frozen},
       {"consistent", TangentChoice::consistent},
       {"definite", TangentChoice::definite}},
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
    add_choice(
      prm,
      "Method",
      method,
      methods,
      "How a dynamic problem steps in time. backward euler: first order, one linear system a "
      "step, the rotations of the cells frozen at its start; it damps. implicit backward euler: "
      "the same with rotations that follow, by Newton's method. implicit midpoint: second order, "
      "damps nothing. sdirk2, trbdf2, esdirk3, esdirk4, esdirk5: diagonally implicit Runge-Kutta "
      "methods of that order. explicit2 to explicit5: Runge-Kutta methods for soft or tiny "
      "bodies with lumped mass. ida: backward differentiation with variable steps.");
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
      "trbdf2, esdirk3 to esdirk5, explicit2 to explicit5; ida always.");
    declare_tolerances(prm);
    declare_newton(prm);
    add_choice(
      prm,
      "Tangent",
      tangent,
      {{"auto", TangentChoice::automatic},
       {"frozen", TangentChoice::frozen},
       {"consistent", TangentChoice::consistent},
       {"definite", TangentChoice::definite}},
      "The operator of Newton's method for polar rotations: as if the rotations stayed what they "
      "are, the derivative of the force, or its projection cell by cell to one that is not "
      "indefinite. auto takes the derivative, and the projection where that fails.");
    add(prm,
        "Retries",
        n_retries,
        "none",
        Range::whole_number(0),
        "A fixed step that fails is tried again in halves, at most this many times.");
    add_choice(
      prm,
      "Energy guard",
      energy_guard,
      {{"off", EnergyGuard::off}, {"warn", EnergyGuard::warn}, {"reject", EnergyGuard::reject}},
      "What is done when the total energy rises by more than the work of a step: nothing, a "
      "warning "
      "at the end, or the step is done again, backward euler with rotations that follow, and then "
      "in halves (fixed steps only).");
    add_choice(
      prm,
      "Estimate error",
      estimate_error,
      {{"true", true}, {"false", false}},
      "Whether a second run with half the step, or a tenth of the tolerances, moves along: "
      "from how far the two are apart follows the error. It takes two to three times the "
      "time of the run itself.");
    prm.leave_subsection();
  }


  void
  SolverParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Solver");
    add_choice(
      prm,
      "Method",
      method,
      {{"auto", Method::automatic},
       {"ldlt", Method::ldlt},
       {"cholmod", Method::cholmod},
       {"cg-amg", Method::cg_amg},
       {"cg-ml", Method::cg_ml},
       {"cg-jacobi", Method::cg_jacobi}},
      "Linear solver: Eigen's simplicial LDL^T (small bodies), CHOLMOD's supernodal Cholesky "
      "(middle), "
      "conjugate gradients with our own algebraic multigrid (large, or several processes), with "
      "Trilinos ML or with the inverted diagonal blocks. auto chooses by size.");
    add(
      prm,
      "Tolerance",
      tolerance,
      "none",
      Range::between(0, 1),
      "Conjugate gradients stop when the residual is below this fraction of the right hand side.");
    add(prm,
        "Iterations",
        iteration_limit,
        "none",
        Range::whole_number(1),
        "Conjugate gradients that need more have failed.");
    prm.leave_subsection();
  }


  void
  OutputParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    add(prm,
        "Folder",
        folder,
        "none",
        Patterns::Anything(),
        "Where results go; --output is stronger. Empty: output/ and the name of the scene.");
    add_choice(prm,
               "Frames",
               frames,
               {{"adaptive", Frames::adaptive},
                {"every", Frames::every},
                {"interval", Frames::interval},
                {"none", Frames::none}},
               "When a frame (VTU) is written: when something has happened, every so many steps, "
               "at intervals of time, "
               "or never. The first and the last state are always written, unless there are none.");
    add(prm,
        "Motion",
        motion,
        "fraction of the body's diameter",
        Range::between(0, infinity),
        "Adaptive: a frame is written when some vertex has moved this far since the last one.");
    add(prm,
        "Volume ratio change",
        volume_ratio_change,
        "none",
        Range::between(0, infinity),
        "Adaptive: a frame is written when the largest or smallest volume ratio passes that of all "
        "earlier frames by "
        "this much, and when the first cell is inverted.");
    add(prm,
        "Longest interval",
        longest_interval,
        "s",
        Range::at_least(0),
        "Adaptive: longest time without a frame; 0: no limit.");
    add(prm,
        "Every",
        every,
        "steps",
        Range::whole_number(1),
        "Frames = every: number of steps from frame to frame.");
    add(prm,
        "Interval",
        interval,
        "s",
        Range::between(0, infinity),
        "Frames = interval: time from frame to frame.");
    add(prm,
        "History",
        history,
        "none",
        Range::one_of("true|false"),
        "Whether history.csv, probes.csv and profiles are written.");
    prm.leave_subsection();
  }


  void
  ProbeParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Probes");
    const Patterns::Anything any;
    prm.add_parameter(
      "Points",
      points,
      "Named points, such as tip: 2, 0, 2; corner: vertex 7. The vertex nearest to "
      "each, or that of this index of the mesh, is followed. What is moved "
      "(subsection Motion) is followed in any case, as motion, motion2 ... Unit: m. "
      "Range: name: x, y, z, or name: vertex index, set apart by semicolons.",
      any);
    prm.add_parameter(
      "Boundaries",
      boundaries,
      "Named boundaries, such as wall: 3. Mean displacement and velocity of the vertices and the "
      "sum "
      "of their reactions. Unit: none. Range: name: boundary id, set apart by semicolons.",
      any);
    prm.add_parameter("Regions",
                      regions,
                      "Named regions, such as end: y < 0.1, as for boundaries. Unit: none. Range: "
                      "name: expression of x, "
                      "y, z, set apart by semicolons.",
                      any);
    prm.add_parameter("Profiles",
                      profiles,
                      "Named boundaries whose shape is written, such as skin: 3, into "
                      "profile_skin.csv: for each vertex its distance from the center below, its "
                      "depth -uy, and its deformed position. Unit: none. Range: name: boundary id, "
                      "set apart by semicolons.",
                      any);
    add(prm,
        "Profile center",
        profile_center,
        "m",
        RangeList::three(Range::finite()),
        "Where the needle is: distances in profiles are measured from there along x and z.");
    add(prm,
        "Profile every",
        profile_every,
        "steps",
        Range::whole_number(1),
        "Number of steps from profile to profile. The first and the last state are always "
        "written.");
    prm.leave_subsection();
  }


  void
  Parameters::declare(ParameterHandler &prm)
  {
    mesh.declare(prm);
    plane.declare(prm);
    material.declare(prm);
    corotation.declare(prm);
    damping.declare(prm);
    constraints.declare(prm);
    for (unsigned int m = 0; m < motions.size(); ++m)
      motions[m].declare(prm, motion_section(m));
    loads.declare(prm);
    start.declare(prm);
    time.declare(prm);
    solver.declare(prm);
    output.declare(prm);
    probes.declare(prm);
    checkpoint.declare(prm);
  }


  void
  CheckpointParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Checkpoint");
    add(prm,
        "Every",
        every,
        "steps",
        Range::whole_number(0),
        "A checkpoint, from which the run can go on, is written after so many steps; 0: not by "
        "steps.");
    add(prm,
        "Minutes",
        minutes,
        "min",
        Range::at_least(0),
        "A checkpoint is written after so much time on the clock; 0: not by the clock. Where "
        "either is "
        "set, Ctrl-C and SIGTERM write one too.");
    add_choice(
      prm,
      "Resume",
      resume,
      {{"auto", true}, {"never", false}},
      "auto: go on from the checkpoint in the output folder, if there is one. never: begin anew.");
    prm.leave_subsection();
  }


  void
  Parameters::check() const
  {
    if (3. * material.preset().lambda + 2. * material.preset().mu <= 0.)
      throw InputError(origin("Material/Lame lambda") +
                       ": 3 lambda + 2 mu must be positive, or the body gives way to pressure.");

    mesh.check(*this);
    time.check(*this);
    plane.check(*this);
    if (time.problem == TimeParameters::Problem::stationary && damping.any())
      throw InputError(origin("Time/Problem") +
                       ": a static problem knows no velocity; take the damping out of the scene.");
    if (time.problem == TimeParameters::Problem::stationary &&
        !Expression(start.velocity, 3, origin("Start/Velocity")).is_zero())
      throw InputError(origin("Start/Velocity") +
                       ": a static problem knows no velocity; it must be 0; 0; 0.");
  }
} // namespace Supple
