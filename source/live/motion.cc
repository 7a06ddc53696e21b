#include <supple/live/motion.h>

#include <supple/base/error.h>
#include <supple/base/files.h>
#include <supple/base/text.h>

#include <deal.II/base/utilities.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <sstream>

namespace Supple
{
  namespace
  {
    constexpr unsigned long most_steps = std::numeric_limits<unsigned int>::max();

    Deed
    deed_of(const std::string &line, const std::string &place)
    {
      std::istringstream words(line);
      std::string step_word, time_word, step, time, text;
      words >> step_word >> step >> time_word >> time;
      std::getline(words >> std::ws, text);
      char *step_end, *time_end;
      errno                      = 0;
      const unsigned long number = std::strtoul(step.c_str(), &step_end, 10);
      const double at            = std::strtod(time.c_str(), &time_end);
      if (step_word != "step" || time_word != "time" || step.empty() || *step_end != '\0' ||
          step[0] == '-' || errno != 0 || number > most_steps || time.empty() ||
          *time_end != '\0' || !std::isfinite(at) || at < 0. || text.empty())
        throw InputError(place + ": found '" + line +
                         "'; a line of a motion is \"step NUMBER time SECONDS DEED\", such as "
                         "\"step 118 time 1.9666 release 57\".");
      return {static_cast<unsigned int>(number), at, text, place};
    }
  } // namespace


  std::vector<Deed>
  read_motion(const std::string &file)
  {
    if (!std::filesystem::is_regular_file(file))
      throw InputError(file + ": there is no such motion file, or it can't be read.");
    std::istringstream lines(content_of(file));
    std::vector<Deed> deeds;
    std::string line;
    for (unsigned int number = 1; std::getline(lines, line); ++number)
      {
        line             = dealii::Utilities::trim(line); // of blanks, and of a carriage return
        const auto first = line.find_first_not_of(' ');
        if (first == std::string::npos || line[first] == '#')
          continue;
        const std::string place = file + ":" + std::to_string(number);
        const Deed deed         = deed_of(line, place);
        if (!deeds.empty() && (deed.step < deeds.back().step || deed.time < deeds.back().time))
          throw InputError(place + ": it comes before the line above (step " +
                           std::to_string(deeds.back().step) + "); lines go on in time.");
        if (!deeds.empty() && deeds.back().text == end_of_motion)
          throw InputError(place + ": the motion has ended in the line above.");
        deeds.push_back(deed);
      }
    return deeds;
  }


  std::string
  line_of(const Deed &deed)
  {
    return "step " + std::to_string(deed.step) + " time " + digits(deed.time, all_digits) + " " +
           deed.text + "\n";
  }

} // namespace Supple
