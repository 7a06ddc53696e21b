#ifndef supple_digits_h
#define supple_digits_h

#include <sstream>
#include <string>

namespace Supple
{
  /** With as many digits as it takes to read the same number back. */
  constexpr unsigned int all_digits = 17;


  /** A number as text, with @p n significant digits at most and no zeros at the end. */
  inline std::string
  digits(const double number, const unsigned int n)
  {
    std::ostringstream text;
    text.precision(n);
    text << number;
    return text.str();
  }
} // namespace Supple

#endif
