#include <supple/base/files.h>

#include <supple/base/error.h>
#include <supple/base/first_process.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace Supple
{
  void
  prepare_output_folder(const std::string &folder,
                        const MPI_Comm communicator,
                        const std::function<void()> &make)
  {
    on_first_process(communicator, [&] {
      try
        {
          make();
        }
      catch (const InputError &)
        {
          throw;
        }
      catch (const std::exception &exception)
        {
          throw InputError("The output folder " + folder + " can't be written (" +
                           exception.what() + "). Name another one with --output.");
        }
    });
  }


  void
  write_whole_file(const std::string &file, const std::string &content)
  {
    const std::string aside = file + ".partial";
    {
      std::ofstream stream(aside);
      stream << content << std::flush;
      if (!stream)
        {
          stream.close();
          std::remove(aside.c_str());
          throw WriteError(file + " can't be written; is the disk full?");
        }
    }
    std::error_code problem;
    std::filesystem::rename(aside, file, problem);
    if (problem)
      throw WriteError(file + " can't be written (" + problem.message() + ").");
  }
} // namespace Supple
