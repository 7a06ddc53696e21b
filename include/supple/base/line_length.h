#ifndef supple_line_length_h
#define supple_line_length_h

#include <supple/base/error.h>

#include <string>

namespace Supple
{
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
} // namespace Supple

#endif
