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

    /** A mesh on which a run would take this many times as long as the best one is not tried. */
    constexpr double patience = 1.3;

    /** What a run takes that is not begun any more [s], if no other one has met the aim. */
    constexpr double longest_run = 3600.;

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
    return steps.size() > 2;
  }


  /** With errors C h^p the distances are C (h_1^p - h_2^p) and C (h_2^p - h_3^p). */
  double
  MeshLadder::order() const
  {
    if (!order_is_known())
      return lowest;
    const Step *const last = &steps.back();
    const double wanted    = last[-1].distance / last[0].distance;
    const auto ratio       = [last](const double p) {
      return (std::pow(last[-2].size, p) - std::pow(last[-1].size, p)) /
             (std::pow(last[-1].size, p) - std::pow(last[0].size, p));
    };
    double low = lowest, high = highest;
    for (unsigned int i = 0; i < 50; ++i)
      {
        const double middle                   = 0.5 * (low + high);
        (ratio(middle) < wanted ? low : high) = middle;
      }
    return low;
  }


  double
  MeshLadder::error() const
  {
    if (steps.size() < 2)
      return infinity;
    const Step *const last = &steps.back();
    return last->distance / (std::pow(last[-1].size / last->size, order()) - 1.);
  }


  double
  MeshLadder::parts_for(const double wanted) const
  {
    return std::pow(error() / wanted, 1. / order()) / steps.back().size;
  }


  MeshSearch::MeshSearch(const StudyPlan &plan,
                         const StudyQuantities &quantities,
                         const StudyRunner &runner,
                         const TaskOutput &output,
                         const std::vector<InTime> &in_time)
    : plan(plan)
    , quantities(quantities)
    , runner(runner)
    , output(output)
    , in_time(in_time)
  {
    found.kind        = StudyPlan::Kind::methods;
    found.name        = plan.base.scene_name + " on finer meshes";
    found.error_names = quantities.error_names();
    found.facts       = {"The scene's own mesh with its edges cut into parts. Error in space: by the "
                         "distance from the results on the mesh before (Richardson), where three "
                         "meshes tell with which order it falls, and with a low order where they do "
                         "not."};
  }


  PlannedRun
  MeshSearch::planned(const unsigned int order_of_cells,
                      const unsigned int n_parts,
                      const InTime &method) const
  {
    PlannedRun run;
    run.level = mesh_label(order_of_cells, n_parts);
    run.curve = order_of_cells == 1 ? "linear cells" : "quadratic cells";
    run.name  = method.label;
    for (const auto &[entry, value] : entries_of_finer(plan.base.mesh, n_parts))
      run.overrides.push_back({entry + "=" + value, "the aim"});
    run.overrides.push_back({"Mesh/Order=" + std::to_string(order_of_cells), "the aim"});
    run.overrides.insert(run.overrides.end(), method.overrides.begin(), method.overrides.end());
    return run;
  }


  std::optional<StudyRecord>
  MeshSearch::record(const unsigned int order_of_cells,
                     const unsigned int n_parts,
                     StudyRow &row) const
  {
    for (const InTime &method : in_time)
      {
        row.run = planned(order_of_cells, n_parts, method);
        try
          {
            const StudyRecord record =
              runner.record(plan.parameters(row.run), "", best ? patience * best->seconds : infinity);
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


  unsigned int
  MeshSearch::next(const unsigned int n_parts,
                   const MeshLadder &ladder,
                   const double aim,
                   const StudyRow &last) const
  {
    const unsigned int dimension = plan.base.mesh.shape == MeshParameters::Shape::rectangle ? 2 : 3;
    const double wanted = std::isfinite(ladder.error()) ? ladder.parts_for(aim) : 2. * n_parts;
    unsigned int result = 0;
    for (const unsigned int n : parts)
      if (n > n_parts && n <= 2 * n_parts && can_be_cut(plan.base.mesh, n))
        {
          result = n;
          if (n >= wanted)
            break;
        }
    if (result == 0)
      return 0;
    const double growth   = std::pow(double(result) / n_parts, dimension);
    const double expected = last.seconds * growth;
    const double longest  = best ? patience * best->seconds : longest_run;
    if (expected > longest || growth * last.n_cells > plan.base.mesh.refinement.most_cells)
      return 0;
    return result;
  }


  void
  MeshSearch::climb(const unsigned int order_of_cells, const double aim, const double error_in_time)
  {
    MeshLadder ladder = ladder_of(order_of_cells);
    std::optional<StudyRecord> before;
    for (unsigned int n_parts = 1; n_parts > 0;)
      {
        StudyRow row;
        const std::optional<StudyRecord> now = record(order_of_cells, n_parts, row);
        if (now)
          {
            double distance = nothing;
            if (before)
              for (const double error : quantities.errors(*before, &*now))
                distance = std::isnan(distance) ? error : std::max(distance, error);
            ladder.add(n_parts, distance);
            row.errors.assign(found.error_names.size(), nothing);
            if (before)
              {
                row.error_in_space = ladder.error();
                row.error_in_time  = error_in_time;
                row.errors.front() = row.error_in_space + error_in_time;
              }
          }
        found.add(row);
        output.say(found.line(found.rows.back()) +
                   (row.error_in_space < infinity
                      ? " (in space " + percent(row.error_in_space) + ")"
                      : std::string()));
        if (!now)
          return;
        const double error = ladder.error();
        if (error <= aim)
          {
            if (!best || row.seconds < best->seconds)
              best = Found{row.run,
                           error,
                           ladder.order(),
                           ladder.order_is_known(),
                           row.seconds,
                           row.n_cells};
            return;
          }
        before  = now;
        n_parts = next(n_parts, ladder, aim, row);
      }
  }


  std::optional<MeshSearch::Found>
  MeshSearch::search(const double aim, const double error_in_time)
  {
    for (const unsigned int order_of_cells : {2u, 1u}) // from the one that most often wins on
      climb(order_of_cells, aim, error_in_time);
    return best;
  }
} // namespace Supple
