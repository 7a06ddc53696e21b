#include <supple/study/study_parameters.h>

#include <supple/base/error.h>
#include <supple/input/entries.h>

#include <deal.II/base/patterns.h>

#include <cstdlib>
#include <limits>
#include <regex>

namespace Supple
{
  using dealii::ParameterHandler;

  namespace
  {
    const std::string section = "Study";
  } // namespace


  StudyParameters::StudyParameters()
    : TaskParameters(section)
  {
  }


  bool
  StudyParameters::is_study(const std::string &file)
  {
    return ParameterFile::has_alone(file, section);
  }


  void
  StudyParameters::declare_runs(ParameterHandler &prm)
  {
    const dealii::Patterns::Anything any;
    prm.add_parameter("Scene",
                      scene,
                      "Parameter file of the scene that all runs are made of. Unit: none. Range: a "
                      "file, relative to the folder of the study.",
                      any);
    prm.add_parameter("Overrides",
                      overrides,
                      "What is different from the scene in all runs. Unit: none. Range: "
                      "Section/Entry=value, set apart by |.",
                      any);
    prm.add_parameter(
      "Methods",
      methods,
      "Compares methods in time, each with several steps or tolerances, such as backward euler: "
      "steps 0.07, 0.07/2; trbdf2 [Time/Tangent=frozen]: steps 0.07; esdirk4: tolerances 1e-2, "
      "1e-3; ida order 1: tolerances 1e-3. Unit: s for steps, none for tolerances. Range: what "
      "Time/Method may be (and ida order N), overrides in brackets if there are any, steps or "
      "tolerances; set apart by semicolons.",
      any);
    prm.add_parameter(
      "Levels",
      levels,
      "Compares meshes from coarse to fine, such as 1 [Mesh/Box cubes=2, 8, 2]; 0.5 [Mesh/Box "
      "cubes=4, 16, 4]. Names that are numbers are the sizes of the cells, from which the observed "
      "order follows; otherwise it follows from the cube root of the volume per cell, or from the "
      "root of a triangle's area. With Methods too: all methods are run on each of these meshes, "
      "and the errors in space and in time are told beside the whole error. Unit: m. "
      "Range: name [overrides], set apart by semicolons.",
      any);
    prm.add_parameter("Variants",
                      variants,
                      "With Levels: all levels are run with each of these, such as linear "
                      "[Corotation/Rotation=none]; polar []. Unit: none. Range: name [overrides], "
                      "set apart by semicolons.",
                      any);
    prm.add_parameter("Cases",
                      cases,
                      "A row for each of these, such as long step [Time/Step=1]; fast "
                      "[Start/Velocity=0; 0; -400 | Time/Steps=10]. Behind a colon a case may have "
                      "a condition of its own, in place of Right if. Unit: none. Range: name "
                      "[overrides]: condition, set apart by semicolons.",
                      any);
    prm.add_parameter("Repeats",
                      repeats,
                      "How often each run is timed; the median counts. Timed runs write and "
                      "measure nothing, the errors are those of one more run. Unit: none. Range: "
                      "a whole number, 0 or greater.",
                      Range::whole_number(0));
    prm.add_parameter("Histories",
                      histories,
                      "Whether each run leaves its history.csv and probes.csv in a folder of its "
                      "own. Unit: none. Range: true or false.",
                      Range::one_of("true|false"));
  }


  void
  StudyParameters::declare_references(ParameterHandler &prm)
  {
    const dealii::Patterns::Anything any;
    prm.add_parameter(
      "Reference",
      reference,
      "The run that the others are measured against. With Methods such as esdirk5: step 1e-4 or "
      "esdirk4: tolerance 1e-8; it is run with half the step or a tenth of the tolerance as well: "
      "that counts, and how far the two are apart is told as the reference's own error. With "
      "Levels such as fine [Mesh/Box cubes=16, 64, 16], or two of these from coarse to fine: the "
      "last one counts. Unit: none. Range: as one of the methods or levels.",
      any);
    prm.add_parameter(
      "Reference level",
      reference_level,
      "With Methods and Levels: the mesh on which the Reference is run. On each of the levels it "
      "is "
      "run as well: the distance of a run to that is its error in time, and the distance of that "
      "to "
      "the one on this mesh is the error in space of the level. Unit: none. Range: as one of the "
      "levels.",
      any);
    prm.add_parameter(
      "Exact",
      exact,
      "Exact values in place of a reference. With Methods of columns of history.csv or probes.csv "
      "over time, such as tip.uz: 0.1*cos(7*t); with Levels and Cases of Columns, such as sag: "
      "-0.114. Unit: that of the column. Range: name: expression of t, set apart by semicolons.",
      any);
  }


