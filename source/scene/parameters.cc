#include <supple/scene/parameters.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>
#include <supple/input/entries.h>

#include <deal.II/base/utilities.h>

#include <regex>
#include <sstream>

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
    add(prm,
        "Warp tolerance",
        warp_tolerance,
        "degrees",
        Range::at_least(0),
        "The matrix of a step keeps the stiffness of cells that have turned by no more than this "
        "angle since it was taken; forces are always those of the rotations now. Where no cell has "
        "turned by more, matrix, factor and multigrid stay as they are. 0: all cells, in each "
        "step (doc/performance.md).");
    prm.leave_subsection();
  }


  void
  CorotationParameters::check(const Parameters &parameters) const
  {
    if (warp_tolerance == 0.)
      return;
    const std::string origin   = parameters.origin("Corotation/Warp tolerance");
    const TimeParameters &time = parameters.time;
    if (time.problem == TimeParameters::Problem::stationary)
      throw InputError(origin + ": a static problem takes its matrix anew; it must be 0.");
    if (parameters.material.cure != MaterialParameters::LockingCure::none)
      throw InputError(origin +
                       ": with a volumetric locking cure the matrix is taken anew in each step; "
                       "it must be 0.");
    if (rotation == RotationMethod::polar &&
        time.method != TimeParameters::Method::backward_euler &&
        time.tangent != TimeParameters::TangentChoice::frozen)
      throw InputError(origin + ": " + time.method_name() +
                       " takes the derivatives of the rotations, which change with the stress; it "
                       "must be 0, or Time/Tangent = frozen.");
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
        "Conjugate gradients that need more for one solution have failed: then auto takes another "
        "solver, and one that was asked for by name ends the run.");
    add(prm,
        "Threads",
        threads,
        "none",
        Range::whole_number(1),
        "At most, of each process, for cells, matrices and the finest level of multigrid; "
        "summary.json says how many there were. Each has 8000 cells at least, so that small bodies "
        "stay on one. The result depends on their number as it does on that of processes, within "
        "the tolerance, and not on the time.");
    prm.leave_subsection();
  }


  namespace
  {
    /** When frames are written, by each of OutputParameters::Frames. */
    void
    declare_frame_conditions(ParameterHandler &prm, OutputParameters &output)
    {
      add(prm,
          "Motion",
          output.motion,
          "fraction of the body's diameter",
          Range::between(0, infinity),
          "Adaptive: a frame is written when some vertex has moved this far since the last one.");
      add(
        prm,
        "Volume ratio change",
        output.volume_ratio_change,
        "none",
        Range::between(0, infinity),
        "Adaptive: a frame is written when the largest or smallest volume ratio passes that of all "
        "earlier frames by "
        "this much, and when the first cell is inverted.");
      add(prm,
          "Longest interval",
          output.longest_interval,
          "s",
          Range::at_least(0),
          "Adaptive: longest time without a frame; 0: no limit.");
      add(prm,
          "Every",
          output.every,
          "steps",
          Range::whole_number(1),
          "Frames = every: number of steps from frame to frame.");
      add(prm,
          "Interval",
          output.interval,
          "s",
          Range::between(0, infinity),
          "Frames = interval: time from frame to frame.");
    }
  } // namespace


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
    declare_frame_conditions(prm, *this);
    add(prm,
        "History",
        history,
        "none",
        Range::one_of("true|false"),
        "Whether history.csv, probes.csv and profiles are written.");
    add(prm,
        "Report",
        report,
        "none",
        Range::one_of("true|false"),
        "Whether report.html, a page with the moving body and its history, is written at the end, "
        "from the frames and tables there are.");
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
        "either is set, Ctrl-C and SIGTERM write one too, unless Corotation/Warp tolerance is "
        "greater than 0 and Every alone is set: then the run goes on from the last one.");
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
    corotation.check(*this);
    plane.check(*this);
    if (time.problem == TimeParameters::Problem::stationary && damping.any())
      throw InputError(origin("Time/Problem") +
                       ": a static problem knows no velocity; take the damping out of the scene.");
    if (time.problem == TimeParameters::Problem::stationary &&
        !Expression(start.velocity, 3, origin("Start/Velocity")).is_zero())
      throw InputError(origin("Start/Velocity") + ": a static problem (" + origin("Time/Problem") +
                       ") knows no velocity; it must be 0; 0; 0.");
  }


  Parameters
  Parameters::read(const std::string &file, const std::vector<Override> &overrides)
  {
    Parameters parameters;
    ParameterHandler prm;
    parameters.declare(prm);
    parameters.file         = ParameterFile(file);
    parameters.scene_name   = parameters.file.name();
    parameters.scene_folder = parameters.file.folder();
    parameters.file.parse(prm, overrides);

    std::ostringstream used;
    prm.print_parameters(used, ParameterHandler::PRM);
    parameters.as_used = used.str();

    parameters.check();
    return parameters;
  }


  std::string
  Parameters::output_folder() const
  {
    return output.folder.empty() ? "output/" + scene_name : output.folder;
  }


  std::string
  Parameters::origin(const std::string &entry) const
  {
    return file.origin(entry);
  }


  void
  Parameters::print(std::ostream &out) const
  {
    out << as_used;
  }


  std::vector<std::pair<std::string, std::string>>
  named_list(const std::string &text, const std::string &origin)
  {
    std::vector<std::pair<std::string, std::string>> list;
    for (const std::string &item : dealii::Utilities::split_string_list(text, ';'))
      {
        if (item.empty())
          continue;
        std::smatch found;
        if (!std::regex_match(item, found, std::regex("([A-Za-z_][A-Za-z_0-9]*)\\s*:\\s*(.+)")))
          throw InputError(origin + ": '" + item +
                           "' is not of the form name: value (a name has letters, digits and _).");
        for (const auto &[name, value] : list)
          if (name == found[1])
            throw InputError(origin + ": the name '" + name + "' is given twice.");
        list.emplace_back(found[1], found[2]);
      }
    return list;
  }


  unsigned int
  boundary_id(const std::string &text, const std::string &origin)
  {
    if (text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos)
      throw InputError(origin + ": '" + text + "' is no boundary id.");
    return std::stoul(text);
  }
} // namespace Supple
