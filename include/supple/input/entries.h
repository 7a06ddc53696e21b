#ifndef supple_entries_h
#define supple_entries_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /**
   * What a parameter may be, with a description that fits into a message and into the
   * documentation.
   */
  class Range : public dealii::Patterns::PatternBase
  {
  public:
    Range(const std::string &words, const std::function<bool(const std::string &)> &test);

    /** A number strictly between two bounds, of which the upper one may be infinite. */
    static Range
    between(double lower, double upper);

    static Range
    at_least(double lower);

    static Range
    finite();

    static Range
    whole_number(unsigned int least);

    /** @p choices: names set apart by | */
    static Range
    one_of(const std::string &choices);

    static Range
    expressions(unsigned int n);

    bool
    match(const std::string &text) const override;

    std::string
    description(const OutputStyle style = Machine) const override;

    std::unique_ptr<dealii::Patterns::PatternBase>
    clone() const override;

  private:
    const std::string words;
    const std::function<bool(const std::string &)> test;
  };


  /** Values of one range, set apart by commas. */
  class RangeList : public dealii::Patterns::List
  {
  public:
    RangeList(const std::string &words, const Range &range, unsigned int least, unsigned int most);

    static RangeList
    two(const Range &range);

    static RangeList
    three(const Range &range);

    /** Numbers, or names of groups of a mesh file. */
    static RangeList
    boundary_ids();

    std::string
    description(const OutputStyle style = Machine) const override;

    std::unique_ptr<dealii::Patterns::PatternBase>
    clone() const override;

  private:
    const std::string words;
    const Range range;
    const unsigned int least, most;
  };


  /** How the entries of a parameter file are declared. */
  namespace Entries
  {
    constexpr double infinity = std::numeric_limits<double>::infinity();

    inline std::string
    full_documentation(const std::string &meaning,
                       const std::string &unit,
                       const dealii::Patterns::PatternBase &pattern)
    {
      return meaning + " Unit: " + unit +
             ". Range: " + pattern.description(dealii::Patterns::PatternBase::Text) + ".";
    }


    /** Declares an entry, bound to @p variable, whose documentation tells its unit and range too.
     */
    template <class T>
    void
    add(dealii::ParameterHandler &prm,
        const std::string &entry,
        T &variable,
        const std::string &unit,
        const dealii::Patterns::PatternBase &pattern,
        const std::string &meaning)
    {
      prm.add_parameter(entry, variable, full_documentation(meaning, unit, pattern), pattern);
    }


    /** The same for a choice between names. */
    template <class Enum>
    void
    add_choice(dealii::ParameterHandler &prm,
               const std::string &entry,
               Enum &variable,
               const std::vector<std::pair<std::string, Enum>> &choices,
               const std::string &meaning)
    {
      std::string names, preset;
      for (const auto &[name, value] : choices)
        {
          names += (names.empty() ? "" : "|") + name;
          if (value == variable)
            preset = name;
        }
      const Range pattern = Range::one_of(names);
      prm.declare_entry(entry, preset, pattern, full_documentation(meaning, "none", pattern));
      prm.add_action(entry, [&variable, choices](const std::string &chosen) {
        for (const auto &[name, value] : choices)
          if (name == chosen)
            variable = value;
      });
    }
  } // namespace Entries


  /** Takes a text "name: value; name: value" apart; the pairs stand in its order. @throws
   * InputError beginning with @p origin */
  std::vector<std::pair<std::string, std::string>>
  named_list(const std::string &text, const std::string &origin);
} // namespace Supple

#endif
