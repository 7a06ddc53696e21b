#include <supple/identification/identification_parameters.h>

#include <supple/base/error.h>
#include <supple/input/entries.h>

#include <algorithm>

namespace Supple
{
  using dealii::ParameterHandler;
  using Entries::add;
  using Entries::add_choice;
  using Entries::infinity;

  namespace
  {
    const std::string section     = "Identification";
    const unsigned int any_number = dealii::Patterns::List::max_int_value;


    RangeList
    positive_numbers()
    {
      const Range positive = Range::between(0, infinity);
      return {"numbers set apart by commas, each " + positive.description() + ", or nothing",
              positive,
              0,
              any_number};
    }
  } // namespace


  IdentificationParameters::IdentificationParameters()
    : TaskParameters(section)
  {
  }


  bool
  IdentificationParameters::is_identification(const std::string &file)
  {
    return ParameterFile::has_alone(file, section);
  }


  void
  IdentificationParameters::declare_comparison(ParameterHandler &prm)
  {
    using Correction = SurfaceComparison::Correction;
    using Norm       = SurfaceComparison::Norm;
    using Side       = SurfaceComparison::Side;
    add_choice(prm,
               "Side",
               comparison.side,
               {{"left", Side::left}, {"right", Side::right}, {"both", Side::both}},
               "Which half of the surface is compared, seen from the needle: smaller x, larger x, "
               "or both. A body that ends at the needle, axisymmetric or a quarter, has its right "
               "one alone.");
    add_choice(prm,
               "Depth correction",
               comparison.correction,
               {{"converged", Correction::converged}, {"thesis", Correction::thesis}},
               "How the depth of the needle, which was not measured, is found. converged: so that "
               "the surface goes through the first point of a set. thesis: two passes of depth -= "
               "deviation at the first point, from the depth of the pair before; of the first "
               "pair, from Start depths.");
    add(prm,
        "Start depths",
        start_depths,
        "that of Unit",
        positive_numbers(),
        "With Depth correction = thesis: a depth for each set.");
    add_choice(prm,
               "Error",
               comparison.norm,
               {{"rms", Norm::rms}, {"thesis", Norm::thesis}, {"largest", Norm::largest}},
               "What the n deviations e of a set are put together to. rms: sqrt(sum e^2 / n). "
               "thesis: sqrt(sum e^2) / n. largest: max |e|.");
  }


  void
  IdentificationParameters::declare_fit(ParameterHandler &prm)
  {
    add(prm,
        "Fit",
        fit,
        "none",
        Range::one_of("true|false"),
        "Whether the best pair is looked for between those of the grid too, inside its bounds, "
        "from the best of these on. The thickness then takes any value: the scene needs "
        "Mesh/Layer rows.");
    add_choice(prm,
               "Fit total",
               fitted,
               {{"root of squares", Total::root_of_squares},
                {"sum", Total::sum},
                {"maximum", Total::maximum}},
               "Which number of the errors of all sets is made small.");
    add(prm,
        "Fit tolerance",
        tolerance,
        "none",
        Range::between(0, infinity),
        "The range of a fit: all pairs whose error exceeds the least one by this part of it at "
        "most.");
  }


