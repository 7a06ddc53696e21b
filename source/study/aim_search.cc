#include <supple/study/aim_search.h>

#include <supple/base/error.h>
#include <supple/base/files.h>
#include <supple/base/interrupt.h>
#include <supple/base/progress.h>
#include <supple/base/text.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

namespace Supple
{
  namespace
  {
    /** From the one that most often wins on. */
    const std::vector<std::string> all_methods =
      {"imex5", "imex4", "imex3", "esdirk4", "trbdf2", "explicit4", "esdirk5", "backward euler"};

    /** Of the reference: other methods than those that win. The first that a scene can have. */
    const std::vector<std::string> reference_methods = {"esdirk5", "esdirk4"};

    /** What the two runs of the reference may be apart, over the aim. */
    constexpr double largest_distance = 0.5;

    /** Below, round-off and the tolerances of linear solvers count. */
    constexpr double smallest_tolerance = 1e-9;

    /** What the search may take, over the run time of the best run; or some seconds, for where runs
     * take milliseconds it is their set-up that counts. */
    constexpr double longest_search = 8., shortest_search = 3.;

    /** What the error in time may have of an aim that is about the mesh too: short steps are
     * cheaper than small cells. With the orders q of the method and p of the cells it would be
     * (1/q) / (1/q + 3/p). */
    constexpr double share_of_time = 0.15;

    constexpr double nothing  = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();
  } // namespace


  AimSearch::AimSearch(const StudyParameters &study,
                       const std::string &folder,
                       const bool quiet,
                       const MPI_Comm communicator)
    : parameters(study)
    , output(folder, quiet, communicator)
    , plan(parameters)
    , quantities(parameters, plan)
    , runner(quantities.needed(), communicator)
    , whole_aim(parameters.relative_aim())
    , aim(plan.aims_at_mesh && !is_stationary() ? share_of_time * whole_aim : whole_aim)
    , best_seconds(infinity)
    , list(candidates())
  {
    table.kind        = plan.kind;
    table.name        = parameters.name;
    table.error_names = quantities.error_names();
    table.targets     = {aim};
    table.facts       = {parameters.scene_in_words(),
                         "Aim: " + percent(aim) + ". Error: " + quantities.error_meaning() + "."};
  }


  std::vector<AimSearch::Candidate>
  AimSearch::candidates() const
  {
    if (is_stationary())
      return {};
    std::vector<StudyItem> methods = plan.methods;
    if (methods.empty())
      for (const std::string &name : all_methods)
        methods.push_back({name, name, {}, ""});
    std::vector<Candidate> found;
    for (const StudyItem &method : methods)
      add_candidates(found, method);
    // variable steps first: they find their length by themselves, and that of fixed ones
    std::stable_partition(found.begin(), found.end(), [](const Candidate &candidate) {
      return candidate.variable_steps;
    });
    return found;
  }


  void
  AimSearch::add_candidates(std::vector<Candidate> &found, const StudyItem &method) const
  {
    for (const bool variable_steps : {true, false})
      {
        Candidate candidate{method, variable_steps, 1, AimCurve(1, variable_steps), {}};
        try
          {
            const double x       = variable_steps ? 1e-3 : plan.base.time.end() / 100.;
            const Parameters run = plan.parameters(planned(candidate, x));
            candidate.order      = run.time.order();
          }
        catch (const InputError &)
          {
            if (!plan.methods.empty() && found.empty() && !variable_steps)
              throw; // of the methods that were asked for this one can't be had at all
            continue;
          }
        candidate.curve = AimCurve(candidate.order, variable_steps);
        found.push_back(candidate);
      }
  }


  PlannedRun
  AimSearch::planned(const Candidate &candidate, const double x) const
  {
    const std::string place = parameters.place("Aim");
    if (candidate.variable_steps)
      return plan.method_run(candidate.method, "tolerance", digits(x, 3), place);
    const double end = plan.base.time.end();
    const long n     = std::max(1l, std::lround(std::ceil(end / x * (1. - 1e-9))));
    return plan.method_run(candidate.method,
                           "step",
                           digits(end, 10) + "/" + std::to_string(n),
                           place);
  }


