#ifndef supple_parameter_reference_h
#define supple_parameter_reference_h

#include <ostream>
#include <string>

namespace Supple
{
  /** Prints every entry of scenes, studies and identifications with its default, unit, range and
   * meaning; @p format is "prm" or "json". */
  void
  print_reference(std::ostream &out, const std::string &format);
} // namespace Supple

#endif
