#ifndef supple_entries_h
#define supple_entries_h

#include <supple/input/patterns.h>

#include <deal.II/base/parameter_handler.h>

#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace Supple
{
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
} // namespace Supple

#endif