  void
  AimSearch::check() const
  {
    output.say("Aim " + percent(whole_aim) + " of scene " + plan.base.scene_name +
               (is_stationary() ? ": finer meshes, in space alone"
                                : ": " + std::to_string(list.size()) + " methods, and a reference" +
                                    (plan.aims_at_mesh ? ", and finer meshes" : "")));
    runner.check(plan.base);
    for (const Candidate &candidate : list)
      output.say("  " + candidate.method.title +
                 (candidate.variable_steps ? ", variable steps" : ", fixed steps"));
  }


  bool
  AimSearch::is_stationary() const
  {
    return plan.base.time.problem == TimeParameters::Problem::stationary;
  }


  void
  AimSearch::run()
  {
    const InterruptGuard interrupt;
    runner.check(plan.base); // what is refused leaves an earlier study as it is
    std::vector<std::string> earlier = study_files();
    for (const std::string &name : study_files())
      earlier.push_back("meshes/" + name);
    output.open(earlier, [this] {
      write_whole_file(output.folder + "/study.csv", table.csv());
      if (plan.aims_at_mesh && !is_stationary())
        std::filesystem::create_directories(output.folder + "/meshes");
    });
    output.say("Supple " SUPPLE_VERSION ", the soonest run of " + plan.base.scene_name +
               " with an error of " + percent(whole_aim));
    std::vector<std::string> sentences;
    try
      {
        sentences = search_all(interrupt);
      }
    catch (const InterruptedError &)
      {
        throw InterruptedError("Interrupted; the runs so far are in " + output.folder +
                               "/study.csv.");
      }
    sentences.push_back("The search took " + readable_duration(stopwatch.seconds()) +
                        (reference_seconds > 0.
                           ? ", of which the reference " + readable_duration(reference_seconds)
                           : std::string()) +
                        ".");
    table.facts.insert(table.facts.end(), sentences.begin(), sentences.end());
    write();
    for (const std::string &sentence : sentences)
      output.say(sentence);
  }


  std::vector<std::string>
  AimSearch::search_all(const InterruptGuard &interrupt)
  {
    std::vector<std::string> sentences;
    if (!is_stationary())
      {
        search_in_time(interrupt);
        sentences = result(*winner());
      }
    if (plan.aims_at_mesh)
      for (const std::string &sentence : search_mesh(interrupt))
        sentences.push_back(sentence);
    return sentences;
  }


  void
  AimSearch::search_in_time(const InterruptGuard &interrupt)
  {
    find_reference();
    reference_seconds = dealii::Utilities::MPI::max(stopwatch.seconds(), output.communicator);
    const auto budget_is_spent = [this] {
      const double seconds =
        dealii::Utilities::MPI::max(stopwatch.seconds(), output.communicator); // one answer
      return seconds - reference_seconds > std::max(shortest_search, longest_search * best_seconds);
    };
    for (Candidate &candidate : list)
      {
        if (budget_is_spent())
          {
            table.facts.push_back(
              "Not tried, for the search had taken " + digits(longest_search, 2) +
              " times the run time of the best run: " + candidate.method.title +
              (candidate.variable_steps ? ", variable steps" : ", fixed steps") + ".");
            continue;
          }
        search(candidate);
        stop_if(interrupt);
      }
    if (!winner())
      {
        write();
        throw ComputationError("No run meets the aim of " + percent(aim) + in_time() +
                               ". What was tried is in " + output.folder + "/study.md.");
      }
  }


  std::string
  AimSearch::in_time() const
  {
    return plan.aims_at_mesh ? " in time" : "";
  }


