#include <supple/base/expression.h>

#include <supple/base/error.h>

#include <deal.II/base/utilities.h>

#include <cctype>
#include <iostream>
#include <regex>
#include <sstream>
#include <vector>

namespace Supple
{
  namespace
  {
    /** What is wrong, without deal.II's frame around it. */
    std::string
    reason(const dealii::ExceptionBase &exception)
    {
      std::ostringstream text;
      exception.print_info(text);
      std::smatch found;
      const std::string all = text.str();
      if (std::regex_search(all, found, std::regex("The parser said:\\s*(.*)")))
        return found[1] == "Internal error" ? "it can't be read to its end; something is missing."
                                            : found[1].str();
      if (std::regex_search(all, found, std::regex("Message:\\s*(.*)")))
        return found[1];
      return dealii::Utilities::trim(all);
    }


    /** Refuses what muParser reads, but otherwise than it is meant: 1,5 is 5, x = 1 is always true,
     * and a < x < b compares the truth of a < x with b. */
    class Misreadings
    {
    public:
      Misreadings(const std::string &text, const std::string &origin)
        : text(text)
        , origin(origin)
      {
      }

      void
      refuse()
      {
        for (std::size_t i = 0; i < text.size(); ++i)
          switch (text[i])
            {
              case '(':
                brackets.push_back({follows_name(i), false});
                break;
              case ')':
                if (brackets.size() > 1)
                  brackets.pop_back();
                break;
              case ',':
                if (!brackets.back().of_function)
                  throw_hint(i,
                             "a comma stands between the arguments of a function alone. The "
                             "decimal sign is a point: 1.5.");
                brackets.back().compared = false;
                break;
              case '&':
              case '|':
              case '?':
              case ':':
                brackets.back().compared = false;
                break;
              case '=':
              case '<':
              case '>':
              case '!':
                i += read_comparison(i);
                break;
              default:
                break;
            }
      }

    private:
      struct Bracket
      {
        bool of_function;
        bool compared; ///< a comparison stands in it since the last && or ||
      };

      [[noreturn]] void
      throw_hint(const std::size_t place, const std::string &hint) const
      {
        throw InputError(origin + ": in '" + text + "', at character " + std::to_string(place + 1) +
                         ": " + hint);
      }

      bool
      follows_name(std::size_t place) const
      {
        while (place > 0 && text[place - 1] == ' ')
          --place;
        return place > 0 && (std::isalnum(static_cast<unsigned char>(text[place - 1])) != 0 ||
                             text[place - 1] == '_');
      }

      /** @return how many more characters it has */
      std::size_t
      read_comparison(const std::size_t place)
      {
        const bool longer = place + 1 < text.size() && text[place + 1] == '=';
        if (text[place] == '=' && !longer)
          throw_hint(place,
                     "a single = compares nothing. Equal is ==, at most is <=, at least is >=.");
        if (text[place] == '!' && !longer)
          return 0;
        if (brackets.back().compared)
          throw_hint(place,
                     "this compares the outcome of another comparison. Between two numbers is "
                     "a < x && x < b.");
        brackets.back().compared = true;
        return longer ? 1 : 0;
      }

      const std::string &text;
      const std::string &origin;
      std::vector<Bracket> brackets = {{false, false}};
    };


    /** deal.II prints what muParser says before it throws the same. */
    class SilentErrors
    {
    public:
      SilentErrors()
        : original(std::cerr.rdbuf(nullptr))
      {
      }

      ~SilentErrors()
      {
        std::cerr.rdbuf(original);
        std::cerr.clear();
      }

    private:
      std::streambuf *const original;
    };
  } // namespace


  Expression::Expression(const std::string &text,
                         const unsigned int n_components,
                         const std::string &origin,
                         const std::map<std::string, double> &names)
    : n_components(n_components)
  {
    const auto components = dealii::Utilities::split_string_list(text, ';');
    if (components.size() != n_components)
      throw InputError(origin + ": found " + std::to_string(components.size()) +
                       " expression(s); there must be " + std::to_string(n_components) +
                       ", set apart by semicolons.");

    zero = true;
    for (const std::string &component : components)
      {
        if (component.empty() && n_components > 1)
          throw InputError(origin + ": one of its expressions is empty; for nothing write 0.");
        Misreadings(component, origin).refuse();
        zero = zero && says_zero(component);
      }
    time_dependent = std::regex_search(text, std::regex("\\bt\\b"));

    std::map<std::string, double> constants = names;
    constants["pi"]                         = dealii::numbers::PI;
    const SilentErrors silence;
    try
      {
        function = std::make_unique<dealii::FunctionParser<3>>(n_components);
        function->initialize("x,y,z,t", components, constants, true);
        for (unsigned int c = 0; c < n_components; ++c)
          function->value(dealii::Point<3>(), c); // muParser reads the text at the first evaluation
      }
    catch (const dealii::ExceptionBase &exception)
      {
        throw InputError(
          origin + ": " + reason(exception) +
          "\nAn expression uses x, y, z, t, pi, numbers, + - * / ^, comparisons, && ||, "
          "if(condition, a, b) and functions such as sin, exp, sqrt, min, max.");
      }
  }


  bool
  Expression::says_zero(const std::string &text)
  {
    return std::regex_match(text, std::regex("[+-]?0*\\.?0*"));
  }


  double
  Expression::value(const dealii::Point<3> &point,
                    const double time,
                    const unsigned int component) const
  {
    function->set_time(time);
    return function->value(point, component);
  }
} // namespace Supple
