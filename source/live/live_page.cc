#include <supple/live/live_page.h>

#include <supple/base/error.h>
#include <supple/base/gather.h>
#include <supple/base/text.h>
#include <supple/contact/tool_surface.h>
#include <supple/forces/contact.h>
#include <supple/live/hands.h>
#include <supple/observe/measurement.h>
#include <supple/report/report.h>
#include <supple/report/report_page.h>
#include <supple/run/writers.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sstream>

namespace Supple
{
  namespace fs = std::filesystem;

  namespace
  {
    /** Appends numbers as they are in memory, which is little endian wherever this runs. */
    template <class Value, class Octets>
    void
    append(Octets &octets, const Value *values, const std::size_t n)
    {
      const auto *begin = reinterpret_cast<const char *>(values);
      octets.insert(octets.end(), begin, begin + n * sizeof(Value));
    }


    /** The name of an entry as deal.II's JSON has it, where letters are "_" and two hexadecimal
     * digits. */
    std::string
    plain_name(const std::string &mangled)
    {
      std::string name;
      for (std::size_t i = 0; i < mangled.size(); ++i)
        if (mangled[i] == '_' && i + 2 < mangled.size())
          {
            name += static_cast<char>(std::stoi(mangled.substr(i + 1, 2), nullptr, 16));
            i += 2;
          }
        else
          name += mangled[i];
      return name;
    }


    /** What is between two marks in a text; empty without them. */
    std::string
    between(const std::string &text, const std::string &before, const std::string &after)
    {
      const auto begin = text.find(before);
      if (begin == std::string::npos)
        return "";
      const auto end = text.find(after, begin + before.size());
      return text.substr(begin + before.size(), end - begin - before.size());
    }


    /** Whether an entry that may be set matters to this scene, so that the page shows it. */
    bool
    is_shown(const std::string &entry, const Parameters &scene)
    {
      const bool variable = scene.time.has_variable_steps();
      if (entry == "Time/Step")
        return !variable;
      if (entry == "Time/Relative tolerance")
        return variable;
      if (entry == "Contact/Friction")
        return scene.contact.between_bodies();
      return true;
    }


    Json
    describe(const std::string &entry, const nlohmann::json &declared, const std::string &value)
    {
      const std::string text  = declared.at("documentation");
      const std::string range = between(text, ". Range: ", "\n");
      Json choices;
      if (range.rfind("one of ", 0) == 0)
        for (std::string choice : dealii::Utilities::split_string_list(range.substr(7), ','))
          {
            if (!choice.empty() && choice.back() == '.')
              choice.pop_back();
            choices.push_back(choice);
          }
      return {{"entry", entry},
              {"value", value},
              {"unit", between(text, " Unit: ", ". Range: ")},
              {"range", range},
              {"choices", choices},
              {"meaning", text.substr(0, text.find(" Unit: "))}};
    }


    /** The entries that a session may set, with what deal.II's JSON says of them. It takes
     * milliseconds. */
    std::vector<std::pair<std::string, nlohmann::json>>
    declared_entries(const Parameters &scene)
    {
      Parameters presets;
      for (const ToolParameters &tool : scene.tools)
        {
          presets.tools.emplace_back();
          presets.tools.back().name = tool.name;
        }
      dealii::ParameterHandler prm;
      presets.declare(prm);
      std::ostringstream text;
      prm.print_parameters(text, dealii::ParameterHandler::JSON);
      const nlohmann::json all = nlohmann::json::parse(text.str());
      std::vector<std::pair<std::string, nlohmann::json>> entries;
      for (const auto &section : all.items())
        for (const auto &entry : section.value().items())
          {
            const std::string name = plain_name(section.key()) + "/" + plain_name(entry.key());
            if (entry.value().contains("value") && may_be_set(name))
              entries.emplace_back(name, entry.value());
          }
      return entries;
    }


