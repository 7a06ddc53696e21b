#ifndef supple_motion_h
#define supple_motion_h

#include <string>
#include <vector>

namespace Supple
{
  /** What was done between two steps, as words that Hands understands. */
  struct Deed
  {
    unsigned int step;          ///< it was done after this one
    double time;                ///< then [s]
    std::string text;           ///< such as "move 57 0.1 0 0.02 over 0.01"
    std::string place = "here"; ///< file:line, to begin a message with
  };


  /** The word that ends a motion. */
  inline const std::string end_of_motion = "end";


  /** Reads session.motion, a deed in each line: "step 118 time 1.9666 move 57 0.1 0 0.02 over
   * 0.01". @throws InputError with file:line */
  std::vector<Deed>
  read_motion(const std::string &file);


  /** Such a line. */
  std::string
  line_of(const Deed &deed);
} // namespace Supple

#endif
