#include <supple/base/expression.h>

#include <supple/base/error.h>

#include <deal.II/base/utilities.h>

#include <array>
#include <cctype>
#include <cmath>
#include <regex>
#include <vector>

#include <muParser.h>

namespace Supple
{
  namespace
  {
    /** "in 'x +', at character 4: ..." for characters counted from 1. */
    std::string
    at_character(const std::string &text, const std::size_t place, const std::string &what)
    {
      return "in '" + text + "', at character " + std::to_string(place + 1) + ": " + what;
    }


    std::string
    in_words(const mu::ParserError &error, const std::string &text)
    {
      if (text.empty())
        return "the expression is empty.";
      if (error.GetCode() == mu::ecINTERNAL_ERROR)
        return at_character(text, text.size(), "something is missing.");
      const std::regex position(
        "( found)?( at)?( expression)?( position [0-9]+| \\(position: [0-9]+\\))?\\.?$");
      const std::size_t place = error.GetPos() < 0 ? 0 : error.GetPos();
      return at_character(
        text,
        std::min(place, text.size()),
        std::regex_replace(error.GetMsg(), position, ".", std::regex_constants::format_first_only));
    }


    /** Those of deal.II's FunctionParser that muParser lacks or means otherwise. */
    void
    define_functions(mu::Parser &parser)
    {
      using Value = mu::value_type;
      parser.DefineFun(
        "if", +[](Value condition, Value yes, Value no) {
          return std::lround(condition) != 0 ? yes : no;
        });
      parser.DefineFun(
        "log", +[](Value x) { return std::log(x); });
      parser.DefineFun(
        "pow", +[](Value x, Value y) { return std::pow(x, y); });
      parser.DefineFun(
        "int", +[](Value x) { return std::round(x); });
      parser.DefineFun(
        "ceil", +[](Value x) { return std::ceil(x); });
      parser.DefineFun(
        "floor", +[](Value x) { return std::floor(x); });
      parser.DefineFun(
        "cot", +[](Value x) { return 1. / std::tan(x); });
      parser.DefineFun(
        "csc", +[](Value x) { return 1. / std::sin(x); });
      parser.DefineFun(
        "sec", +[](Value x) { return 1. / std::cos(x); });
      parser.DefineFun(
        "erf", +[](Value x) { return std::erf(x); });
      parser.DefineFun(
        "erfc", +[](Value x) { return std::erfc(x); });
      parser.DefineInfixOprt(
        "!", +[](Value x) -> Value { return std::lround(x) == 0; });
      parser.DefineOprt(
        "|",
        +[](Value a, Value b) -> Value { return std::lround(a) != 0 || std::lround(b) != 0; },
        1);
      parser.DefineOprt(
        "&",
        +[](Value a, Value b) -> Value { return std::lround(a) != 0 && std::lround(b) != 0; },
        2);
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
        std::smatch word;
        if (std::regex_search(text, word, std::regex("\\b(and|or|not)\\b")))
          throw_hint(word.position(), "and is &&, or is ||, not is !.");
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
        throw InputError(origin + ": " + at_character(text, place, hint));
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
  } // namespace


  /** A parser for each component; all of them read the same place and time. */
  struct Expression::Formulas
  {
    std::array<double, 4> place_and_time = {}; ///< x, y, z, t
    std::vector<mu::Parser> parsers;

    void
    add(const std::string &text, const std::map<std::string, double> &names)
    {
      mu::Parser &parser = parsers.emplace_back();
      parser.DefineConst("pi", dealii::numbers::PI);
      for (const auto &[name, value] : names)
        parser.DefineConst(name, value);
      for (unsigned int i = 0; i < 4; ++i)
        parser.DefineVar(std::string(1, "xyzt"[i]), &place_and_time[i]);
      define_functions(parser);
      parser.SetExpr(std::regex_replace(text, std::regex("(\\w+)(\\s+)\\("), "$2$1("));
      parser.Eval(); // muParser reads the text at the first evaluation
    }
  };


  Expression::Expression(const std::string &text,
                         const unsigned int n_components,
                         const std::string &origin,
                         const std::map<std::string, double> &names)
    : formulas(std::make_unique<Formulas>())
    , zero(true)
    , time_dependent(std::regex_search(text, std::regex("\\bt\\b")))
    , place_dependent(std::regex_search(text, std::regex("\\b[xyz]\\b")))
  {
    if (dealii::Utilities::trim(text).empty())
      throw InputError(origin + ": the expression is empty; for nothing write 0.");
    const auto components = dealii::Utilities::split_string_list(text, ';');
    if (components.size() != n_components)
      throw InputError(origin + ": found " + std::to_string(components.size()) +
                       " expression(s); there must be " + std::to_string(n_components) +
                       ", separated by semicolons.");

    for (const std::string &component : components)
      {
        if (component.empty() && n_components > 1)
          throw InputError(origin + ": one of its expressions is empty; for nothing write 0.");
        Misreadings(component, origin).refuse();
        zero = zero && says_zero(component);
        try
          {
            formulas->add(component, names);
          }
        catch (const mu::ParserError &error)
          {
            throw InputError(
              origin + ": " + in_words(error, component) +
              "\nAn expression uses x, y, z, t, pi, numbers, + - * / ^, comparisons, && ||, "
              "if(condition, a, b) and functions such as sin, exp, sqrt, min, max.");
          }
      }
  }


  Expression::Expression(Expression &&) noexcept = default;


  Expression::~Expression() = default;


  bool
  Expression::says_zero(const std::string &text)
  {
    return std::regex_match(text, std::regex("[+-]?0*\\.?0*([eE][+-]?[0-9]+)?"));
  }


  double
  Expression::value(const dealii::Point<3> &point,
                    const double time,
                    const unsigned int component) const
  {
    formulas->place_and_time = {{point[0], point[1], point[2], time}};
    return formulas->parsers[component].Eval();
  }
} // namespace Supple
