#ifndef supple_text_h
#define supple_text_h

#include <supple/base/error.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace Supple
{
  /** With as many digits as it takes to read the same number back. */
  constexpr unsigned int all_digits = 17;


  /** A number as text, with @p n significant digits at most and no zeros at the end. */
  inline std::string
  digits(const double number, const unsigned int n)
  {
    // 15 digits are often all that it takes
    for (unsigned int precision = n == all_digits ? 15 : n;; ++precision)
      {
        std::ostringstream text;
        text.precision(precision);
        text << number;
        if (precision == n || std::strtod(text.str().c_str(), nullptr) == number)
          return text.str();
      }
  }


  /** No line of a parameter file or of a table needs more characters. */
  constexpr std::size_t longest_line = 4000;


  /** Refuses a line of input that is longer than is read.
   * @param place of the line, file:line
   * @throws InputError */
  inline void
  require_length(const std::size_t length, const std::size_t longest, const std::string &place)
  {
    if (length > longest)
      throw InputError(place + ": this line has " + std::to_string(length) +
                       " characters; at most " + std::to_string(longest) + " are read.");
  }


  /**
   * The end of a sentence about an unknown name: "; did you mean 'Young modulus'?" if one of the
   * known names is near, and nearer than all others; else a full stop. Near is a name that begins
   * with the given one, or into which two letters inserted, left out or exchanged turn it
   * (Levenshtein's distance; one letter if it has less than six). Capital letters count as small
   * ones.
   */
  std::string
  did_you_mean(const std::string &given, const std::vector<std::string> &known);
} // namespace Supple

#endif
