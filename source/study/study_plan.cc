#include <supple/study/study_plan.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>
#include <supple/base/text.h>
#include <supple/mesh/finer_mesh.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

namespace Supple
{
  using dealii::Utilities::trim;

  namespace
  {
    /** Names of runs are names of folders and rows: each must be there once. */
    void
    check_names(const std::vector<PlannedRun> &runs, const std::string &place)
    {
      std::set<std::string> names;
      for (const PlannedRun &run : runs)
        if (!names.insert(run.folder_name()).second)
          throw InputError(place + ": '" + run.label() + "' is there twice.");
    }


    /** A run on a level. */
    PlannedRun
    on_level(const StudyItem &level, const PlannedRun &run)
    {
      PlannedRun result = run;
      result.level      = level.name;
      result.curve      = level.name + ", " + run.curve;
      result.overrides  = level.overrides; // those of the method are stronger
      result.overrides.insert(result.overrides.end(), run.overrides.begin(), run.overrides.end());
      return result;
    }


    /** The override of an entry among these that counts, if there is one. */
    const Override *
    last_of(const std::vector<Override> &overrides, const std::string &entry)
    {
      const auto found =
        std::find_if(overrides.rbegin(), overrides.rend(), [&](const Override &override) {
          return override.entry() == entry;
        });
      return found == overrides.rend() ? nullptr : &*found;
    }
  } // namespace


  std::string
  PlannedRun::label() const
  {
    std::string text;
    for (const std::string &part : {level, series, name})
      if (!part.empty())
        text += (text.empty() ? "" : ", ") + part;
    return text;
  }


  std::string
  PlannedRun::folder_name() const
  {
    return std::regex_replace(label(), std::regex("[^A-Za-z0-9.+=-]+"), "_");
  }


  std::vector<StudyItem>
  study_items(const std::string &text, const std::string &place)
  {
    std::vector<StudyItem> items;
    for (const std::string &part : split_outside_brackets(text, ';'))
      {
        if (trim(part).empty())
          continue;
        std::smatch found;
        if (!std::regex_match(part,
                              found,
                              std::regex("\\s*(([^\\[\\]:]*[^\\[\\]:\\s])\\s*(\\[(.*)\\])?)\\s*"
                                         "(:\\s*([^\\[\\]]*))?")))
          throw InputError(place + ": '" + trim(part) +
                           "' is not of the form name [Section/Entry=value | Section/Entry=value]"
                           ": more, with or without brackets and more.");
        items.push_back(
          {trim(found[1]), trim(found[2]), override_list(found[4], place), trim(found[6])});
      }
    if (items.empty())
      throw InputError(place + ": nothing is there.");
    return items;
  }


  StudyPlan::StudyPlan(const StudyParameters &study)
    : kind(!study.aim.empty() || !study.methods.empty()
             ? Kind::methods // on one level or on several
           : !study.levels.empty() ? Kind::levels
                                   : Kind::cases)
    , base(study.read_scene())
    , task(study)
  {
    switch (kind)
      {
        case Kind::methods:
          if (study.aim.empty())
            plan_methods(study);
          else
            plan_aim(study);
          if (study.aim.empty() && !study.levels.empty())
            plan_methods_on_levels(study);
          break;
        case Kind::levels:
          plan_levels(study);
          break;
        case Kind::cases:
          plan_cases(study);
          break;
      }
    for (PlannedRun &run : runs)
      if (run.right_if.empty())
        run.right_if = study.right_if;
    check_command_line();
  }


  void
  StudyPlan::check_command_line() const
  {
    for (const Override &override : task.command_line)
      {
        const std::string entry = override.entry();
        // Steps of methods are told by the scene's end, which these make.
        if (kind == Kind::methods &&
            (entry == "Time/Step" || entry == "Time/Steps" || runs.empty()))
          continue;
        const auto sets_it = [&](const PlannedRun &run) {
          return last_of(run.overrides, entry) != nullptr;
        };
        if (std::all_of(runs.begin(), runs.end(), sets_it) &&
            std::all_of(references.begin(), references.end(), sets_it))
          override.refuse("study", last_of(runs.front().overrides, entry)->place);
      }
  }