    /** Those that the page shows, with their values in the scene as they are written there. */
    Json
    entries_of(const Parameters &scene)
    {
      Json entries = Json::array();
      for (const auto &[name, declared] : declared_entries(scene))
        if (is_shown(name, scene))
          entries.push_back(describe(name, declared, scene.file.value(name)));
      return entries;
    }


    Json
    arrow(const Arrow &vector)
    {
      return {vector[0], vector[1], vector[2]};
    }


    Json
    describe(const Tool &tool, const double extent, const double time)
    {
      Json axis;
      const Pose pose = tool.pose(time);
      if (tool.is_plane())
        axis = arrow(pose.turned(tool.parameters.normal / tool.parameters.normal.norm()));
      else if (tool.parameters.shape == ToolParameters::Shape::capsule)
        axis = arrow(pose.turned(tool.parameters.axis / tool.parameters.axis.norm()));
      Json description     = surface_of(tool, extent);
      description["axis"]  = axis;
      description["place"] = arrow(pose.place);
      return description;
    }


    Json
    description(const Session &session, const BodySurface &surface)
    {
      const Problem &problem       = session.now().present();
      const Parameters &parameters = problem.parameters;
      const Contact *const contact = problem.forces.contact();
      Json tools                   = Json::array();
      if (contact)
        for (const Tool &tool : contact->all_tools())
          tools.push_back(describe(tool, extent_of_planes(problem.body), session.now().time()));
      return {{"kind", "live"},
              {"name", full_name(parameters)},
              {"up", upward(parameters)},
              {"flat", problem.mesh.section.plane()},
              {"vertices", surface.rest.size() / 3},
              {"triangles", surface.triangles.size()},
              {"cells", problem.mesh.n_cells},
              {"dofs", problem.body.n_dofs()},
              {"processes", dealii::Utilities::MPI::n_mpi_processes(problem.mesh.communicator)},
              {"threads", problem.body.n_threads},
              {"step", parameters.time.has_variable_steps() ? Json() : Json(parameters.time.step)},
              {"method", parameters.time.method_name()},
              {"history", Measurement::column_names(parameters.has_contact())},
              {"probes", session.now().probe_columns()},
              {"tool_columns", ToolTables::columns()},
              {"tools", tools},
              {"entries", entries_of(parameters)},
              {"speed", 1.},
              {"running", false},
              {"version", SUPPLE_VERSION}};
    }


    /** Of each vertex of the surface, 1 if the scene holds it. */
    std::vector<unsigned char>
    held_vertices(const Problem &problem, const BodySurface &surface)
    {
      std::vector<unsigned int> own;
      for (unsigned int node = 0; node < problem.body.n_owned; ++node)
        if (problem.constraints.holds_node(node))
          own.push_back(problem.body.serial_vertex[node]);
      std::vector<unsigned int> all = gathered_on_first(own, problem.mesh.communicator);
      std::sort(all.begin(), all.end());
      std::vector<unsigned char> held;
      for (const unsigned int vertex : surface.index_in_mesh)
        held.push_back(std::binary_search(all.begin(), all.end(), vertex) ? 1 : 0);
      return held;
    }


    /** The files that an entry names, set apart by commas, as they are called from another folder.
     */
    std::string
    from_folder(const std::string &files, const std::string &base, const std::string &folder)
    {
      std::string all;
      for (const std::string &file : dealii::Utilities::split_string_list(files, ','))
        {
          std::error_code unknown; // then the path stays as it is
          const fs::path path = fs::weakly_canonical(fs::path(base) / file, unknown);
          all += (all.empty() ? "" : ", ") +
                 path.lexically_relative(fs::weakly_canonical(folder, unknown)).string();
        }
      return all;
    }
  } // namespace


