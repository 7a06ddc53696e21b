#ifndef supple_near_name_h
#define supple_near_name_h

#include <string>
#include <vector>

namespace Supple
{
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
