#include <supple/input/command_line.h>

#include <supple/base/error.h>

#include <algorithm>
#include <map>
#include <sstream>

namespace Supple
{
  std::string
  CommandLine::help()
  {
    return "Supple moves soft elastic bodies: a parameter file goes in, VTU files and histories "
           "come out.\n"
           "\n"
           "  supple SCENE.prm                  run a scene\n"
           "    --set \"Section/Entry=value\"     change a parameter (may be given several times)\n"
           "    --output DIR                    where results go (default: output/ and the scene's "
           "name)\n"
           "    --quiet                         say nothing but errors\n"
           "    --aim \"1 %\"                     find the soonest run with an error below "
           "this\n"
           "  supple STUDY.prm                  run many variants of a scene and compare them\n"
           "  supple IDENTIFICATION.prm         fit two layers of skin to measurements\n"
           "  supple --live SCENE.prm           take the body in the hand, on a page in the "
           "browser\n"
           "  supple --check SCENE.prm          parse, build the mesh, validate, run nothing\n"
           "  supple --print-parameters [prm|json]\n"
           "                                    every entry with its default, unit, range and "
           "meaning\n"
           "  supple --version | --help\n"
           "\n"
           "Exit status: 0 done; 1 the input is wrong; 2 the computation failed or was "
           "interrupted.\n"
           "On several processes: mpirun -np 2 supple SCENE.prm\n";
  }


  CommandLine
  CommandLine::parse(const int argc, char **argv)
  {
    const std::vector<std::string> words(argv + 1, argv + argc);
    CommandLine line;

    for (std::size_t i = 0; i < words.size(); ++i)
      {
        const std::string &word = words[i];
        const auto value        = [&](const std::string &what) {
          if (i + 1 >= words.size() || words[i + 1].rfind("--", 0) == 0)
            throw InputError(word + ": " + what + " must follow.");
          return words[++i];
        };
        if (word == "--help" || word == "-h")
          line.action = Action::print_help;
        else if (word == "--version")
          line.action = Action::print_version;
        else if (word == "--check")
          line.action = Action::check;
        else if (word == "--live")
          line.action = Action::live;
        else if (word == "--quiet")
          line.quiet = true;
        else if (word == "--set")
          line.overrides.push_back({value("\"Section/Entry=value\"")});
        else if (word == "--aim")
          {
            line.overrides.push_back(
              {"Study/Aim=" + value("a percentage, such as \"1 %\","), "--aim"});
            line.aims = true;
          }
        else if (word == "--output")
          line.output = value("a folder");
        else if (word == "--print-parameters")
          {
            line.action = Action::print_parameters;
            if (i + 1 < words.size())
              line.format = words[++i];
            if (line.format != "prm" && line.format != "json")
              throw InputError("--print-parameters " + line.format +
                               ": the format is prm or json.");
          }
        else if (word.size() > 1 && word[0] == '-')
          throw InputError(word + ": there is no such option.\n\n" + help());
        else if (line.scene.empty())
          line.scene = word;
        else
          throw InputError(word + ": one scene at a time; " + line.scene + " is given already.");
      }

    require_single(line.overrides);
    const bool needs_scene =
      line.action == Action::run || line.action == Action::check || line.action == Action::live;
    if (needs_scene && line.scene.empty())
      throw InputError("A scene is missing.\n\n" + help());
    return line;
  }


  void
  require_single(const std::vector<Override> &overrides)
  {
    std::map<std::string, std::string> texts;
    for (const Override &override : overrides)
      {
        const auto [known, is_new] = texts.emplace(override.entry(), override.text);
        if (!is_new)
          throw InputError(override.place + " \"" + override.text + "\": " + override.entry() +
                           " is set already, by \"" + known->second +
                           "\"; only one of the two would count.");
      }
  }


  std::string
  on_one_screen(const std::string &message)
  {
    constexpr std::size_t most = 1000, head = 600, tail = 300;
    std::istringstream lines(message);
    std::string text, line;
    while (std::getline(lines, line))
      {
        if (line.size() > most)
          line = line.substr(0, head) + " ... " + line.substr(line.size() - tail);
        std::replace_if(
          line.begin(),
          line.end(),
          [](const unsigned char letter) { return letter < ' ' || letter == 127; },
          '?');
        text += (text.empty() ? "" : "\n") + line;
      }
    return text;
  }
} // namespace Supple
