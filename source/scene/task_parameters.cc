#include <supple/scene/task_parameters.h>

#include <supple/base/error.h>
#include <supple/input/command_line.h>
#include <supple/scene/read_scene.h>

#include <deal.II/base/utilities.h>

#include <filesystem>

namespace Supple
{
  using dealii::Utilities::trim;

  std::vector<std::string>
  split_outside_brackets(const std::string &text, const char separator)
  {
    std::vector<std::string> parts(1);
    int depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
      {
        depth += (text[i] == '[') - (text[i] == ']');
        const bool doubled =
          (i > 0 && text[i - 1] == separator) || (i + 1 < text.size() && text[i + 1] == separator);
        if (text[i] == separator && depth == 0 && !doubled)
          parts.emplace_back();
        else
          parts.back() += text[i];
      }
    return parts;
  }


  std::vector<Override>
  override_list(const std::string &text, const std::string &place)
  {
    std::vector<Override> list;
    for (const std::string &part : split_outside_brackets(text, '|'))
      if (!trim(part).empty())
        list.push_back({trim(part), place});
    require_single(list);
    return list;
  }


  TaskParameters::TaskParameters(const std::string &subsection)
    : subsection(subsection)
  {
  }


  void
  TaskParameters::parse(dealii::ParameterHandler &prm,
                        const std::string &file_name,
                        const std::vector<Override> &all_overrides)
  {
    file = ParameterFile(file_name);
    name = file.name();
    parse_rest(prm, all_overrides);
  }


  void
  TaskParameters::parse_for_scene(dealii::ParameterHandler &prm,
                                  const std::string &scene_file,
                                  const std::vector<Override> &all_overrides)
  {
    scene = scene_file;
    name  = ParameterFile(scene_file).name() + "-aim";
    parse_rest(prm, all_overrides);
  }


  void
  TaskParameters::parse_rest(dealii::ParameterHandler &prm,
                             const std::vector<Override> &all_overrides)
  {
    std::vector<Override> own;
    for (const Override &override : all_overrides)
      {
        const bool mine = trim(override.text.substr(0, override.text.find('/'))) == subsection;
        (mine ? own : command_line).push_back(override);
      }
    file.parse(prm, own);
  }


  Parameters
  TaskParameters::read_scene(const std::vector<Override> &more) const
  {
    std::vector<Override> list = override_list(overrides, place("Overrides"));
    list.insert(list.end(), command_line.begin(), command_line.end());
    list.insert(list.end(), more.begin(), more.end());
    std::error_code unreadable; // a name that is too long is no exception
    if (!std::filesystem::is_regular_file(path(scene), unreadable))
      throw InputError(place("Scene") + ": there is no such parameter file: " + path(scene) + ".");
    Parameters parameters = Supple::read_scene(path(scene), list);
    if (!parameters.live.motion.empty())
      throw InputError(parameters.origin("Live/Motion") +
                       ": a scene that repeats what was done by hand is run by itself; no other "
                       "file can ask for its runs.");
    return parameters;
  }


  std::string
  TaskParameters::scene_in_words() const
  {
    return "Scene: `" + path(scene) + "`" +
           (overrides.empty() ? std::string() : ", with `" + overrides + "`");
  }


  std::string
  TaskParameters::path(const std::string &as_written) const
  {
    const std::filesystem::path path(as_written);
    return (path.is_absolute() ? path : std::filesystem::path(file.folder()) / path)
      .lexically_normal()
      .string();
  }


  std::string
  TaskParameters::place(const std::string &entry) const
  {
    const std::string where = file.place(subsection + "/" + entry);
    return (where.empty() ? "" : where + ": ") + subsection + "/" + entry;
  }


  std::string
  TaskParameters::output_folder() const
  {
    return "output/" + name;
  }
} // namespace Supple
