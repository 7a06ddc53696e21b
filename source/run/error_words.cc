#include <supple/base/text.h>
#include <supple/observe/space_error.h>
#include <supple/run/error_words.h>

namespace Supple
{
  std::string
  percent_of(const double part)
  {
    return digits(100. * part, 2) + " %";
  }


  std::string
  part_of(const double part, const bool at_least, const std::string &whole)
  {
    constexpr double least_told = 1e-4; // below it other errors are larger

    if (!(part <= largest_told_error))
      return "more than " + percent_of(largest_told_error) + " of " + whole;
    if (part < least_told)
      return "less than " + percent_of(least_told) + " of " + whole;
    return (at_least ? "more than " : "about ") + percent_of(part) + " of " + whole;
  }
} // namespace Supple
