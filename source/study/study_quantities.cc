#include <supple/study/study_quantities.h>

#include <supple/base/error.h>
#include <supple/base/text.h>
#include <supple/input/entries.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <sstream>

namespace Supple
{
  namespace
  {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();


    double
    largest_size(const std::vector<double> &values)
    {
      double largest = 0.;
      for (const double value : values)
        largest = std::max(largest, std::abs(value));
      return largest;
    }


    /** In how many steps a quantity rises by more than round-off. */
    unsigned int
    rises(const std::vector<double> &values, const double sign)
    {
      const double accuracy = 1e-9 * largest_size(values);
      unsigned int n        = 0;
      for (std::size_t i = 1; i < values.size(); ++i)
        n += sign * (values[i] - values[i - 1]) > accuracy;
      return n;
    }


    /** Swings per second about the middle between the extremes, from the first upward crossing to
     * the last one. */
    double
    frequency(const std::vector<double> &times, const std::vector<double> &values)
    {
      const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
      const double middle          = 0.5 * (*lowest + *highest);
      std::vector<double> crossings;
      for (std::size_t i = 1; i < values.size(); ++i)
        if (values[i - 1] < middle && values[i] >= middle)
          crossings.push_back(times[i - 1] + (times[i] - times[i - 1]) * (middle - values[i - 1]) /
                                               (values[i] - values[i - 1]));
      if (crossings.size() < 2)
        return nothing;
      return (crossings.size() - 1) / (crossings.back() - crossings.front());
    }


    double
    reduced(const std::string &reduction,
            const std::vector<double> &times,
            const std::vector<double> &values)
    {
      if (values.empty())
        return nothing;
      if (reduction == "first")
        return values.front();
      if (reduction == "largest")
        return *std::max_element(values.begin(), values.end());
      if (reduction == "smallest")
        return *std::min_element(values.begin(), values.end());
      if (reduction == "rises")
        return rises(values, 1.);
      if (reduction == "falls")
        return rises(values, -1.);
      if (reduction == "frequency")
        return frequency(times, values);
      return values.back();
    }


    /** Of what does not move: zero where there is no error, and no number where there is one. */
    double
    relative(const double error, const double size)
    {
      if (size == 0.)
        return error == 0. ? 0. : nothing;
      return error / size;
    }


    bool
    is_physical(const std::string &column)
    {
      return std::set<std::string>{
               "step", "time", "dt", "seconds", "newton_iterations", "linear_iterations"}
               .count(column) == 0;
    }
  } // namespace


  StudyQuantities::StudyQuantities(const StudyParameters &study, const StudyPlan &plan)
    : kind(plan.kind)
    , available(StudyRecord::column_names(plan.base))
    , probes_changed(plan.changed_by_hand({"Probes/Points", "Probes/Boundaries", "Probes/Regions"}))
    , condition_place(study.place(study.right_if.empty() ? "Cases" : "Right if"))
  {
    read_values(study);
    read_exact_values(study);
    if (kind == StudyPlan::Kind::methods && exact.empty())
      read_quantities(study, plan);
    check_conditions(plan);
  }


  void
  StudyQuantities::check_column(const std::string &name, const std::string &place) const
  {
    if (available.count(name) == 0)
      throw InputError(probes_changed + place + ": '" + name +
                       "' is no column of history.csv or probes.csv; " +
                       boost::algorithm::join(available, ", ") + " are" +
                       did_you_mean(name, {available.begin(), available.end()}));
  }


  void
  StudyQuantities::read_quantities(const StudyParameters &study, const StudyPlan &plan)
  {
    const std::string place = study.place(study.aim.empty() ? "Quantities" : "Aim of");
    for (const auto &[name, text] :
         named_list(plan.base.probes.points, plan.base.origin("Probes/Points")))
      points.push_back(name);
    std::string all = study.quantities;
    if (!study.aim.empty())
      all = !study.aim_of.empty() ? study.aim_of
            : plan.aims_at_mesh   ? "probes"
            : points.empty()      ? "final field"
                                  : "probes, final field";
    for (const std::string &name : dealii::Utilities::split_string_list(all, ','))
      {
        if (name == "probes" && points.empty())
          throw InputError(
            plan.changed_by_hand({"Probes/Points"}) + place +
            ": the scene follows no point (Probes/Points); take " +
            (plan.aims_at_mesh ? "energy or a column." : "'final field' or energy."));
        if (name == "final field" && (plan.aims_at_mesh || !plan.level_references.empty()))
          throw InputError(place +
                           ": on another mesh there are other vertices than those of the "
                           "final field; take probes, energy or a column.");
        if (name != "probes" && name != "final field" && name != "energy")
          check_column(name, place);
        if (!study.aim.empty() && !is_physical(name))
          throw InputError(place + ": " + name +
                           " tells of the computation and not of the body; it has no error.");
        quantities.push_back(name);
      }
    if (quantities.empty())
      throw InputError(place + ": it must name a quantity, such as probes.");
  }


