#include <supple/identification/identification.h>

#include <supple/base/error.h>
#include <supple/base/files.h>
#include <supple/base/interrupt.h>
#include <supple/base/progress.h>
#include <supple/base/stopwatch.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using Total = IdentificationParameters::Total;

  Identification::Identification(const IdentificationParameters &parameters,
                                 const std::string &folder,
                                 const bool quiet,
                                 const MPI_Comm communicator)
    : parameters(parameters)
    , output(folder, quiet, communicator)
    , sets(parameters.measured)
    , model(this->parameters, communicator)
  {
    table.name        = parameters.name;
    table.unit        = parameters.unit_name();
    table.unit_length = parameters.unit_length();
    table.tolerance   = parameters.tolerance;
    table.ratios      = parameters.ratios;
    for (const double thickness : parameters.thicknesses)
      table.thicknesses.push_back(thickness * table.unit_length);
    for (const MeasuredSet &set : sets)
      table.set_numbers.push_back(set.number);
    for (const double direction : parameters.comparison.directions())
      table.side_names.push_back(direction < 0. ? "left" : "right");
    table.facts = {parameters.scene_in_words(),
                   "Measurements: `" + parameters.path(parameters.measurements) + "`"};
  }


  void
  Identification::check() const
  {
    for (const double thickness : parameters.thicknesses)
      model.check({thickness * table.unit_length, parameters.ratios.front()}, sets);
    output.say("Identification " + parameters.name + " by scene " + model.base.scene_name + ": " +
               std::to_string(parameters.thicknesses.size() * parameters.ratios.size()) +
               " pairs, " + std::to_string(sets.size()) + " measured sets; right");
  }


  void
  Identification::run()
  {
    const InterruptGuard interrupt;
    const Stopwatch stopwatch;
    for (const double thickness : parameters.thicknesses)
      model.check({thickness * table.unit_length, parameters.ratios.front()}, sets);
    std::vector<std::string> earlier = {"report.html", "errors_*"};
    for (const char *name : {"identification", "profiles", "fits"})
      for (const char *ending : {".csv", ".md", ".gp", ".svg", ".png"})
        earlier.push_back(std::string(name) + ending);
    output.open(earlier,
                [this] { write_whole_file(output.folder + "/identification.csv", table.csv()); });
    output.say("Supple " SUPPLE_VERSION ", identification " + parameters.name + ": " +
               std::to_string(parameters.thicknesses.size() * parameters.ratios.size()) +
               " pairs by scene " + model.base.scene_name);
    try
      {
        search_grid();
        compare_best();
        if (parameters.fit)
          fit();
      }
    catch (const ComputationError &error)
      {
        table.note = std::string("Not complete. ") + error.what();
        if (table.best_profiles.empty() && !table.pairs.empty())
          compare_best();
        write();
        throw;
      }
    write();
    for (const std::string &sentence : table.sentences())
      output.say("  " + sentence);
    output.say("done in " + readable_duration(stopwatch.seconds()) + ": " + output.folder +
               "/identification.md");
  }


  PairErrors
  Identification::errors_of(const LayerPair &pair, std::vector<double> &starts) const
  {
    const InterruptGuard interrupt;
    if (interrupt.requested(output.communicator))
      throw InterruptedError("Interrupted after " + std::to_string(table.pairs.size()) +
                             " pairs of the grid; what they gave is in " + output.folder + ".");
    const SurfaceComparison &comparison = parameters.comparison;
    const SurfaceResponse surface       = model.surface(pair);
    PairErrors result{pair, {}, {}};
    for (std::size_t s = 0; s < sets.size(); ++s)
      {
        starts[s] = comparison.needle_depth(surface, sets[s], starts[s]);
        result.needle_depths.push_back(starts[s]);
        result.errors.push_back(
          comparison.error(comparison.deviations(surface, sets[s], starts[s])));
      }
    return result;
  }


  void
  Identification::search_grid()
  {
    std::vector<double> depths(sets.size());
    for (std::size_t s = 0; s < parameters.start_depths.size(); ++s)
      depths[s] = parameters.start_depths[s] * table.unit_length;
    for (const double thickness : parameters.thicknesses)
      for (const double ratio : parameters.ratios)
        {
          const LayerPair pair{thickness * table.unit_length, ratio};
          try
            {
              table.pairs.push_back(errors_of(pair, depths));
            }
          catch (const InterruptedError &)
            {
              throw;
            }
          catch (const ComputationError &error)
            {
              throw ComputationError("The pair " + table.words(pair) + ": " + error.what());
            }
        }
  }


  void
  Identification::fit()
  {
    const auto &t = parameters.thicknesses;
    const auto &r = parameters.ratios;
    const LayerPair lowest{t.front() * table.unit_length, r.front()};
    const LayerPair highest{t.back() * table.unit_length, r.back()};
    std::vector<double> depths(sets.size());

    const auto add = [&](const std::string &of, const PairErrors &start, const auto &number) {
      const FitResult found =
        fit_pair([&](const LayerPair &pair) { return number(errors_of(pair, depths)); },
                 start.pair,
                 lowest,
                 highest,
                 parameters.tolerance);
      table.fits.push_back({of, found});
    };

    for (std::size_t s = 0; s < sets.size(); ++s)
      add("set " + std::to_string(sets[s].number),
          table.best_of_set(s),
          [s](const PairErrors &errors) { return errors.errors[s]; });
    const Total how = parameters.fitted;
    if (sets.size() > 1)
      add(IdentificationParameters::total_names()[static_cast<unsigned int>(how)],
          table.best_of_total(how),
          [how](const PairErrors &errors) { return errors.total(how); });
  }


  void
  Identification::compare_best()
  {
    for (std::size_t s = 0; s < sets.size(); ++s)
      {
        const PairErrors &best        = table.best_of_set(s);
        const SurfaceResponse surface = model.surface(best.pair);
        table.best_profiles.emplace_back();
        for (std::size_t i = 0; i < sets[s].distances.size(); ++i)
          {
            ComparedPoint point{sets[s].distances[i], sets[s].depths[i], {}};
            for (const double direction : parameters.comparison.directions())
              point.computed.push_back(
                surface.depth(direction * point.distance, best.needle_depths[s]));
            table.best_profiles.back().push_back(point);
          }
      }
  }


  void
  Identification::write() const
  {
    if (!output.root)
      return;
    write_whole_file(output.folder + "/identification.csv", table.csv());
    write_whole_file(output.folder + "/identification.md", table.markdown());
    write_whole_file(output.folder + "/profiles.csv", table.profiles_csv());
    if (!table.fits.empty())
      write_whole_file(output.folder + "/fits.csv", table.fits_csv());
    write_report(output.folder, table);
    output.say(plot_identification(table, output.folder));
  }
} // namespace Supple