  std::vector<MeshSearch::InTime>
  AimSearch::good_in_time() const
  {
    if (is_stationary())
      return {{{}, 0., 1.}};
    std::vector<const Candidate *> good;
    for (const Candidate &candidate : list)
      if (best_trial(candidate))
        good.push_back(&candidate);
    std::sort(good.begin(), good.end(), [this](const Candidate *one, const Candidate *other) {
      return best_trial(*one)->seconds < best_trial(*other)->seconds;
    });
    std::vector<MeshSearch::InTime> methods;
    for (const Candidate *candidate : good)
      methods.push_back({best_row(*candidate).run,
                         best_trial(*candidate)->error + reference_error,
                         candidate->curve.price_of_half()});
    return methods;
  }


  void
  AimSearch::stop_if(const InterruptGuard &interrupt) const
  {
    if (interrupt.requested(output.communicator))
      throw InterruptedError("Interrupted");
  }


  std::vector<std::string>
  AimSearch::search_mesh(const InterruptGuard &interrupt)
  {
    const auto after_run = [&](const StudyTable &meshes) {
      const StudyRow &row = meshes.rows.back();
      output.say(meshes.line(row) + (row.error_in_space < infinity
                                       ? " (in space " + percent(row.error_in_space) + ")"
                                       : std::string()));
      if (is_stationary())
        table.rows = meshes.rows;
      else if (output.root)
        write_study(output.folder + "/meshes", meshes);
      write();
      stop_if(interrupt);
    };
    MeshSearch search(plan, quantities, runner, good_in_time(), whole_aim, after_run);
    const auto mesh = search.search();
    if (!mesh)
      throw ComputationError("No mesh meets the aim of " + percent(whole_aim) +
                             ". What was tried is in " + output.folder +
                             (is_stationary() ? "" : "/meshes") + "/study.md.");
    if (mesh->error == 0.)
      refuse_rest();
    return result(*mesh);
  }


  void
  AimSearch::refuse_rest() const
  {
    throw ComputationError(parameters.place("Aim") + " = " + percent(whole_aim) +
                           ": two runs that should differ are the same: nothing moves of what the "
                           "aim is of, so that no error can be told.");
  }


  void
  AimSearch::refuse_aim(const double told) const
  {
    throw ComputationError(parameters.place("Aim") + " = " + percent(aim) +
                           ": no run can tell errors that small here: two of the reference are " +
                           percent(told) + " apart. An aim of " + percent(2.1 * told) +
                           " can be told.");
  }


  AimSearch::Candidate
  AimSearch::candidate_of_reference() const
  {
    std::string refusal;
    for (const std::string &name : reference_methods)
      {
        Candidate candidate{{name, name, {}, ""}, true, 1, AimCurve(1, true), {}};
        try
          {
            candidate.order = plan.parameters(planned(candidate, 1e-3)).time.order();
            candidate.curve = AimCurve(candidate.order, true);
            return candidate;
          }
        catch (const InputError &error)
          {
            refusal = error.what();
          }
      }
    throw InputError(parameters.place("Aim") +
                     ": no method with variable steps can tell the errors of this scene. " +
                     refusal);
  }


