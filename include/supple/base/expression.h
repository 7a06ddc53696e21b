#ifndef supple_expression_h
#define supple_expression_h

#include <deal.II/base/point.h>

#include <map>
#include <memory>
#include <string>

namespace Supple
{
  /**
   * A muParser expression of x, y, z [m] and t [s], with one or three components separated by
   * semicolons. Written wrongly it is refused here and not at its first use. To the functions of
   * muParser it adds those that deal.II's FunctionParser has: if(), log() as ln(), pow(), int(),
   * ceil(), floor(), cot(), csc(), sec(), erf() and erfc(), and the operators &, | and !.
   */
  class Expression
  {
  public:
    /**
     * @param text         what the user wrote
     * @param n_components 1 or 3
     * @param origin       where it was written, for the message
     * @param names        more numbers that may be used
     * @throws InputError with the character at which the text goes wrong
     */
    Expression(const std::string &text,
               unsigned int n_components,
               const std::string &origin,
               const std::map<std::string, double> &names = {});
    Expression(Expression &&) noexcept;
    ~Expression();

    /** Not for several threads at once. */
    double
    value(const dealii::Point<3> &point, double time, unsigned int component = 0) const;

    /** True for "0" and "0; 0; 0": nothing to evaluate. */
    bool
    is_zero() const
    {
      return zero;
    }

    /** Whether a text is the number 0. */
    static bool
    says_zero(const std::string &text);

    bool
    depends_on_time() const
    {
      return time_dependent;
    }

    /** Whether x, y or z are in it. */
    bool
    depends_on_place() const
    {
      return place_dependent;
    }

  private:
    struct Formulas;

    std::unique_ptr<Formulas> formulas;
    bool zero;
    bool time_dependent;
    bool place_dependent;
  };
} // namespace Supple

#endif
