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
    ParameterHandler scene_entries, study_entries, identification_entries;
    parameters.tools.emplace_back(); // as an example
    parameters.tools.back().name = "NAME";
    parameters.declare(scene_entries);
    study.declare(study_entries);
    identification.declare(identification_entries);
    if (format == "json")
      {
        study.declare(scene_entries);
        identification.declare(scene_entries);
        scene_entries.print_parameters(out, ParameterHandler::JSON);
        return;
      }
    scene_entries.print_parameters(out, ParameterHandler::PRM);

    // What is printed stays a scene.
    const std::vector<std::pair<std::string, ParameterHandler *>> others = {
      {"A study", &study_entries}, {"An identification", &identification_entries}};
    for (const auto &[name, entries] : others)
      {
        out << "\n# " << name << " is a file of its own, with this subsection alone:\n";
        std::stringstream text;
        entries->print_parameters(text, ParameterHandler::PRM);
        std::string line;
        while (std::getline(text, line))
          out << (line.empty() ? "" : "# ") << line << '\n';
      }
  }
} // namespace Supple