  void
  AimSearch::find_reference()
  {
    const Candidate method = candidate_of_reference();
    reference_method       = method.method.title;
    std::vector<std::pair<double, StudyRecord>> runs; // with their tolerances
    double distance  = nothing;
    double tolerance = std::min(1e-3, 0.1 * aim);
    for (; tolerance > smallest_tolerance; tolerance *= 0.1)
      {
        const PlannedRun run     = planned(method, tolerance);
        const StudyRecord record = runner.record(plan.parameters(run), "");
        if (record.status != StudyRecord::Status::done)
          throw ComputationError("The reference (" + run.label() + ") failed: " + record.reason);
        if (!runs.empty())
          distance = error_of(runs.back().second, record);
        if (distance == 0.)
          refuse_rest();
        output.say("  reference: " + run.label() + ", " + digits(record.seconds, 3) + " s" +
                   (!runs.empty() ? "; the one before is " + percent(distance) + " from it" : ""));
        runs.emplace_back(tolerance, record);
        if (distance <= largest_distance * aim)
          break;
        // of a distance that is far off a tenth of the tolerance would not be enough
        if (distance > 50. * aim)
          tolerance *= 0.1;
      }
    if (!(distance <= largest_distance * aim))
      refuse_aim(distance);
    reference = runs.back().second;
    runs.pop_back();
    // ten times the tolerance is 10^(p / (p + 1)) times the error
    const double order    = method.order;
    reference_error       = distance / (std::pow(10., order / (order + 1.)) - 1.);
    table.reference_error = reference_error;
    table.facts.push_back("Reference: " + planned(method, tolerance).label() +
                          "; its own error is about " + percent(reference_error) +
                          ", by its distance from the one with ten times the tolerance.");
    for (const auto &[its_tolerance, record] : runs)
      take_from_reference(its_tolerance, record);
  }


  bool
  AimSearch::is_of_reference(const Candidate &candidate) const
  {
    return candidate.method.title == reference_method && candidate.variable_steps;
  }


  void
  AimSearch::take_from_reference(const double tolerance, const StudyRecord &record)
  {
    for (Candidate &candidate : list)
      if (is_of_reference(candidate))
        add_trial(candidate, tolerance, planned(candidate, tolerance), record);
  }


  double
  AimSearch::error_of(const StudyRecord &run, const StudyRecord &right) const
  {
    double largest = 0.;
    for (const double error : quantities.errors(run, &right))
      {
        if (!std::isfinite(error))
          return nothing;
        largest = std::max(largest, error);
      }
    return largest;
  }


  double
  AimSearch::first_guess(const Candidate &candidate) const
  {
    // from the nearest order that is known; tolerances of the reference are too tight to begin with
    const Candidate *known = nullptr;
    for (const Candidate &other : list)
      if (!(candidate.variable_steps && is_of_reference(other)) && other.curve.best(aim) &&
          (candidate.variable_steps == other.variable_steps || !known ||
           other.method.name == candidate.method.name))
        known = &other;
    if (candidate.variable_steps)
      return known && known->variable_steps
               ? known->curve.best(aim)->x * (known->order == candidate.order ? 1. : 0.5)
               : std::min(0.1, aim);
    const double end = plan.base.time.end();
    if (!known)
      return std::min(plan.base.time.step, end / 20.);
    // of variable steps the shortest ones count
    return 0.7 * end / row_of(*known, *known->curve.best(aim)).steps *
           std::pow(aim, 1. / candidate.order - 1. / known->order);
  }


  void
  AimSearch::search(Candidate &candidate)
  {
    std::optional<double> x = candidate.curve.all().empty()
                                ? first_guess(candidate)
                                : candidate.curve.next(aim - reference_error);
    while (x && try_run(candidate, *x))
      x = candidate.curve.next(aim - reference_error);
  }


  bool
  AimSearch::try_run(Candidate &candidate, const double x)
  {
    const PlannedRun run = planned(candidate, x);
    Parameters scene;
    try
      {
        scene = plan.parameters(run);
      }
    catch (const InputError &)
      {
        return false;
      }
    StudyRecord record;
    try
      {
        record = runner.record(scene, "", AimCurve::patience * best_seconds);
      }
    catch (const InputError &error) // such as an explicit step that is not stable
      {
        record.status = StudyRecord::Status::refused;
        record.reason = error.what();
      }
    add_trial(candidate, x, run, record);
    output.say(table.line(table.rows.back()));
    write();
    if (record.stopped)
      return false;
    const double expected = candidate.curve.expected_seconds(aim);
    return !(expected > AimCurve::patience * best_seconds);
  }


