#include <supple/identification/identification_table.h>

#include <supple/base/text.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using Total = IdentificationParameters::Total;

  namespace
  {
    std::string
    with_underscores(std::string name)
    {
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    }


    /** Four digits, or all before the point. */
    std::string
    ratio_text(const double ratio)
    {
      return ratio < 1e3 ? digits(ratio, 4) : digits(std::round(ratio), all_digits);
    }


    /** Whether a value is the first or the last one of a list. */
    bool
    at_end(const std::vector<double> &list, const double value)
    {
      const auto near = [value](const double bound) { return std::abs(value / bound - 1.) < 1e-3; };
      return list.size() > 1 && (near(list.front()) || near(list.back()));
    }


    /** Errors of one set, or a total of all, a row for each thickness; nothing where the grid is
     * not done. */
    template <class Number>
    std::string
    markdown_table(const IdentificationTable &table, const Number &number)
    {
      std::string text = "| thickness |", rule = "|---|";
      for (const double ratio : table.ratios)
        {
          text += " " + digits(ratio, 6) + " |";
          rule += "---|";
        }
      text += "\n" + rule + "\n";
      const std::size_t n_columns = table.ratios.size();
      for (std::size_t first = 0; first < table.pairs.size(); first += n_columns)
        {
          text += "| " + table.length(table.pairs[first].pair.thickness) + " |";
          for (std::size_t k = first; k < first + n_columns; ++k)
            text +=
              " " + (k < table.pairs.size() ? table.length(number(table.pairs[k])) : "") + " |";
          text += "\n";
        }
      return text;
    }
  } // namespace


  double
  PairErrors::total(const Total how) const
  {
    double sum = 0., maximum = 0., squares = 0.;
    for (const double error : errors)
      {
        sum += error;
        maximum = std::max(maximum, error);
        squares += error * error;
      }
    switch (how)
      {
        case Total::sum:
          return sum;
        case Total::maximum:
          return maximum;
        default:
          return std::sqrt(squares);
      }
  }


  const PairErrors &
  IdentificationTable::best_of_set(const std::size_t set) const
  {
    return *std::min_element(pairs.begin(), pairs.end(), [set](const auto &a, const auto &b) {
      return a.errors[set] < b.errors[set];
    });
  }


  const PairErrors &
  IdentificationTable::best_of_total(const Total how) const
  {
    return *std::min_element(pairs.begin(), pairs.end(), [how](const auto &a, const auto &b) {
      return a.total(how) < b.total(how);
    });
  }


  std::string
  IdentificationTable::length(const double metres) const
  {
    return digits(metres / unit_length, 5);
  }


  std::string
  IdentificationTable::words(const LayerPair &pair) const
  {
    return digits(pair.thickness / unit_length, 4) + " " + unit + " and " + ratio_text(pair.ratio);
  }


  bool
  IdentificationTable::on_edge(const LayerPair &pair) const
  {
    return at_end(thicknesses, pair.thickness) || at_end(ratios, pair.ratio);
  }


  std::string
  IdentificationTable::edge_words(const LayerPair &pair) const
  {
    return on_edge(pair) ? "; on an edge of the grid" : "";
  }


  std::string
  IdentificationTable::bound_words(const LayerPair &pair) const
  {
    const bool thickness = at_end(thicknesses, pair.thickness), ratio = at_end(ratios, pair.ratio);
    if (thickness && ratio)
      return " (at the bounds of thickness and ratio)";
    if (!thickness && !ratio)
      return "";
    return std::string(" (at the bound of the ") + (thickness ? "thickness)" : "ratio)");
  }


  std::string
  IdentificationTable::range_words(const FitResult &found) const
  {
    const auto thickness = [&](const LayerPair &pair) {
      return digits(pair.thickness / unit_length, 3);
    };
    return "within " + digits(100. * tolerance, 3) + " % of that from " +
           thickness(found.thinnest.pair) + bound_words(found.thinnest.pair) + " to " +
           thickness(found.thickest.pair) + " " + unit + bound_words(found.thickest.pair) +
           " and from " + ratio_text(found.softest.pair.ratio) + bound_words(found.softest.pair) +
           " to " + ratio_text(found.hardest.pair.ratio) + bound_words(found.hardest.pair);
  }


  std::vector<std::string>
  IdentificationTable::sentences() const
  {
    std::vector<std::string> list;
    if (pairs.empty())
      return list;
    const auto names = IdentificationParameters::total_names();
    for (std::size_t s = 0; s < set_numbers.size(); ++s)
      list.push_back("set " + std::to_string(set_numbers[s]) + " : " + words(best_of_set(s).pair) +
                     ", error " + length(best_of_set(s).errors[s]) + " " + unit +
                     edge_words(best_of_set(s).pair));
    for (unsigned int t = 0; t < names.size() && set_numbers.size() > 1; ++t)
      {
        const PairErrors &best = best_of_total(static_cast<Total>(t));
        list.push_back(names[t] + " : " + words(best.pair) + ", " +
                       length(best.total(static_cast<Total>(t))) + " " + unit +
                       edge_words(best.pair));
      }
    for (const FittedPair &fit : fits)
      {
        const FitResult &found = fit.found;
        list.push_back(
          "fit of " + fit.of + " : " + words(found.best.pair) + ", " + length(found.best.value) +
          " " + unit + "; " + range_words(found) +
          (on_edge(found.best.pair) ? "; the best pair is on an edge of the grid" : ""));
      }
    return list;
  }


  std::string
  IdentificationTable::csv() const
  {
    std::string text = "thickness,ratio";
    for (const unsigned int set : set_numbers)
      text += ",needle_depth_" + std::to_string(set) + ",error_" + std::to_string(set);
    for (const std::string &name : IdentificationParameters::total_names())
      text += "," + with_underscores(name);
    text += "\n";
    for (const PairErrors &pair : pairs)
      {
        text += digits(pair.pair.thickness / unit_length, 10) + "," + digits(pair.pair.ratio, 10);
        for (std::size_t s = 0; s < set_numbers.size(); ++s)
          text += "," + digits(pair.needle_depths[s] / unit_length, 10) + "," +
                  digits(pair.errors[s] / unit_length, 10);
        for (const Total how : {Total::sum, Total::maximum, Total::root_of_squares})
          text += "," + digits(pair.total(how) / unit_length, 10);
        text += "\n";
      }
    return text;
  }


  std::string
  IdentificationTable::markdown() const
  {
    std::string text = "# Identification " + name + "\n\n";
    for (const std::string &fact : facts)
      text += "- " + fact + "\n";
    if (!note.empty())
      text += "\n**" + note + "**\n";
    text +=
      "\nBest pairs: thickness of the upper layer, and its Young modulus over that of the "
      "lower one\n\n";
    for (const std::string &sentence : sentences())
      text += "- " + sentence + "\n";
    for (std::size_t s = 0; s < set_numbers.size(); ++s)
      text += "\n## Set " + std::to_string(set_numbers[s]) + ": errors [" + unit +
              "] by thickness [" + unit + "] and ratio\n\n" +
              markdown_table(*this, [s](const PairErrors &pair) { return pair.errors[s]; });
    if (set_numbers.size() > 1)
      text += "\n## Root of squares of all sets [" + unit + "]\n\n" +
              markdown_table(*this, [](const PairErrors &pair) {
                return pair.total(Total::root_of_squares);
              });
    return text;
  }


  std::string
  IdentificationTable::fits_csv() const
  {
    std::string text = "fit,pair,thickness,ratio,error\n";
    for (const auto &[of, found] : fits)
      for (const auto &[name, point] : {std::make_pair("best", &found.best),
                                        std::make_pair("thinnest", &found.thinnest),
                                        std::make_pair("thickest", &found.thickest),
                                        std::make_pair("least ratio", &found.softest),
                                        std::make_pair("greatest ratio", &found.hardest)})
        text += of + "," + name + "," + digits(point->pair.thickness / unit_length, 10) + "," +
                digits(point->pair.ratio, 10) + "," + digits(point->value / unit_length, 10) + "\n";
    return text;
  }


  std::string
  IdentificationTable::profiles_csv() const
  {
    std::string text = "set,distance,measured";
    for (const std::string &side : side_names)
      text += ",computed_" + side;
    text += "\n";
    for (std::size_t s = 0; s < best_profiles.size(); ++s)
      for (const ComparedPoint &point : best_profiles[s])
        {
          text += std::to_string(set_numbers[s]) + "," + digits(point.distance / unit_length, 10) +
                  "," + digits(point.measured / unit_length, 10);
          for (const double depth : point.computed)
            text += "," + digits(depth / unit_length, 10);
          text += "\n";
        }
    return text;
  }
} // namespace Supple