  void
  IdentificationParameters::declare(ParameterHandler &prm)
  {
    const dealii::Patterns::Anything any;
    const RangeList sets_pattern("whole numbers set apart by commas, or nothing",
                                 Range::whole_number(0),
                                 0,
                                 any_number);
    prm.enter_subsection(section);
    prm.add_parameter("Scene",
                      scene,
                      "Parameter file of the needle in its skin: static, linear (Rotation = none), "
                      "with two layers and a profile. Thickness and modulus of the layers are "
                      "taken from here. Unit: none. Range: a file, relative to the folder of this "
                      "one.",
                      any);
    prm.add_parameter("Overrides",
                      overrides,
                      "What is different from the scene. Unit: none. Range: Section/Entry=value, "
                      "set apart by |.",
                      any);
    prm.add_parameter("Profile",
                      profile,
                      "Which of the scene's profiles (Probes/Profiles) is compared. In three "
                      "dimensions its vertices straight to the left and right of the needle "
                      "count. Unit: none. Range: a name.",
                      any);
    prm.add_parameter("Measurements",
                      measurements,
                      "CSV file that begins with the line set,distance,depth. Unit: that of Unit. "
                      "Range: a file, relative to the folder of this one.",
                      any);
    add(prm, "Sets", sets, "none", sets_pattern, "Which sets count; empty: all.");
    add_choice(prm,
               "Unit",
               unit,
               {{"mm", Unit::millimetre}, {"m", Unit::metre}},
               "Of the measurements, of all lengths in this file, and of the results.");
    add(prm,
        "Thicknesses",
        thicknesses,
        "that of Unit",
        positive_numbers(),
        "Of the upper layer; the lower one is the rest. The outer loop of the grid.");
    add(prm,
        "Elasticity ratios",
        ratios,
        "none",
        positive_numbers(),
        "Young modulus of the upper layer over that of the lower one, which is changed.");
    declare_comparison(prm);
    declare_fit(prm);
    prm.leave_subsection();
  }


  IdentificationParameters
  IdentificationParameters::read(const std::string &file, const std::vector<Override> &overrides)
  {
    IdentificationParameters parameters;
    ParameterHandler prm;
    parameters.declare(prm);
    parameters.parse(prm, file, overrides);
    parameters.check();
    parameters.check_command_line();
    parameters.measured = read_measurements(parameters.path(parameters.measurements),
                                            parameters.unit_length(),
                                            parameters.sets,
                                            parameters.place("Measurements"));
    parameters.check_start_depths();
    return parameters;
  }


  double
  IdentificationParameters::unit_length() const
  {
    return unit == Unit::millimetre ? 1e-3 : 1.;
  }


  std::string
  IdentificationParameters::unit_name() const
  {
    return unit == Unit::millimetre ? "mm" : "m";
  }


  std::vector<std::string>
  IdentificationParameters::total_names()
  {
    return {"sum", "maximum", "root of squares"};
  }


  void
  IdentificationParameters::check() const
  {
    if (scene.empty())
      throw InputError(place("Scene") + ": an identification needs a scene.");
    if (measurements.empty())
      throw InputError(place("Measurements") + ": an identification needs measurements, a CSV " +
                       "file with set, distance and depth.");
    for (const auto &[entry, list] : {std::make_pair("Thicknesses", &thicknesses),
                                      std::make_pair("Elasticity ratios", &ratios)})
      {
        if (list->empty())
          throw InputError(place(entry) + ": nothing is there; the grid needs numbers.");
        if (!std::is_sorted(list->begin(), list->end(), std::less_equal<>()))
          throw InputError(place(entry) + ": the numbers must ascend.");
      }
    if (fit && (thicknesses.size() < 2 || ratios.size() < 2))
      throw InputError(place("Fit") + ": the grid has to have at least two thicknesses and two " +
                       "ratios, the bounds of the fit.");
    if (fit && comparison.correction == SurfaceComparison::Correction::thesis)
      throw InputError(place("Fit") + ": the thesis's depths depend on the pair before; a fit " +
                       "needs Depth correction = converged.");
  }


  /** Material/By id stays open: the lower layer's Poisson ratio is taken from there. */
  void
  IdentificationParameters::check_command_line() const
  {
    for (const Override &override : command_line)
      for (const auto &[entry, set_by] :
           {std::make_pair("Time/Steps", "Scene"), std::make_pair("Mesh/Layers", "Thicknesses")})
        if (override.entry() == entry)
          override.refuse("identification", place(set_by));
  }


  void
  IdentificationParameters::check_start_depths() const
  {
    const bool thesis = comparison.correction == SurfaceComparison::Correction::thesis;
    if (start_depths.size() != (thesis ? measured.size() : 0))
      throw InputError(place("Start depths") + ": found " + std::to_string(start_depths.size()) +
                       (thesis ? "; the thesis's correction needs one for each of the " +
                                   std::to_string(measured.size()) + " sets."
                               : "; a converged correction needs none."));
  }
} // namespace Supple
