#ifndef supple_patterns_h
#define supple_patterns_h

#include <deal.II/base/patterns.h>

#include <functional>
#include <memory>
#include <string>

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
} // namespace Supple

#endif