  std::string
  StudyPlan::changed_by_hand(const std::vector<std::string> &entries) const
  {
    for (const std::string &entry : entries)
      for (const Override &override : task.command_line)
        if (override.entry() == entry)
          return base.origin(entry) + " does not go with ";
    return "";
  }


  Parameters
  StudyPlan::parameters(const PlannedRun &run) const
  {
    return task.read_scene(run.overrides);
  }


  PlannedRun
  StudyPlan::method_run(const StudyItem &item,
                        const std::string &word,
                        const std::string &number,
                        const std::string &place) const
  {
    const double value = Expression(number, 1, place).value(dealii::Point<3>(), 0.);
    if (!std::isfinite(value) || value <= 0.)
      throw InputError(place + ": '" + number + "' of " + item.title +
                       " is not a positive number.");

    PlannedRun run;
    run.series = run.curve = item.title;
    std::smatch found;
    const bool ida = std::regex_match(item.name, found, std::regex("ida order (\\d)"));
    run.overrides.push_back({"Time/Method=" + (ida ? "ida" : item.name), place});
    if (ida)
      run.overrides.push_back({"Time/Maximum order=" + found[1].str(), place});
    run.overrides.insert(run.overrides.end(), item.overrides.begin(), item.overrides.end());

    if (word == "tolerance")
      {
        run.name      = "tolerance " + number;
        run.tolerance = value;
        if (!ida && item.name != "ida")
          {
            run.curve += ", variable steps";
            run.overrides.push_back({"Time/Variable steps=true", place});
          }
        run.overrides.push_back({"Time/Relative tolerance=" + digits(value, all_digits), place});
        return run;
      }

    run.name             = "step " + number;
    run.step             = value;
    const double end     = base.time.end();
    const double n_steps = std::max(1., std::round(end / value));
    if (ida || item.name == "ida")
      throw InputError(place + ": ida has variable steps; it takes tolerances, not steps.");
    if (std::abs(n_steps * value - end) > 1e-9 * end || n_steps > 2e9)
      {
        std::ostringstream text;
        text << changed_by_hand({"Time/Step", "Time/Steps"}) << place << ": the step " << number
             << " of " << item.title << " does not divide the " << end << " s of the scene; " << end
             << "/" << n_steps << " does.";
        throw InputError(text.str());
      }
    run.overrides.push_back({"Time/Variable steps=false", place});
    run.overrides.push_back({"Time/Step=" + digits(value, all_digits), place});
    run.overrides.push_back({"Time/Steps=" + std::to_string(std::lround(n_steps)), place});
    return run;
  }


  void
  StudyPlan::plan_methods(const StudyParameters &study)
  {
    if (base.time.problem == TimeParameters::Problem::stationary)
      throw InputError(changed_by_hand({"Time/Problem"}) + study.place("Methods") +
                       ": the scene is static and has no method in time.");
    const std::string place = study.place("Methods");
    for (const StudyItem &item : study_items(study.methods, place))
      {
        std::smatch found;
        if (!std::regex_match(item.rest, found, std::regex("(step|tolerance)s?\\s+(.*)")))
          throw InputError(place + ": '" + item.title +
                           "' must be followed by ': steps' or ': tolerances' and numbers, such as "
                           "trbdf2: steps 0.1, 0.1/2.");
        for (const std::string &number : dealii::Utilities::split_string_list(found[2], ','))
          runs.push_back(method_run(item, found[1], number, place));
      }
    check_names(runs, place);
    if (!study.reference.empty())
      plan_method_reference(study);
  }


