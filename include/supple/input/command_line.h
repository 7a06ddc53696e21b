#ifndef supple_command_line_h
#define supple_command_line_h

#include <supple/input/parameter_file.h>

#include <string>
#include <vector>

namespace Supple
{
  /** What the user typed. */
  struct CommandLine
  {
    enum class Action
    {
      run,
      check,
      live,
      print_parameters,
      print_version,
      print_help
    };

    Action action = Action::run;
    std::string scene;               ///< parameter file
    std::vector<Override> overrides; ///< of --set
    std::string output;              ///< of --output, may be empty
    std::string format = "prm";      ///< of --print-parameters
    bool quiet         = false;
    bool aims          = false; ///< an error is given, and the soonest run is looked for

    /** @throws InputError */
    static CommandLine
    parse(int argc, char **argv);

    static std::string
    help();
  };


  /** @throws InputError if two of these, which come from the same place, set one entry */
  void
  require_single(const std::vector<Override> &overrides);


  /** A message as it goes to the screen: the middle of lines with more than a thousand characters
   * is left out, and what is no character of a text, such as the commands of a terminal, becomes
   * '?'.
   */
  std::string
  on_one_screen(const std::string &message);
} // namespace Supple

#endif