  void
  StudyQuantities::read_values(const StudyParameters &study)
  {
    const std::string place = study.place("Columns");
    for (const auto &[name, text] : named_list(study.columns, place))
      {
        std::smatch found;
        const std::regex form(
          "((last|first|largest|smallest|rises|falls|frequency|summary|at\\s+(\\S+))\\s+)?(\\S+)");
        if (!std::regex_match(text, found, form))
          throw InputError(
            place + ": '" + text +
            "' is not of the form column, first column, largest column, smallest "
            "column, rises column, falls column, frequency column, at time column or summary "
            "entry.");
        if (std::set<std::string>{"x", "y", "z", "t", "pi"}.count(name) > 0)
          throw InputError(place + ": '" + name + "' means something else in expressions.");
        all_values.push_back({name, found[2].matched ? found[2].str() : "last", found[4]});
        if (found[3].matched)
          {
            all_values.back().reduction = "at";
            all_values.back().time = Expression(found[3], 1, place).value(dealii::Point<3>(), 0.);
          }
        if (all_values.back().reduction != "summary")
          check_column(all_values.back().column, place);
      }
  }


  void
  StudyQuantities::read_exact_values(const StudyParameters &study)
  {
    if (study.exact.empty())
      return;
    const std::string place = study.place("Exact");
    for (const StudyItem &item : study_items(study.exact, place))
      {
        if (kind == StudyPlan::Kind::methods)
          check_column(item.name, place);
        else if (std::none_of(all_values.begin(), all_values.end(), [&](const Value &value) {
                   return value.name == item.name;
                 }))
          throw InputError(place + ": '" + item.name + "' is no name in Study/Columns" +
                           did_you_mean(item.name, value_names()));
        exact.push_back({item.name, Expression(item.rest, 1, place)});
      }
  }


  void
  StudyQuantities::check_conditions(const StudyPlan &plan) const
  {
    const std::vector<double> ones(all_values.size(), 1.);
    for (const PlannedRun &run : plan.runs)
      if (!run.right_if.empty())
        {
          if (all_values.empty())
            throw InputError(condition_place + ": it needs Columns to speak of.");
          verdict(run, ones, ones, {});
        }
  }


  std::set<std::string>
  StudyQuantities::needed() const
  {
    std::set<std::string> columns = {"time"};
    for (const Value &value : all_values)
      if (value.reduction != "summary")
        columns.insert(value.column);
    if (kind == StudyPlan::Kind::methods)
      for (const ExactValue &value : exact)
        columns.insert(value.name);
    for (const std::string &quantity : quantities)
      {
        if (quantity == "probes")
          for (const std::string &point : points)
            for (const char *component : {".ux", ".uy", ".uz"})
              columns.insert(point + component);
        else if (quantity == "energy")
          columns.insert({"total", "kinetic", "elastic"});
        else if (quantity != "final field")
          columns.insert(quantity);
      }
    return columns;
  }


  std::vector<std::string>
  StudyQuantities::error_names() const
  {
    if (!exact.empty())
      {
        std::vector<std::string> names;
        for (const ExactValue &value : exact)
          names.push_back(value.name);
        return names;
      }
    if (kind != StudyPlan::Kind::levels)
      return quantities;
    std::vector<std::string> names;
    for (const Value &value : all_values)
      if (value.reduction != "summary")
        names.push_back(value.name);
    return names;
  }


  std::string
  StudyQuantities::error_meaning() const
  {
    if (kind != StudyPlan::Kind::methods)
      return "distance from the " +
             std::string(exact.empty() ? "reference's value" : "exact value") +
             ", relative to it unless it is 0";
    if (!exact.empty())
      return "largest distance from the exact value over time, relative to its largest size";
    const std::string first = quantities.front();
    if (first == "probes")
      return "largest distance of a followed point from the reference over time, relative to the "
             "largest motion of these points";
    if (first == "final field")
      return "largest distance of a vertex from the reference at the end, relative to the largest "
             "motion of a vertex";
    if (first == "energy")
      return "largest distance of the total energy from that of the reference over time, relative "
             "to the largest kinetic or elastic energy";
    return "largest distance of " + first +
           " from the reference over time, relative to its largest size";
  }


  double
  StudyQuantities::error_of_probes(const StudyRecord &run, const StudyRecord &reference) const
  {
    double error = 0., motion = 0.; // squares
    const auto &times = run.column("time"), &reference_times = reference.column("time");
    for (const std::string &point : points)
      {
        std::vector<double> distance(times.size()), path(reference_times.size());
        for (const char *component : {".ux", ".uy", ".uz"})
          {
            const auto &found = run.column(point + component),
                       &right = reference.column(point + component);
            for (std::size_t i = 0; i < times.size(); ++i)
              distance[i] += std::pow(found[i] - reference.value(point + component, times[i]), 2);
            for (std::size_t i = 0; i < path.size(); ++i)
              path[i] += std::pow(right[i] - right[0], 2);
          }
        error  = std::max(error, *std::max_element(distance.begin(), distance.end()));
        motion = std::max(motion, *std::max_element(path.begin(), path.end()));
      }
    return std::sqrt(relative(error, motion));
  }


