#include <supple/study/mesh_search.h>

#include <supple/base/error.h>
#include <supple/base/text.h>
#include <supple/mesh/finer_mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Supple
{
  namespace
  {
    /** Into how many parts edges are cut. */
    constexpr unsigned int parts[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32};

    /** What a run takes that is not begun any more [s], if no other one has met the aim. */
    constexpr double longest_run = 3600.;

    /** What all runs may take, over the best one, or some seconds. */
    constexpr double longest_search = 10., shortest_search = 3.;

    constexpr double nothing  = std::numeric_limits<double>::quiet_NaN();
    constexpr double infinity = std::numeric_limits<double>::infinity();

    /** Orders of the displacement that are believed: from those of bodies with sharp edges, or with
     * waves, to the best that cells can do. */
    MeshLadder
    ladder_of(const unsigned int order_of_cells)
    {
      return order_of_cells == 1 ? MeshLadder(0.8, 2.) : MeshLadder(1., 4.);
    }


    std::string
    mesh_label(const unsigned int order_of_cells, const unsigned int n_parts)
    {
      return std::string(order_of_cells == 1 ? "linear" : "quadratic") + " cells, edges in " +
             std::to_string(n_parts);
    }


    /** Not a number where there is none. */
    double
    largest_of(const std::vector<double> &numbers)
    {
      double largest = nothing;
      for (const double number : numbers)
        largest = std::isnan(number) || largest > number ? largest : number;
      return largest;
    }
  } // namespace


  MeshLadder::MeshLadder(const double lowest, const double highest)
    : lowest(lowest)
    , highest(highest)
  {
  }


  void
  MeshLadder::add(const unsigned int n_parts, const double distance)
  {
    steps.push_back({1. / n_parts, distance});
  }


  bool
  MeshLadder::order_is_known() const
  {
    const double p = order();
    return steps.size() > 2 && p > lowest && p < highest;
  }


  /** With errors C h^p the distances are C (h_1^p - h_2^p) and C (h_2^p - h_3^p). */
  double
  MeshLadder::order() const
  {
    if (steps.size() < 3)
      return lowest;
    const Step *const last = &steps.back();
    const double wanted    = last[-1].distance / last[0].distance;
    const auto ratio       = [last](const double p) {
      return (std::pow(last[-2].size, p) - std::pow(last[-1].size, p)) /
             (std::pow(last[-1].size, p) - std::pow(last[0].size, p));
    };
    if (wanted <= ratio(lowest))
      return lowest;
    if (wanted >= ratio(highest))
      return highest;
    double low = lowest, high = highest;
    for (unsigned int i = 0; i < 50; ++i)
      {
        const double middle                   = 0.5 * (low + high);
        (ratio(middle) < wanted ? low : high) = middle;
      }
    return low;
  }


  double
  MeshLadder::error_over_distance() const
  {
    const bool converges = steps.size() == 2 || order() > lowest;
    if (steps.size() < 2 || !converges)
      return infinity;
    return 1. / (std::pow(steps[steps.size() - 2].size / steps.back().size, order()) - 1.);
  }


  double
  MeshLadder::error() const
  {
    return steps.size() < 2 ? infinity : steps.back().distance * error_over_distance();
  }


  bool
  MeshLadder::diverges() const
  {
    const std::size_t n = steps.size();
    return n > 3 && steps[n - 1].distance > steps[n - 2].distance &&
           steps[n - 2].distance > steps[n - 3].distance;
  }


  double
  MeshLadder::parts_for(const double wanted) const
  {
    return std::pow(error() / wanted, 1. / order()) / steps.back().size;
  }


  MeshSearch::MeshSearch(const StudyPlan &plan,
                         const StudyQuantities &quantities,
                         const StudyRunner &runner,
                         const std::vector<InTime> &in_time,
                         const double aim,
                         const std::function<void(const StudyTable &)> &after_run)
    : plan(plan)
    , quantities(quantities)
    , runner(runner)
    , in_time(in_time)
    , aim(aim)
    , after_run(after_run)
  {
    found.kind        = StudyPlan::Kind::methods;
    found.name        = plan.base.scene_name;
    found.error_names = quantities.error_names();
    found.targets     = {aim};
    found.facts       = {
            "The scene's own mesh with its edges cut into parts. Error in space: by the "
                  "distance from the results on the mesh before (Richardson), where three "
                  "meshes tell with which order it falls, and with a low order where they do "
                  "not."};
  }


  PlannedRun
  MeshSearch::planned(const unsigned int order_of_cells,
                      const unsigned int n_parts,
                      const PlannedRun &method) const
  {
    PlannedRun run = method;
    run.level      = mesh_label(order_of_cells, n_parts);
    run.curve      = order_of_cells == 1 ? "linear cells" : "quadratic cells";
    run.overrides.clear();
    for (const auto &[entry, value] : entries_of_finer(plan.base.mesh, n_parts))
      run.overrides.push_back({entry + "=" + value, "the aim"});
    if (order_of_cells != plan.base.mesh.order)
      run.overrides.push_back({"Mesh/Order=" + std::to_string(order_of_cells), "the aim"});
    run.overrides.insert(run.overrides.end(), method.overrides.begin(), method.overrides.end());
    return run;
  }


  std::optional<StudyRecord>
  MeshSearch::record(const unsigned int order_of_cells,
                     const unsigned int n_parts,
                     StudyRow &row,
                     const InTime *&method) const
  {
    for (const InTime &candidate : in_time)
      {
        method  = &candidate;
        row.run = planned(order_of_cells, n_parts, candidate.run);
        try
          {
            const StudyRecord record =
              runner.record(plan.parameters(row.run),
                            "",
                            best ? AimCurve::patience * best->seconds : infinity);
            row.take(record);
            if (record.status == StudyRecord::Status::done)
              return record;
          }
        catch (const InputError &error) // such as an explicit step that is not stable
          {
            row.status = StudyRecord::Status::refused;
            row.reason = error.what();
          }
      }
    return {};
  }


  void
  MeshSearch::choose_next(Climb &climb) const
  {
    const double wanted =
      std::isfinite(climb.ladder.error()) ? climb.ladder.parts_for(aim) : 2. * climb.n_parts;
    climb.next = 0;
    if (climb.ladder.diverges())
      return;
    for (const unsigned int n : parts)
      if (n > climb.n_parts && n <= 2 * climb.n_parts && can_be_cut(plan.base.mesh, n))
        {
          climb.next = n;
          if (n >= wanted)
            break;
        }
    const double growth = std::pow(double(climb.next) / climb.n_parts, climb.dimension);
    climb.expected      = climb.seconds * growth;
    if (growth * climb.n_cells > plan.base.mesh.refinement.most_cells)
      climb.next = 0;
  }


  std::vector<double>
  MeshSearch::errors(const MeshLadder &ladder,
                     const std::vector<double> &distances,
                     const double error_in_time) const
  {
    std::vector<double> errors(found.error_names.size(), nothing);
    for (std::size_t i = 0; i < distances.size(); ++i)
      errors[i] = distances[i] * ladder.error_over_distance() + error_in_time;
    return errors;
  }


  void
  MeshSearch::add(const StudyRow &row)
  {
    found.add(row);
    after_run(found);
  }


  double
  MeshSearch::dimension_of(const Climb &climb,
                           const unsigned int n_parts,
                           const unsigned int n_cells)
  {
    return std::round(std::log(double(n_cells) / climb.n_cells) /
                      std::log(double(n_parts) / climb.n_parts));
  }


  void
  MeshSearch::step(Climb &climb)
  {
    const unsigned int n_parts = climb.next;
    climb.next                 = 0;
    StudyRow row;
    const InTime *method                 = nullptr;
    const std::optional<StudyRecord> now = record(climb.order_of_cells, n_parts, row, method);
    if (!now)
      {
        const bool other_cells = n_parts == 1 && climb.order_of_cells != plan.base.mesh.order;
        if (!other_cells || row.status != StudyRecord::Status::refused) // such as in the plane
          add(row);
        return;
      }
    std::vector<double> distances;
    if (climb.before)
      distances = quantities.errors(*climb.before, &*now);
    climb.ladder.add(n_parts, largest_of(distances));
    row.errors = errors(climb.ladder, distances, method->error);
    if (climb.before)
      {
        climb.dimension    = dimension_of(climb, n_parts, now->n_cells);
        row.error_in_space = climb.ladder.error();
        row.error_in_time  = method->error;
      }
    climb.before  = now;
    climb.n_parts = n_parts;
    climb.n_cells = now->n_cells;
    climb.seconds = now->seconds;
    seconds += now->seconds;
    add(row);
    if (!(climb.ladder.error() + method->error <= aim))
      choose_next(climb);
    else if (!best || now->seconds < best->seconds)
      best = Found{row.run,
                   climb.ladder.error(),
                   climb.ladder.order(),
                   climb.ladder.order_is_known(),
                   method->error,
                   std::pow(2., climb.dimension / climb.ladder.order()) * method->price_of_half,
                   now->seconds,
                   now->n_cells};
  }


  bool
  MeshSearch::may_win(const Climb &climb) const
  {
    if (climb.next == 0)
      return false;
    if (!best)
      return climb.expected < longest_run;
    return climb.expected < AimCurve::patience * best->seconds &&
           seconds < std::max(shortest_search, longest_search * best->seconds);
  }


  std::optional<MeshSearch::Found>
  MeshSearch::search()
  {
    std::vector<Climb> climbs;
    for (const unsigned int order_of_cells : {2u, 1u})
      climbs.emplace_back(order_of_cells, ladder_of(order_of_cells));
    for (;;)
      {
        Climb *quickest = nullptr;
        for (Climb &climb : climbs)
          if (may_win(climb) && (!quickest || climb.expected < quickest->expected))
            quickest = &climb;
        if (!quickest)
          return best;
        step(*quickest);
      }
  }
} // namespace Supple