  void
  StudyPlan::plan_aim(const StudyParameters &study)
  {
    const bool stationary = base.time.problem == TimeParameters::Problem::stationary;
    aims_at_mesh          = stationary || study.aim_with_mesh;
    if (aims_at_mesh && (!can_be_cut(base.mesh, 2) || base.space.aim > 0.))
      throw InputError(study.place(stationary ? "Aim" : "Aim with mesh") +
                       ": it takes the scene's mesh with all edges cut in two, three and more. "
                       "Leave out Mesh/Refine, Mesh/Refine region and Space/Aim.");
    if (study.methods.empty())
      return;
    if (stationary)
      throw InputError(study.place("Methods") + ": the scene is static (" +
                       base.origin("Time/Problem") + ") and has no methods in time.");
    methods = study_items(study.methods, study.place("Methods"));
    for (const StudyItem &item : methods)
      {
        if (!item.rest.empty())
          throw InputError(study.place("Methods") + ": '" + item.rest + "' of " + item.title +
                           ": with an Aim steps and tolerances are what is looked for; it must "
                           "name methods alone.");
        parameters(method_run(item, "tolerance", "1e-3", study.place("Methods")));
      }
  }


  void
  StudyPlan::plan_method_reference(const StudyParameters &study)
  {
    const std::string place = study.place("Reference");
    const auto items        = study_items(study.reference, place);
    std::smatch found;
    if (items.size() != 1 ||
        !std::regex_match(items[0].rest, found, std::regex("(step|tolerance)s?\\s+([^,]*)")))
      throw InputError(place +
                       ": it must be one method with one step or tolerance, such as "
                       "esdirk5: step 1e-4.");
    const std::string word = found[1], number = found[2];
    const std::string finer = (word == "step" ? "(" + number + ")/2" : "(" + number + ")/10");
    references              = {method_run(items[0], word, number, place),
                               method_run(items[0], word, finer, place)};
  }


  void
  StudyPlan::plan_methods_on_levels(const StudyParameters &study)
  {
    const std::string place                  = study.place("Levels");
    const std::vector<PlannedRun> of_methods = std::move(runs);
    runs.clear();
    for (const StudyItem &level : study_items(study.levels, place))
      {
        for (const PlannedRun &run : of_methods)
          runs.push_back(on_level(level, run));
        level_references.push_back(on_level(level, references.back()));
      }
    check_names(runs, place);
    const std::string place_of_reference = study.place("Reference level");
    const auto items                     = study_items(study.reference_level, place_of_reference);
    if (items.size() != 1)
      throw InputError(place_of_reference +
                       ": it must be one mesh, such as fine [Mesh/Box cubes=16, 64, 16].");
    for (PlannedRun &run : references)
      run = on_level(items[0], run);
  }


  void
  StudyPlan::plan_levels(const StudyParameters &study)
  {
    const auto levels = study_items(study.levels, study.place("Levels"));
    std::vector<StudyItem> variants(1);
    if (!study.variants.empty())
      variants = study_items(study.variants, study.place("Variants"));
    for (const StudyItem &variant : variants)
      for (const StudyItem &level : levels)
        {
          PlannedRun run;
          run.series = run.curve = variant.name;
          run.name               = level.name;
          for (const StudyItem *item : {&level, &variant})
            run.overrides.insert(run.overrides.end(),
                                 item->overrides.begin(),
                                 item->overrides.end());
          char *end         = nullptr;
          const double size = std::strtod(level.name.c_str(), &end);
          if (*end == '\0' && size > 0.)
            run.cell_size = size;
          runs.push_back(run);
        }
    check_names(runs, study.place("Levels"));

    const std::string place = study.place("Reference");
    if (!study.reference.empty())
      for (const StudyItem &item : study_items(study.reference, place))
        {
          PlannedRun run;
          run.name      = item.name;
          run.overrides = item.overrides;
          references.push_back(run);
        }
    if (references.size() > 2)
      throw InputError(place + ": one run, or two from coarse to fine; there are " +
                       std::to_string(references.size()) + ".");
  }


  void
  StudyPlan::plan_cases(const StudyParameters &study)
  {
    for (const StudyItem &item : study_items(study.cases, study.place("Cases")))
      {
        PlannedRun run;
        run.name      = item.name;
        run.overrides = item.overrides;
        run.right_if  = item.rest;
        runs.push_back(run);
      }
    check_names(runs, study.place("Cases"));
  }
} // namespace Supple