  void
  AimSearch::add_trial(Candidate &candidate,
                       const double x,
                       const PlannedRun &run,
                       const StudyRecord &record)
  {
    const bool done = record.status == StudyRecord::Status::done;
    StudyRow row;
    row.run = run;
    row.take(record);
    row.size = record.steps > 0 ? record.end / record.steps : 0.;
    if (done)
      row.errors = quantities.errors(record, &*reference);
    const double error = done ? error_of(record, *reference) : nothing;
    candidate.curve.add({x, error, record.seconds});
    candidate.rows.push_back(table.rows.size());
    table.add(row);
    space_errors.push_back(record.space_error);
    if (error + reference_error <= aim)
      best_seconds = std::min(best_seconds, record.seconds);
  }


  const AimCurve::Trial *
  AimSearch::best_trial(const Candidate &candidate) const
  {
    return candidate.curve.best(aim - reference_error);
  }


  const AimSearch::Candidate *
  AimSearch::winner() const
  {
    const Candidate *best = nullptr;
    for (const Candidate &candidate : list)
      if (best_trial(candidate) &&
          (!best || best_trial(candidate)->seconds < best_trial(*best)->seconds))
        best = &candidate;
    return best;
  }


  const StudyRow &
  AimSearch::row_of(const Candidate &candidate, const AimCurve::Trial &trial) const
  {
    return table.rows[candidate.rows[&trial - candidate.curve.all().data()]];
  }


  const StudyRow &
  AimSearch::best_row(const Candidate &candidate) const
  {
    return row_of(candidate, *best_trial(candidate));
  }


  std::string
  AimSearch::entries_of(const PlannedRun &run) const
  {
    std::string entries;
    for (const Override &override : run.overrides)
      entries += (entries.empty() ? "" : " | ") + override.text;
    return "Entries for the scene: " + entries;
  }


  std::vector<std::string>
  AimSearch::result(const Candidate &best) const
  {
    const AimCurve::Trial &trial = *best_trial(best);
    const StudyRow &row          = best_row(best);
    std::vector<std::string> sentences;
    sentences.push_back(percent(aim) + in_time() + " soonest: " + row.run.label() + ", " +
                        digits(trial.seconds, 3) + " s, " + std::to_string(row.steps) + " steps.");
    sentences.push_back("Error in time " + percent(trial.error) + ", known to within " +
                        percent(reference_error) + " (of " + quantities.error_meaning() + ").");
    if (plan.aims_at_mesh)
      return sentences;
    const std::string &space = space_errors[&row - table.rows.data()];
    sentences.push_back(
      space.empty()
        ? "The error in space is not part of the aim, and is not "
          "known here (Space/Estimate error)."
        : "The error in space is not part of the aim (Study/Aim with mesh): " + space + ".");
    sentences.push_back("Half the error takes about " + digits(best.curve.price_of_half(), 3) +
                        " times as long.");
    sentences.push_back(entries_of(row.run));
    return sentences;
  }


  std::vector<std::string>
  AimSearch::result(const MeshSearch::Found &mesh) const
  {
    return {percent(whole_aim) + (is_stationary() ? "" : " in space and time") +
              " soonest: " + mesh.run.label() + ", " + std::to_string(mesh.n_cells) + " cells, " +
              digits(mesh.seconds, 3) + " s.",
            "Error in space " + percent(mesh.error) +
              (mesh.order_is_known ? ", which falls with the power " + digits(mesh.order, 2) +
                                       " of the size of the cells, as three meshes tell"
                                   : ", taken to fall with the power " + digits(mesh.order, 2) +
                                       " of the size of the cells, and perhaps falling sooner") +
              (is_stationary() ? std::string(".")
                               : "; in time " + percent(mesh.error_in_time) + "."),
            "Half the error takes about " + digits(mesh.price_of_half, 3) + " times as long" +
              (mesh.order_is_known ? "." : " at most."),
            entries_of(mesh.run)};
  }


  void
  AimSearch::write() const
  {
    if (output.root)
      write_study(output.folder, table);
  }
} // namespace Supple