  double
  StudyQuantities::error_over_time(const std::string &quantity,
                                   const StudyRecord &run,
                                   const StudyRecord &reference) const
  {
    if (quantity == "probes")
      return error_of_probes(run, reference);
    if (quantity == "final field")
      return run.displacement.size() == reference.displacement.size()
               ? relative(largest_vertex_distance(run.displacement, reference.displacement),
                          reference.largest_motion)
               : nothing;

    const bool energy        = quantity == "energy";
    const std::string column = energy ? "total" : quantity;
    const double size        = energy ? std::max(largest_size(reference.column("kinetic")),
                                          largest_size(reference.column("elastic")))
                                      : largest_size(reference.column(column));
    double error             = 0.;
    // Reactions are known from the first step on.
    for (std::size_t i = 1; i < run.column("time").size(); ++i)
      error =
        std::max(error,
                 std::abs(run.column(column)[i] - reference.value(column, run.column("time")[i])));
    return relative(error, size);
  }


  std::vector<double>
  StudyQuantities::errors(const StudyRecord &run, const StudyRecord *const reference) const
  {
    std::vector<double> found;
    if (kind == StudyPlan::Kind::methods)
      {
        for (const ExactValue &value : exact)
          {
            double error = 0., size = 0.;
            for (std::size_t i = 0; i < run.column("time").size(); ++i)
              {
                const double right =
                  value.expression.value(dealii::Point<3>(), run.column("time")[i]);
                error = std::max(error, std::abs(run.column(value.name)[i] - right));
                size  = std::max(size, std::abs(right));
              }
            found.push_back(relative(error, size));
          }
        for (const std::string &quantity : quantities)
          found.push_back(error_over_time(quantity, run, *reference));
        return found;
      }

    const std::vector<double> numbers = values(run);
    const std::vector<double> right   = reference ? values(*reference) : std::vector<double>();
    const auto add                    = [&](const double number, const double exact_number) {
      found.push_back(std::abs(number - exact_number) /
                      (exact_number == 0. ? 1. : std::abs(exact_number)));
    };
    if (reference)
      for (std::size_t i = 0; i < numbers.size(); ++i)
        if (all_values[i].reduction != "summary")
          add(numbers[i], right[i]);
    for (const ExactValue &value : exact)
      for (std::size_t i = 0; i < all_values.size(); ++i)
        if (all_values[i].name == value.name)
          add(numbers[i], value.expression.value(dealii::Point<3>(), run.end));
    return found;
  }


  std::vector<std::string>
  StudyQuantities::value_names() const
  {
    std::vector<std::string> names;
    for (const Value &value : all_values)
      names.push_back(value.name);
    return names;
  }


  std::vector<double>
  StudyQuantities::values(const StudyRecord &run) const
  {
    std::vector<double> numbers;
    for (const Value &value : all_values)
      {
        if (value.reduction == "summary")
          {
            const auto found = run.summary.find(value.column);
            numbers.push_back(found == run.summary.end() ? nothing : found->second);
          }
        else if (run.columns.count(value.column) == 0)
          numbers.push_back(nothing);
        else if (value.reduction == "at")
          numbers.push_back(run.has(value.time) ? run.value(value.column, value.time) : nothing);
        else
          numbers.push_back(reduced(value.reduction, run.column("time"), run.column(value.column)));
      }
    return numbers;
  }


  bool
  StudyQuantities::holds(const std::string &condition,
                         const std::vector<double> &values,
                         const std::vector<double> &above) const
  {
    std::map<std::string, double> constants;
    for (std::size_t i = 0; i < all_values.size(); ++i)
      {
        constants[all_values[i].name]            = i < values.size() ? values[i] : nothing;
        constants["above_" + all_values[i].name] = i < above.size() ? above[i] : nothing;
      }
    for (const auto &[name, value] : constants)
      if (!std::isfinite(value) && std::regex_search(condition, std::regex("\\b" + name + "\\b")))
        return false;
    return Expression(condition, 1, condition_place, constants).value(dealii::Point<3>(), 0.) != 0.;
  }


  std::string
  StudyQuantities::verdict(const PlannedRun &run,
                           const std::vector<double> &values,
                           const std::vector<double> &above,
                           const std::vector<std::string> &warnings) const
  {
    std::smatch parts;
    std::regex_match(run.right_if,
                     parts,
                     std::regex("(.*?)(\\s+or\\s+(?:(.+?)\\s+with\\s+)?warning\\s+(.*\\S)\\s*)?"));
    const std::string less = parts[3], words = parts[4];
    const bool enough = less.empty() || holds(less, values, above);
    if (holds(parts[1], values, above))
      return "right";
    const bool told = enough && !words.empty() &&
                      std::any_of(warnings.begin(), warnings.end(), [&](const std::string &text) {
                        return text.find(words) != std::string::npos;
                      });
    return told ? "warned" : "wrong";
  }
} // namespace Supple