  LiveContent
  live_content(const Session &session, const BodySurface &surface)
  {
    const std::vector<unsigned char> held = held_vertices(session.now().present(), surface);
    if (dealii::Utilities::MPI::this_mpi_process(session.now().present().mesh.communicator) != 0)
      return {};
    LiveContent content;
    content.page = page_text(description(session, surface));
    append(content.surface, surface.rest.data(), surface.rest.size());
    for (const auto &triangle : surface.triangles)
      append(content.surface, triangle.data(), 3);
    append(content.surface, surface.index_in_mesh.data(), surface.index_in_mesh.size());
    append(content.surface, held.data(), held.size());
    return content;
  }


  std::vector<std::string>
  names_of_entries(const Parameters &scene)
  {
    std::vector<std::string> names;
    for (const auto &[name, declared] : declared_entries(scene))
      names.push_back(name);
    return names;
  }


  Json
  values_of_entries(const std::vector<std::string> &names, const Parameters &scene)
  {
    Json values = Json::object();
    for (const std::string &name : names)
      if (is_shown(name, scene))
        values[name] = scene.file.value(name);
    return values;
  }


  std::vector<unsigned char>
  packed(const LiveFrame &frame)
  {
    constexpr std::size_t head_size = 64;
    constexpr float most            = std::numeric_limits<std::int16_t>::max();

    // A power of two: from frame to frame it seldom changes.
    float largest = 0.f;
    for (const float u : frame.displacements)
      largest = std::max(largest, std::abs(u));
    const float scale = largest > 0.f ? std::exp2(std::ceil(std::log2(largest))) : 1.f;

    std::vector<unsigned char> octets(head_size);
    const auto put = [&octets](const std::size_t place, const auto value) {
      std::memcpy(&octets[place], &value, sizeof(value));
    };
    put(0, std::uint32_t(0x4c505553));
    put(4, std::uint32_t(frame.displacements.size() / 3));
    put(8, frame.time);
    put(16, std::uint32_t(frame.step));
    put(20, std::uint32_t(frame.last_request));
    put(24, scale);
    put(28, float(frame.factor));
    put(32, std::uint32_t((frame.running ? 1 : 0) | (frame.late ? 2 : 0)));
    put(36, std::uint32_t(frame.tools.size()));
    put(40, float(frame.steps_per_second));
    put(44, float(1e3 * frame.seconds_per_step));
    put(48, std::uint32_t(frame.session));
    for (const Pose &pose : frame.tools)
      for (const Arrow &vector : {pose.place, pose.turn})
        for (unsigned int i = 0; i < 3; ++i)
          {
            const float number = vector[i];
            append(octets, &number, 1);
          }
    std::vector<std::int16_t> numbers;
    numbers.reserve(frame.displacements.size());
    for (const float u : frame.displacements)
      numbers.push_back(std::lround(u / scale * most));
    append(octets, numbers.data(), numbers.size());
    return octets;
  }


  std::string
  repeating_scene(const Parameters &first, const Session::Scene &scene, const std::string &folder)
  {
    const std::string base              = first.file.folder();
    const std::vector<Override> changes = {{"Live/Motion=" + motion_file_name},
                                           {"Output/Folder="},
                                           {"Time/Estimate error=false"},
                                           {"Space/Second mesh=none"}};
    std::istringstream lines(scene(changes).as_used);
    std::ostringstream text;
    text << "# What was done in a live session, once more: supple " << repeated_scene_name << "\n";
    std::string section, line;
    while (std::getline(lines, line))
      {
        const std::string plain = dealii::Utilities::trim(line);
        const auto equal        = line.find('=');
        if (plain.rfind("subsection ", 0) == 0)
          section = plain.substr(11);
        const bool names_file = plain.rfind("set File ", 0) == 0 && equal != std::string::npos &&
                                (section == "Mesh" || section.rfind("Tool ", 0) == 0);
        const std::string value = names_file ? dealii::Utilities::trim(line.substr(equal + 1)) : "";
        if (!value.empty())
          line = line.substr(0, equal + 1) + " " + from_folder(value, base, folder);
        text << line << '\n';
      }
    return text.str();
  }
} // namespace Supple
