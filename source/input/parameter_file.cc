#include <supple/input/parameter_file.h>

#include <supple/base/error.h>
#include <supple/base/files.h>
#include <supple/base/text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
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


    using Lines = ParameterFile::Lines;


    /** A # amid a word, as in the name of a file, would begin a comment there. */
    void
    refuse_comment_within(const std::string &value, const std::string &place)
    {
      const auto mark = value.find('#');
      if (mark == std::string::npos || mark == 0 || mark + 1 == value.size() ||
          std::isspace(static_cast<unsigned char>(value[mark - 1])) != 0 ||
          std::isspace(static_cast<unsigned char>(value[mark + 1])) != 0)
        return;
      throw InputError(place + ": a # begins a comment, so that only '" +
                       dealii::Utilities::trim(value.substr(0, mark)) +
                       "' is left of the value. No value can contain a #; write a comment with "
                       "blanks around its #.");
    }


    /** Finds at which line each entry of a parameter file is set, line by line. */
    class LineFinder
    {
    public:
      void
      read(const std::string &line, const std::string &place)
      {
        // Made once: a regular expression takes longer to make than to match.
        static const std::regex subsection("\\s*subsection\\s+(.*?)\\s*(#.*)?", std::regex::icase);
        static const std::regex end("\\s*end\\s*(#.*)?", std::regex::icase);
        static const std::regex entry("\\s*set\\s+(.*?)\\s*=(.*)", std::regex::icase);

        std::smatch found;
        if (std::regex_match(line, found, subsection))
          {
            sections.push_back(plain_name(found[1]));
            if (sections.size() == 1)
              lines.sections.emplace(sections[0], place);
          }
        else if (std::regex_match(line, end) && !sections.empty())
          sections.pop_back();
        else if (std::regex_match(line, found, entry))
          {
            refuse_comment_within(found[2], place);
            set(path_of(plain_name(found[1])), place);
          }
      }

      /** Takes the lines of a file that is included here. */
      void
      include(const Lines &included)
      {
        for (const auto &[name, place] : included.sections)
          lines.sections.emplace(name, place);
        for (const auto &[name, place] : included.entries)
          {
            const std::string entry = path_of(name);
            const auto known        = lines.entries.find(entry);
            if (known != lines.entries.end())
              refuse_second(entry, place, known->second);
            lines.entries[entry] = place;
          }
      }

      Lines lines;

    private:
      std::string
      path_of(const std::string &name) const
      {
        std::string path;
        for (const std::string &section : sections)
          path += section + "/";
        return path + name;
      }

      /** What an included file has set may be set again after it. */
      void
      set(const std::string &entry, const std::string &place)
      {
        const auto own = own_entries.find(entry);
        if (own != own_entries.end())
          refuse_second(entry, place, own->second);
        own_entries[entry]   = place;
        lines.entries[entry] = place;
      }

      [[noreturn]] static void
      refuse_second(const std::string &entry, const std::string &place, const std::string &first)
      {
        throw InputError(
          place + ": " + entry + " is set already, at " + first +
          "; only one of the two lines would count." +
          (entry.rfind("Motion/", 0) == 0 ? " A second motion has subsection Motion 2." : ""));
      }

      std::vector<std::string> sections; ///< in which the next line is
      std::map<std::string, std::string> own_entries;
    };


    std::string
    value_of(const std::string &entry, ParameterHandler &prm)
    {
      const auto slash = entry.find('/');
      prm.enter_subsection(entry.substr(0, slash));
      const std::string value = prm.get(entry.substr(slash + 1));
      prm.leave_subsection();
      return value;
    }


    /** All entries and sections that are declared. */
    Lines
    known_names(const ParameterHandler &prm)
    {
      std::ostringstream printed;
      prm.print_parameters(printed, ParameterHandler::ShortPRM);
      std::istringstream lines(printed.str());
      LineFinder finder;
      std::string line;
      while (std::getline(lines, line)) // values may be too long for regular expressions
        finder.read(line.substr(0, std::min(line.find('='), line.size() - 1) + 1), "");
      return finder.lines;
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
    plain_text(const std::string &file, const std::string &message)
    {
      if (!std::ifstream(file) || !std::filesystem::is_regular_file(file))
        throw InputError(message);
      std::string content = content_of(file);
      if (content.rfind("\xef\xbb\xbf", 0) == 0)
        throw InputError(file +
                         ":1: the file begins with a byte order mark, three bytes that editors do "
                         "not show. Save it as UTF-8 without one.");
      return content;
    }


    /** The lines of a file and of those that it includes. Refuses what deal.II can't read without
     * an end of the program: long lines, of which one that ends with a backslash goes on in the
     * next one, and files that include themselves.
     * @param including the files that include this one, and this one */
    Lines
    find_lines(const std::string &file,
               const std::string &text,
               const std::set<std::string> &including)
    {
      LineFinder finder;
      std::istringstream lines(text);
      std::string line, joined;
      for (unsigned int number = 1; std::getline(lines, line); ++number)
        {
          const std::string place = file + ":" + std::to_string(number);
          require_length(line.size(), longest_line, place);
          finder.read(line, place);
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
            plain_text(next, place + ": there is no file " + next + ", or it can't be read.");
          auto chain = including;
          if (!chain.insert(std::filesystem::canonical(next)).second)
            throw InputError(place + ": " + next + " includes itself.");
          finder.include(find_lines(next, included, chain));
        }
      return finder.lines;
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
    text = plain_text(file, file + ": there is no such parameter file, or it can't be read.");
    if (dealii::Utilities::trim(text).empty())
      throw InputError(file + ": this parameter file is empty.");
    lines = find_lines(file, text, {std::filesystem::canonical(file)});
  }


  std::map<std::string, std::string>
  ParameterFile::sections() const
  {
    return lines.sections;
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
    refuse_comment_within(value, here);
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
    places = lines.entries;
    for (const auto &[entry, place] : known_names(prm).entries)
      defaults[entry] = value_of(entry, prm);
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
      if (defaults.count(entry) > 0)
        values[entry] = value_of(entry, prm);
  }


  void
  ParameterFile::require_declared(const std::string &entry) const
  {
    if (!defaults.empty() && defaults.count(entry) == 0)
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


  bool
  ParameterFile::changes(const std::string &entry) const
  {
    require_declared(entry);
    const auto found = values.find(entry);
    return found != values.end() && found->second != defaults.at(entry);
  }


  std::string
  ParameterFile::value(const std::string &entry) const
  {
    require_declared(entry);
    const auto found = values.find(entry);
    return found == values.end() ? defaults.at(entry) : found->second;
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
