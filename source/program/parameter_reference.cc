#include <supple/program/parameter_reference.h>

#include <supple/identification/identification_parameters.h>
#include <supple/scene/parameters.h>
#include <supple/study/study_parameters.h>

#include <sstream>

namespace Supple
{
  using dealii::ParameterHandler;

  void
  print_reference(std::ostream &out, const std::string &format)
  {
    Parameters parameters;
    StudyParameters study;
    IdentificationParameters identification;
    ToolParameters tool;
    ParameterHandler scene_entries, tool_entries, study_entries, identification_entries;
    tool.name = "NAME";
    tool.declare(tool_entries);
    parameters.declare(scene_entries);
    study.declare(study_entries);
    identification.declare(identification_entries);
    if (format == "json")
      {
        tool.declare(scene_entries);
        study.declare(scene_entries);
        identification.declare(scene_entries);
        scene_entries.print_parameters(out, ParameterHandler::JSON);
        return;
      }
    scene_entries.print_parameters(out, ParameterHandler::PRM);

    // What is printed stays a scene.
    const std::vector<std::pair<std::string, ParameterHandler *>> others = {
      {"A tool is a subsection of the scene, with a name of its own", &tool_entries},
      {"A study is a file of its own, with this subsection alone", &study_entries},
      {"An identification is a file of its own, with this subsection alone",
       &identification_entries}};
    for (const auto &[name, entries] : others)
      {
        out << "\n# " << name << ":\n";
        std::stringstream text;
        entries->print_parameters(text, ParameterHandler::PRM);
        std::string line;
        while (std::getline(text, line))
          out << (line.empty() ? "" : "# ") << line << '\n';
      }
  }
} // namespace Supple