  void
  StudyParameters::declare_errors(ParameterHandler &prm)
  {
    const dealii::Patterns::Anything any;
    prm.add_parameter(
      "Quantities",
      quantities,
      "With Methods: whose errors are found. probes: displacements of all points that the scene "
      "follows, over time, against the largest motion of these in the reference. final field: "
      "displacement of all vertices at the end, against the largest motion of a vertex. energy: "
      "total energy over time, against the largest kinetic or elastic energy. Or a column of "
      "history.csv or probes.csv over time, such as tip.fx, against its largest value. The first "
      "one is plotted. Unit: none. Range: probes, final field, energy or columns, set apart by "
      "commas.",
      any);
    prm.add_parameter(
      "Columns",
      columns,
      "Numbers of each run that stand in the table, such as sag: tip.uz; lowest: smallest "
      "min_volume_ratio; rises: falls dissipated; f: frequency tip.uz; newton: summary "
      "solver/newton_iterations. A column of history.csv or probes.csv is taken at the end; "
      "before it may stand first, largest, smallest, at and a time (between rows: interpolated), "
      "rises or falls (in how many steps it does), or frequency (of its swings about its middle "
      "[1/s]). summary takes a number out of summary.json. Unit: none. Range: name: what, set "
      "apart by semicolons.",
      any);
    prm.add_parameter(
      "Right if",
      right_if,
      "A run is right where this expression of the Columns holds, such as rises == 0 && abs(sag + "
      "0.114) < 0.001; a name with above_ before it is that number of the row above. Behind it may "
      "stand: or warning TEXT, or: or EXPRESSION with warning TEXT. A run that is not right, but "
      "has a warning with this text, and for which this expression holds, has the verdict warned "
      "in place of wrong. Unit: none. Range: an expression of names in Columns, or nothing.",
      any);
    prm.add_parameter(
      "Targets",
      targets,
      "For each of these errors the report says which run reaches it soonest. "
      "Unit: none. Range: positive numbers set apart by commas.",
      dealii::Patterns::List(Range::between(0, std::numeric_limits<double>::infinity()),
                             0,
                             dealii::Patterns::List::max_int_value));
  }


  void
  StudyParameters::declare_aim(ParameterHandler &prm)
  {
    const dealii::Patterns::Anything any;
    prm.add_parameter("Aim",
                      aim,
                      "Looks for the soonest run with an error in time below this, in place of a "
                      "comparison: method, and step or tolerance. Methods then names those that "
                      "are tried, such as imex5; esdirk4, without steps; none: all. For a scene "
                      "that is no study: supple SCENE.prm --aim \"1 %\". Unit: %. Range: a "
                      "percentage, such as 1 %, above 0 and at most 50.",
                      any);
    prm.add_parameter("Aim of",
                      aim_of,
                      "What the error of Aim is of, as in Quantities; nothing: of the "
                      "displacements of all followed points over time and of all vertices at the "
                      "end, against the largest motion. Unit: none. Range: probes, final field, "
                      "energy, a column of history.csv or probes.csv, such as tip.uz or clamp.fz; "
                      "or several of them, set apart by commas, of which the worst one counts.",
                      any);
    prm.add_parameter("Aim with mesh",
                      aim_with_mesh,
                      "Whether the error in space is part of the Aim: then finer meshes, with "
                      "linear and with quadratic cells, are tried too. The error is told of points "
                      "that the scene follows, or of columns. In static scenes, which have no "
                      "error in time, it always is. Unit: none. Range: true or false.",
                      Range::one_of("true|false"));
  }


