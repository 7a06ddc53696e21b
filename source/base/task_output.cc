#include <supple/base/files.h>
#include <supple/base/task_output.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>

namespace Supple
{
  TaskOutput::TaskOutput(const std::string &folder, const bool quiet, const MPI_Comm communicator)
    : folder(folder)
    , communicator(communicator)
    , root(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    , talks(!quiet && root)
  {
  }


  void
  TaskOutput::open(const std::vector<std::string> &earlier, const std::function<void()> &begin)
  {
    prepare_output_folder(folder, communicator, [&] {
      std::filesystem::create_directories(folder);
      lock = std::make_unique<const FolderLock>(folder);
      remove_files(folder, earlier);
      begin();
    });
  }


  void
  TaskOutput::say(const std::string &text) const
  {
    if (talks && !text.empty())
      std::cout << text << std::endl;
  }
} // namespace Supple
