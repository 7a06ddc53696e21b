#include <supple/base/expression.h>

#include <supple/base/error.h>

#include <deal.II/base/utilities.h>

#include <iostream>
#include <regex>
#include <sstream>

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
      if (std::regex_search(all, found, std::regex("Message:\\s*(.*)")))
        return found[1];
      return dealii::Utilities::trim(all);
    }


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
      zero = zero && says_zero(component);
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
