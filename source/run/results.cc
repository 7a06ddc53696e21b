#include <supple/run/results.h>

#include <supple/base/files.h>
#include <supple/base/first_process.h>
#include <supple/contact/tool_surface.h>
#include <supple/forces/contact.h>
#include <supple/mesh/msh_writer.h>
#include <supple/mesh/whole_mesh.h>
#include <supple/report/report.h>
#include <supple/report/report_page.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <filesystem>

namespace Supple
{
  namespace
  {
    const std::string summary_file = "summary.json";
    const std::string mesh_file    = "mesh.msh";
  } // namespace


  Results::Results(const std::string &folder,
                   const Parameters &parameters,
                   const MPI_Comm communicator)
    : folder(folder)
    , writes(!folder.empty())
    , writes_history(writes && parameters.output.history)
    , writes_frames(writes && parameters.output.frames != OutputParameters::Frames::none)
    , parameters(parameters)
    , communicator(communicator)
    , writes_report(parameters.output.report && (writes_history || writes_frames))
    , own_files({summary_file, mesh_file, page_file})
  {
  }


  void
  Results::lock_folder()
  {
    if (writes)
      on_first_process(communicator, [&] {
        std::error_code none; // what can't be opened is refused when it is to be made
        if (std::filesystem::is_directory(folder, none))
          lock = std::make_unique<const FolderLock>(folder);
      });
  }


  void
  Results::open(const bool resumed, const unsigned int step)
  {
    if (!writes)
      return;
    prepare_output_folder(folder, communicator, [&] {
      std::filesystem::create_directories(folder);
      if (!lock)
        lock = std::make_unique<const FolderLock>(folder);
      if (!resumed)
        remove_files(folder, own_files);
      write_whole_file(folder + "/parameters.prm", parameters.as_used);
      if (parameters.output.mesh)
        write_whole_file(folder + "/" + mesh_file,
                         msh_text(
                           whole_mesh(parameters.mesh, parameters.plane, parameters.file).mesh));
      for (const auto &writer : writers)
        writer->open(resumed, step);
    });
  }


  void
  Results::write_end(const Summary &summary, const Film *const film, const Problem &problem) const
  {
    if (!writes || dealii::Utilities::MPI::this_mpi_process(communicator) != 0)
      return;
    const Json json = summary.to_json();
    sync_folder(folder, "solution"); // the summary tells of files that are there
    if (writes_report)
      {
        const Contact *const contact = problem.forces.contact();
        const std::vector<Tool> none;
        write_report(folder,
                     parameters,
                     json,
                     film,
                     contact ? contact->all_tools() : none,
                     extent_of_planes(problem.body));
      }
    write_durable_file(folder + "/" + summary_file, json.dump(2) + "\n");
    if (writes_report && film && !parameters.checkpoint.wanted())
      film->remove(); // no run will go on from here
  }


  std::string
  Results::report_file() const
  {
    return writes_report ? folder + "/" + page_file : "";
  }


  std::string
  Results::whereabouts(const std::string &which) const
  {
    return writes ? " The results " + which + " are in " + folder + "." : "";
  }
} // namespace Supple
