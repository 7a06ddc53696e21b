#ifndef supple_error_words_h
#define supple_error_words_h

#include <string>

namespace Supple
{
  /** "1.2 %" */
  std::string
  percent_of(double part);


  /** "about 45 % of tip.uz", "more than 50 % of tip.uz", "less than 0.01 % of tip.uz"
   * @param at_least it may be more than this */
  std::string
  part_of(double part, bool at_least, const std::string &whole);
} // namespace Supple

#endif
