#include <supple/input/parameter_file.h>

#include <supple/base/error.h>
#include <supple/base/text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace Supple
{
  using dealii::ParameterHandler;

  namespace
  {
    /** What deal.II says of a parameter file, in one line that begins with file:line unless @p
     * place is given. */
    std::string
    plain_message(const dealii::ExceptionBase &exception, const std::string &place = "")
    {
      std::ostringstream text;
      exception.print_info(text);
      const std::string line =
        std::regex_replace(dealii::Utilities::trim(text.str()), std::regex("\\n\\s*"), " ");
      const std::regex where("^Line <(\\d+)> of file <([^:>]*)>?: ");
      return std::regex_replace(line, where, place.empty() ? "$2:$1: " : place + ": ") +
             "\nsupple --print-parameters lists every entry.";
    }


    /** The file:line of entries and of the outermost subsections. */
    struct Lines
    {
      std::map<std::string, std::string> entries;
      std::map<std::string, std::string> sections;
      std::vector<std::string> twice; ///< messages: entries that two lines set
    };


    /** With a single blank where there are several, as deal.II reads names. */
    std::string
    plain_name(const std::string &name)
    {
      std::istringstream words(name);
      std::string all, word;
      while (words >> word)
        all += (all.empty() ? "" : " ") + word;
      return all;
    }


    /** Finds at which line each entry of a parameter file is set. */
    Lines
    find_lines(const std::string &file, const std::string &text)
    {
      // Made once: a regular expression takes longer to make than to match.
      const std::regex subsection("\\s*subsection\\s+(.*?)\\s*(#.*)?", std::regex::icase);
      const std::regex end("\\s*end\\s*(#.*)?", std::regex::icase);
      const std::regex entry("\\s*set\\s+(.*?)\\s*=.*", std::regex::icase);

      Lines found_lines;
      std::vector<std::string> sections;
      std::istringstream lines(text);
      std::string line;
      for (unsigned int number = 1; std::getline(lines, line); ++number)
        {
          const std::string place = file + ":" + std::to_string(number);
          std::smatch found;
          if (std::regex_match(line, found, subsection))
            {
              const std::string section = plain_name(found[1]);
              if (sections.empty())
                found_lines.sections.emplace(section, place);
              sections.push_back(section);
            }
          else if (std::regex_match(line, end) && !sections.empty())
            sections.pop_back();
          else if (std::regex_match(line, found, entry))
            {
              std::string path;
              for (const std::string &section : sections)
                path += section + "/";
              path += plain_name(found[1]);
              const auto [known, is_new] = found_lines.entries.emplace(path, place);
              if (!is_new)
                found_lines.twice.push_back(place + ": " + path + " is set already, at " +
                                            known->second +
                                            "; only one of the two lines would count.");
              known->second = place;
            }
        }
      return found_lines;
    }


    /** All entries and sections that are declared. */
    Lines
    known_names(const ParameterHandler &prm)
    {
      std::ostringstream printed;
      prm.print_parameters(printed, ParameterHandler::ShortPRM);
      std::istringstream lines(printed.str());
      std::string line, without_values;
      while (std::getline(lines, line)) // values may be too long for regular expressions
        without_values += line.substr(0, std::min(line.find('='), line.size() - 1) + 1) + "\n";
      return find_lines("", without_values);
    }


    /** Says more where a name is not known than deal.II, which only says that it is not there: an
     * unknown entry in full, and which known entry, section or choice is near.
     * @param entry which the message is about: "Section/Entry", or "Section" alone */
    std::string
    with_near_name(const std::string &message,
                   const std::string &entry,
                   const ParameterHandler &prm)
    {
      const auto line_end       = std::min(message.find('\n'), message.size());
      const std::string first   = message.substr(0, line_end);
      const std::string section = entry.substr(0, entry.find('/'));
      const Lines known         = known_names(prm);
      const auto with           = [&](const std::size_t begin, const std::string &text) {
        return first.substr(0, begin) + text + message.substr(line_end);
      };
      std::vector<std::string> names;

      // The words of deal.II 9.4 and of 9.6.
      const auto no_section = std::min(first.find("There is no such subsection"),
                                       first.find("You are trying to enter a subsection"));
      if (no_section != std::string::npos)
        {
          for (const auto &[name, place] : known.sections)
            names.push_back(name);
          return with(no_section,
                      "there is no subsection " + section + did_you_mean(section, names));
        }
      const auto no_entry = first.find("No entry with name");
      if (no_entry != std::string::npos)
        {
          for (const auto &[name, place] : known.entries)
            if (name.rfind(section + "/", 0) == 0)
              names.push_back(name.substr(section.size() + 1));
          return with(no_entry,
                      "there is no entry " + entry +
                        did_you_mean(entry.substr(std::min(section.size() + 1, entry.size())),
                                     names));
        }
      const std::string before = "The entry value", after = " for the entry", choice = "one of ";
      const auto value = first.find(before), end = first.rfind(after),
                 choices = first.rfind(choice);
      if (value == std::string::npos || end == std::string::npos || choices == std::string::npos ||
          choices < end)
        return message;
      const auto begin = value + before.size();
      return with(first.size(),
                  did_you_mean(dealii::Utilities::trim(first.substr(begin, end - begin)),
                               dealii::Utilities::split_string_list(
                                 first.substr(choices + choice.size()), ',')));
    }


    // Regular expressions call themselves for each letter, with half a kilobyte of the stack: what
    // is too long for them ends the program.
    constexpr std::size_t longest_joined_line = 12000;


    std::string
    content_of(const std::string &file, const std::string &message)
    {
      std::ifstream stream(file);
      if (!stream || !std::filesystem::is_regular_file(file))
        throw InputError(message);
      std::stringstream content;
      content << stream.rdbuf();
      return content.str();
    }


    /** Refuses what deal.II can't read without an end of the program: long lines, of which one that
     * ends with a backslash goes on in the next one, and files that include themselves.
     * @param including the files that include this one, and this one */
    void
    require_readable(const std::string &file,
                     const std::string &text,
                     const std::set<std::string> &including)
    {
      std::istringstream lines(text);
      std::string line, joined;
      for (unsigned int number = 1; std::getline(lines, line); ++number)
        {
          const std::string place = file + ":" + std::to_string(number);
          require_length(line.size(), longest_line, place);
          joined += line = dealii::Utilities::trim(line);
          require_length(joined.size(), longest_joined_line, place);
          if (!line.empty() && line.back() == '\\')
            {
              joined.pop_back();
              continue;
            }
          std::replace(joined.begin(), joined.end(), '\t', ' ');
          const std::string whole = std::exchange(joined, "");
          if (whole.rfind("include ", 0) != 0 && whole.rfind("INCLUDE ", 0) != 0)
            continue;
          const std::string next = dealii::Utilities::trim(whole.substr(8, whole.find('#') - 8));
          const std::string included =
            content_of(next, place + ": there is no file " + next + ", or it can't be read.");
          auto chain = including;
          if (!chain.insert(std::filesystem::canonical(next)).second)
            throw InputError(place + ": " + next + " includes itself.");
          require_readable(next, included, chain);
        }
      const auto twice = find_lines(file, text).twice;
      if (twice.empty())
        return;
      const bool moves = twice.front().find(": Motion/") != std::string::npos;
      throw InputError(twice.front() + (moves ? " A second motion has subsection Motion 2." : ""));
    }
  } // namespace


  std::string
  Override::entry() const
  {
    using dealii::Utilities::trim;
    const std::string path = text.substr(0, text.find('='));
    const auto slash       = path.find('/');
    return slash == std::string::npos
             ? path
             : trim(path.substr(0, slash)) + "/" + trim(path.substr(slash + 1));
  }


  void
  Override::refuse(const std::string &task, const std::string &set_at) const
  {
    throw InputError(place + " \"" + text + "\": it would change nothing, for each run of the " +
                     task + " sets " + entry() + " (" + set_at + ").");
  }


  ParameterFile::ParameterFile(const std::string &file)
    : file(file)
  {
    // parse_input() makes the file if it is not there
    text = content_of(file, file + ": there is no such parameter file, or it can't be read.");
    if (dealii::Utilities::trim(text).empty())
      throw InputError(file + ": this parameter file is empty.");
    require_readable(file, text, {std::filesystem::canonical(file)});
  }


  std::map<std::string, std::string>
  ParameterFile::sections() const
  {
    return find_lines(file, text).sections;
  }


  bool
  ParameterFile::has_alone(const std::string &file, const std::string &section)
  {
    const auto all = ParameterFile(file).sections();
    if (all.count(section) == 0)
      return false;
    for (const auto &[name, place] : all)
      if (name != section)
        throw InputError(place + ": subsection " + name + " beside " + section +
                         ", which stands alone in its file. It belongs into the scene that " +
                         section + "/Scene names; " + section +
                         "/Overrides changes entries of that.");
    return true;
  }


  std::string
  ParameterFile::name() const
  {
    return std::filesystem::path(file).stem().string();
  }


  std::string
  ParameterFile::folder() const
  {
    return std::filesystem::path(file).parent_path().string();
  }


  void
  ParameterFile::apply(ParameterHandler &prm, const Override &override)
  {
    const std::string &text = override.text;
    require_length(text.size(), longest_line, override.place);
    const bool in_a_file   = override.place.find(':') != std::string::npos;
    const std::string here = override.place + (in_a_file ? ": \"" : " \"") + text + "\"";
    const auto equal       = text.find('=');
    const auto slash       = text.find('/');
    if (equal == std::string::npos || slash == std::string::npos || slash > equal)
      throw InputError(here + ": no section, entry or value found. What is right is " +
                       "\"Section/Entry=value\", such as \"Time/Steps=10\".");

    const std::string section = dealii::Utilities::trim(text.substr(0, slash));
    const std::string name    = dealii::Utilities::trim(text.substr(slash + 1, equal - slash - 1));
    const std::string value   = dealii::Utilities::trim(text.substr(equal + 1));
    try
      {
        prm.parse_input_from_string("subsection " + section + "\nset " + name + " = " + value +
                                    "\nend\n");
      }
    catch (const dealii::ExceptionBase &exception)
      {
        throw InputError(with_near_name(plain_message(exception, here), section + "/" + name, prm));
      }
    places[section + "/" + name] = override.place;
  }


  void
  ParameterFile::parse(ParameterHandler &prm, const std::vector<Override> &overrides)
  {
    const Lines lines = find_lines(file, text);
    places            = lines.entries;
    for (const auto &[entry, place] : known_names(prm).entries)
      declared.insert(entry);
    std::istringstream content(text);
    try
      {
        prm.parse_input(content, file);
      }
    catch (const dealii::ExceptionBase &exception)
      {
        std::string message = plain_message(exception);
        for (const auto *named : {&lines.sections, &lines.entries})
          for (const auto &[name, place] : *named)
            if (message.rfind(place + ": ", 0) == 0)
              message = with_near_name(message, name, prm);
        throw InputError(message);
      }
    for (const Override &override : overrides)
      apply(prm, override);

    for (const auto &[entry, place] : places)
      {
        const auto slash = entry.find('/');
        if (slash == std::string::npos)
          continue;
        prm.enter_subsection(entry.substr(0, slash));
        values[entry] = prm.get(entry.substr(slash + 1));
        prm.leave_subsection();
      }
  }


  void
  ParameterFile::require_declared(const std::string &entry) const
  {
    if (!declared.empty() && declared.count(entry) == 0)
      throw std::logic_error("the program asks for an entry " + entry +
                             ", which it never declared");
  }


  std::string
  ParameterFile::place(const std::string &entry) const
  {
    require_declared(entry);
    const auto found = places.find(entry);
    return found == places.end() ? file : found->second;
  }


  std::string
  ParameterFile::origin(const std::string &entry) const
  {
    require_declared(entry);
    const auto found = places.find(entry);
    if (found == places.end())
      return entry + " (not set in the scene)";
    return found->second + ": " + entry + " = " + values.at(entry);
  }
} // namespace Supple