  void
  StudyParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection(section);
    declare_runs(prm);
    declare_references(prm);
    declare_aim(prm);
    declare_errors(prm);
    prm.leave_subsection();
  }


  StudyParameters
  StudyParameters::checked(const std::function<void(StudyParameters &, ParameterHandler &)> &parse)
  {
    StudyParameters study;
    ParameterHandler prm;
    study.declare(prm);
    parse(study, prm);
    study.check();
    return study;
  }


  StudyParameters
  StudyParameters::read(const std::string &file, const std::vector<Override> &overrides)
  {
    return checked(
      [&](StudyParameters &study, ParameterHandler &prm) { study.parse(prm, file, overrides); });
  }


  StudyParameters
  StudyParameters::aim_of_scene(const std::string &file, const std::vector<Override> &overrides)
  {
    return checked([&](StudyParameters &study, ParameterHandler &prm) {
      study.parse_for_scene(prm, file, overrides);
    });
  }


  double
  StudyParameters::relative_aim() const
  {
    std::smatch found;
    double value = 0.;
    if (std::regex_match(aim, found, std::regex("\\s*([0-9.]+([eE][-+]?[0-9]+)?)\\s*%\\s*")))
      value = std::strtod(found[1].str().c_str(), nullptr);
    if (!(value > 0. && value <= 50.))
      throw InputError(place("Aim") + " = " + aim +
                       ": it must be a percentage above 0 and at most 50, such as 1 %.");
    return 0.01 * value;
  }


  void
  StudyParameters::check_aim() const
  {
    relative_aim();
    for (const auto &[name, text] :
         std::vector<std::pair<std::string, std::string>>{{"Levels", levels},
                                                          {"Cases", cases},
                                                          {"Reference", reference},
                                                          {"Reference level", reference_level},
                                                          {"Exact", exact},
                                                          {"Columns", columns},
                                                          {"Right if", right_if}})
      if (!text.empty())
        throw InputError(place(name) +
                         ": it does not go with an Aim, which finds its runs and "
                         "their reference by itself.");
  }


  void
  StudyParameters::check() const
  {
    if (scene.empty())
      throw InputError(place("Scene") + ": a study needs a scene.");
    if (!aim.empty())
      {
        check_aim();
        return;
      }
    if (!aim_of.empty() || aim_with_mesh)
      throw InputError(place(aim_with_mesh ? "Aim with mesh" : "Aim of") +
                       ": without an Aim it says nothing.");
    const bool both   = !methods.empty() && !levels.empty();
    const int n_kinds = (!methods.empty() || !levels.empty()) + !cases.empty();
    if (n_kinds != 1)
      throw InputError(place("Methods") + ": " + (n_kinds == 0 ? "none" : "more than one") +
                       " of Methods, Levels and Cases is set; a study has one of them, or Methods "
                       "and Levels.");
    if (both && (reference.empty() || reference_level.empty() || !exact.empty()))
      throw InputError(place("Levels") +
                       ": with Methods they need a Reference and the Reference level on which it "
                       "is run, in place of Exact values.");
    if (!both && !reference_level.empty())
      throw InputError(place("Reference level") + ": it goes with Methods and Levels together.");
    if (both && !variants.empty())
      throw InputError(place("Variants") + ": they go with Levels without Methods.");
    if (!variants.empty() && levels.empty())
      throw InputError(place("Variants") + ": they go with Levels.");
    if (!methods.empty() && reference.empty() == exact.empty())
      throw InputError(place("Methods") + ": methods are compared with a Reference or with Exact " +
                       "values; " + (exact.empty() ? "neither" : "not both") + " is right.");
    if (!levels.empty() && !both && (columns.empty() || reference.empty() == exact.empty()))
      throw InputError(place("Levels") +
                       ": levels need Columns, and a Reference or Exact values of these.");
    if (!cases.empty() && columns.empty())
      throw InputError(place("Cases") +
                       ": cases need Columns, the numbers that stand in the table.");
    if (!cases.empty() && !reference.empty())
      throw InputError(place("Reference") + ": it goes with Methods and Levels.");
  }
} // namespace Supple
