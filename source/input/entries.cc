#include <supple/input/entries.h>

#include <supple/base/error.h>

#include <cmath>
#include <cstdlib>
#include <deal.II/base/utilities.h>
#include <limits>
#include <regex>
#include <sstream>

namespace Supple
{
  using dealii::Patterns::PatternBase;

  namespace
  {
    /** The number that makes up the whole text; not-a-number if there is none or it is too large.
     */
    double
    number(const std::string &text)
    {
      const std::string trimmed = dealii::Utilities::trim(text);
      char *end                 = nullptr;
      const double value        = std::strtod(trimmed.c_str(), &end);
      const bool read           = !trimmed.empty() && end == trimmed.c_str() + trimmed.size();
      return read && std::isfinite(value) ? value : std::numeric_limits<double>::quiet_NaN();
    }


    std::string
    words(const double value)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }
  } // namespace


  Range::Range(const std::string &words, const std::function<bool(const std::string &)> &test)
    : words(words)
    , test(test)
  {
  }


  Range
  Range::between(const double lower, const double upper)
  {
    return {"a number greater than " + Supple::words(lower) +
              (std::isfinite(upper) ? " and less than " + Supple::words(upper) : ""),
            [=](const std::string &text) { return number(text) > lower && number(text) < upper; }};
  }


  Range
  Range::at_least(const double lower)
  {
    return {"a number, " + Supple::words(lower) + " or greater",
            [=](const std::string &text) { return number(text) >= lower; }};
  }


  Range
  Range::finite()
  {
    return {"a number", [](const std::string &text) { return std::isfinite(number(text)); }};
  }


  Range
  Range::whole_number(const unsigned int least)
  {
    const int most = std::numeric_limits<int>::max();
    return {"a whole number, " + std::to_string(least) + " or greater (at most " +
              std::to_string(most) + ")",
            [=](const std::string &text) {
              const bool digits = std::regex_match(text, std::regex("\\s*\\+?\\d+\\s*"));
              return digits && number(text) >= least && number(text) <= most;
            }};
  }


  Range
  Range::one_of(const std::string &choices)
  {
    return {"one of " + std::regex_replace(choices, std::regex("\\|"), ", "),
            [=](const std::string &text) {
              return dealii::Patterns::Selection(choices).match(text);
            }};
  }


  Range
  Range::expressions(const unsigned int n)
  {
    return {n == 1 ? "an expression of x, y, z"
                   : "three expressions of x, y, z, t set apart by semicolons",
            [](const std::string &) { return true; }};
  }


  bool
  Range::match(const std::string &text) const
  {
    return test(text);
  }


  std::string
  Range::description(const OutputStyle) const
  {
    return words;
  }


  std::unique_ptr<PatternBase>
  Range::clone() const
  {
    return std::make_unique<Range>(*this);
  }


  RangeList::RangeList(const std::string &words,
                       const Range &range,
                       const unsigned int least,
                       const unsigned int most)
    : dealii::Patterns::List(range, least, most)
    , words(words)
    , range(range)
    , least(least)
    , most(most)
  {
  }


  RangeList
  RangeList::two(const Range &range)
  {
    return {"two values set apart by commas, each " + range.description(), range, 2, 2};
  }


  RangeList
  RangeList::three(const Range &range)
  {
    return {"three values set apart by commas, each " + range.description(), range, 3, 3};
  }


  RangeList
  RangeList::boundary_ids()
  {
    const Range whole = Range::whole_number(0);
    const Range id("a boundary id", [=](const std::string &text) {
      const std::string name = dealii::Utilities::trim(text);
      return whole.match(name) || (!name.empty() && !std::isfinite(number(name)));
    });
    return {"boundary ids, or names of groups of the mesh file, set apart by commas, or nothing",
            id,
            0,
            dealii::Patterns::List::max_int_value};
  }


  std::string
  RangeList::description(const OutputStyle) const
  {
    return words;
  }


  std::unique_ptr<PatternBase>
  RangeList::clone() const
  {
    return std::make_unique<RangeList>(words, range, least, most);
  }


  std::vector<std::pair<std::string, std::string>>
  named_list(const std::string &text, const std::string &origin)
  {
    std::vector<std::pair<std::string, std::string>> list;
    for (const std::string &item : dealii::Utilities::split_string_list(text, ';'))
      {
        if (item.empty())
          continue;
        std::smatch found;
        if (!std::regex_match(item, found, std::regex("([A-Za-z_][A-Za-z_0-9]*)\\s*:\\s*(.+)")))
          throw InputError(origin + ": '" + item +
                           "' is not of the form name: value (a name has letters, digits and _).");
        for (const auto &[name, value] : list)
          if (name == found[1])
            throw InputError(origin + ": the name '" + name + "' is given twice.");
        list.emplace_back(found[1], found[2]);
      }
    return list;
  }
} // namespace Supple
