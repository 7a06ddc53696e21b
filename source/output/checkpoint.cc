#include <supple/output/checkpoint.h>

#include <supple/base/error.h>
#include <supple/base/files.h>
#include <supple/base/first_process.h>
#include <supple/mechanics/vertex_values.h>

#include <deal.II/base/mpi.h>

#include <boost/crc.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace Supple
{
  using namespace dealii;
  using Json = nlohmann::json;

  namespace
  {
    const std::string any_head = "supple checkpoint ", head = any_head + "4\n";

    std::string
    checksum(const std::string &content)
    {
      boost::crc_32_type sum;
      sum.process_bytes(content.data(), content.size());
      std::ostringstream text;
      text << sum.checksum() << '\n';
      return text.str();
    }


    /** The content of a file; nothing if it is damaged or not there.
     * @throws InputError if another version of the program has written it */
    std::optional<std::string>
    whole_content(const std::string &file)
    {
      const std::string all = content_of(file);
      if (all.rfind(any_head, 0) == 0 && all.rfind(head, 0) != 0 && all.find('\n') < all.size() - 1)
        throw InputError(file +
                         " is of another version of this program. Name another folder with "
                         "--output, or set Checkpoint/Resume = never, to begin anew.");
      const auto end = all.find('\n', std::min(head.size(), all.size()));
      if (all.rfind(head, 0) != 0 || end == std::string::npos)
        return {};
      const std::string content = all.substr(end + 1);
      if (all.substr(head.size(), end + 1 - head.size()) != checksum(content))
        return {};
      return content;
    }


    /** The first line of the one that is not in the other. */
    std::string
    first_difference(const std::string &one, const std::string &other)
    {
      std::istringstream lines(one), other_lines(other);
      std::string line, other_line;
      while (std::getline(lines, line))
        if (!std::getline(other_lines, other_line) || line != other_line)
          return line;
      return "";
    }
  } // namespace


  Checkpoint::Checkpoint(const Body &body,
                         const CheckpointParameters &wanted,
                         const std::string &scene,
                         const bool dynamic,
                         const std::string &folder)
    : body(body)
    , wanted(wanted)
    , scene(scene)
    , dynamic(dynamic)
    , file(folder + "/" + files()[0])
    , previous_file(folder + "/" + files()[1])
    , last_time(std::chrono::steady_clock::now())
  {
  }


  std::optional<unsigned int>
  Checkpoint::step_in(const std::string &folder, const MPI_Comm communicator)
  {
    long step = -1;
    on_first_process(communicator, [&] {
      for (const std::string &name : files())
        if (const auto content = whole_content(folder + "/" + name); content && step < 0)
          step = Json::from_cbor(*content).value("step", -1l);
    });
    step = Utilities::MPI::broadcast(communicator, step);
    if (step < 0)
      return {};
    return static_cast<unsigned int>(step);
  }


  std::vector<std::string>
  Checkpoint::files()
  {
    return {"checkpoint.cbor", "checkpoint.previous.cbor"};
  }


  bool
  Checkpoint::due(const unsigned int step) const
  {
    if (wanted.every > 0 && step - last_step >= wanted.every)
      return true;
    if (wanted.minutes == 0.)
      return false;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - last_time;
    return Utilities::MPI::max(passed.count() >= 60. * wanted.minutes ? 1 : 0,
                               body.mesh.communicator) > 0;
  }


  std::string
  Checkpoint::identity() const
  {
    std::ostringstream kept;
    std::istringstream lines(scene);
    std::string line, section;
    while (std::getline(lines, line))
      {
        if (line.rfind("subsection ", 0) == 0)
          section = line.substr(11);
        const auto first  = line.find_first_not_of(' ');
        const bool is_end = section == "Time" && line.find("set Steps ") != std::string::npos;
        const bool is_threads =
          section == "Solver" && line.find("set Threads ") != std::string::npos;
        if (section != "Output" && section != "Checkpoint" && !(is_end && dynamic) && !is_threads &&
            first != std::string::npos && line[first] != '#')
          kept << line << '\n';
      }
    kept << body.mesh.n_cells << " cells, " << body.mesh.n_vertices << " vertices in "
         << body.mesh.extent() << " m\n"
         << "vertices, cells and ids of the mesh have the checksum " << body.mesh.checksum << "\n";
    return kept.str();
  }


  void
  Checkpoint::write(const unsigned int step,
                    const std::vector<const Vector *> &vectors,
                    const Json &rest,
                    const bool in_haste)
  {
    Json all;
    for (const Vector *vector : vectors)
      all["vectors"].push_back(gathered_by_vertex(body, vector->begin()));
    all["identity"] = identity();
    all["step"]     = step;
    all["rest"]     = rest;
    if (Utilities::MPI::this_mpi_process(body.mesh.communicator) == 0)
      {
        std::string content;
        Json::to_cbor(all, content);
        std::error_code problem; // write_whole_file() speaks of a folder that is gone
        if (whole_content(file)) // a damaged one must not take the place of a whole one
          std::filesystem::rename(file, previous_file, problem);
        if (!in_haste)
          sync_results();
        write_durable_file(file, head + checksum(content) + content);
        if (in_haste)
          sync_results();
      }
    last_step = step;
    last_time = std::chrono::steady_clock::now();
  }


  void
  Checkpoint::sync_results()
  {
    // Clocks of file systems tick seldom.
    const auto now = std::filesystem::file_time_type::clock::now() - std::chrono::seconds(5);
    sync_folder(std::filesystem::path(file).parent_path(), "solution", synced);
    synced = now;
  }


  std::string
  Checkpoint::read_content()
  {
    bool any = false;
    for (const std::string &name : {file, previous_file})
      if (std::filesystem::exists(name))
        {
          if (const auto content = whole_content(name))
            {
              damaged = any;
              return *content;
            }
          any = true;
        }
    if (any)
      throw InputError(file +
                       " is damaged, and there is no whole one before it. Delete it, or set "
                       "Checkpoint/Resume = never, to begin anew.");
    return "";
  }


  void
  Checkpoint::refuse_content() const
  {
    throw InputError((damaged ? previous_file : file) +
                     " is foreign: it is whole, but has not what this program keeps in a "
                     "checkpoint. Name another folder with --output, or set Checkpoint/Resume = "
                     "never, to begin anew.");
  }


  std::optional<Json>
  Checkpoint::read(const std::vector<Vector *> &vectors, const unsigned int n_needed)
  {
    // The first process reads; all say the same if it is wrong.
    const MPI_Comm communicator = body.mesh.communicator;
    std::string content, problem;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      try
        {
          content = read_content();
        }
      catch (const InputError &error)
        {
          problem = error.what();
        }
    problem = Utilities::MPI::broadcast(communicator, problem);
    if (!problem.empty())
      throw InputError(problem);
    content = Utilities::MPI::broadcast(communicator, content);
    damaged = Utilities::MPI::broadcast(communicator, damaged ? 1 : 0) == 1;
    if (content.empty())
      return {};
    try
      {
        return unpack(Json::from_cbor(content), vectors, n_needed);
      }
    catch (const Json::exception &)
      {
        refuse_content();
      }
    catch (const std::out_of_range &)
      {
        refuse_content();
      }
  }


  Json
  Checkpoint::unpack(const Json &all,
                     const std::vector<Vector *> &vectors,
                     const unsigned int n_needed)
  {
    const std::string &name = damaged ? previous_file : file;
    const std::string found = all.at("identity"), mine = identity();
    if (found != mine)
      throw InputError(name + " is of another scene: there '" + first_difference(found, mine) +
                       "', here '" + first_difference(mine, found) +
                       "'. Name another folder with --output, or set Checkpoint/Resume = never.");
    const auto saved = all.at("vectors").get<std::vector<std::vector<double>>>();
    if (saved.size() < n_needed)
      refuse_content();
    for (unsigned int k = 0; k < std::min(saved.size(), vectors.size()); ++k)
      scatter_by_vertex(body, saved[k], vectors[k]->begin());
    last_step     = all.at("step");
    read_in_words = "step " + std::to_string(last_step) + " of " +
                    std::filesystem::path(name).filename().string();
    return all.at("rest");
  }
} // namespace Supple
