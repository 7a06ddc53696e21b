#include <supple/digits.h>
#include <supple/identification_table.h>

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


    /** Errors of one set, or a total of all, a row for each thickness. */
    template <class Number>
    std::string
    markdown_table(const IdentificationTable &table, const Number &number)
    {
      std::string titles, rule, rows;
      const double first = table.pairs.front().pair.thickness;
      for (const PairErrors &pair : table.pairs)
        if (pair.pair.thickness == first)
          {
            titles += " " + digits(pair.pair.ratio, 6) + " |";
            rule += "---|";
          }
      double last = -1.;
      for (const PairErrors &pair : table.pairs)
        {
          if (pair.pair.thickness != last)
            rows += (last < 0. ? "| " : "\n| ") + table.length(pair.pair.thickness) + " |";
          last = pair.pair.thickness;
          rows += " " + table.length(number(pair)) + " |";
        }
      return "| thickness |" + titles + "\n|---|" + rule + "\n" + rows + "\n";
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
    return digits(pair.thickness / unit_length, 4) + " " + unit + " and " + digits(pair.ratio, 4);
  }


  std::vector<std::string>
  IdentificationTable::sentences() const
  {
    std::vector<std::string> list;
    const auto names = IdentificationParameters::total_names();
    for (std::size_t s = 0; s < set_numbers.size(); ++s)
      list.push_back("set " + std::to_string(set_numbers[s]) + " : " + words(best_of_set(s).pair) +
                     ", error " + length(best_of_set(s).errors[s]) + " " + unit);
    for (unsigned int t = 0; t < names.size() && set_numbers.size() > 1; ++t)
      {
        const PairErrors &best = best_of_total(static_cast<Total>(t));
        list.push_back(names[t] + " : " + words(best.pair) + ", " +
                       length(best.total(static_cast<Total>(t))) + " " + unit);
      }
    for (const FittedPair &fit : fits)
      {
        std::string text = "fit of " + fit.of + " : " + words(fit.pair) + ", " + length(fit.error) +
                           " " + unit + "; within " + digits(100. * tolerance, 3) +
                           " % of that from " + digits(fit.lowest.thickness / unit_length, 3) +
                           " to " + digits(fit.highest.thickness / unit_length, 3) + " " + unit +
                           " and from " + digits(fit.lowest.ratio, 3) + " to " +
                           digits(fit.highest.ratio, 3);
        if (fit.at_bounds)
          text += "; the best pair is on an edge of the grid";
        list.push_back(text);
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
