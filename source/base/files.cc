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


  void
  remove_files(const std::string &folder, const std::vector<std::string> &names)
  {
    namespace fs = std::filesystem;
    for (const std::string &name : names)
      {
        const fs::path path        = fs::path(folder) / name;
        const std::string pattern  = path.filename().string();
        const std::size_t wildcard = pattern.find('*');
        if (wildcard == std::string::npos)
          {
            fs::remove(path);
            continue;
          }
        const std::string begin = pattern.substr(0, wildcard), end = pattern.substr(wildcard + 1);
        if (fs::is_directory(path.parent_path()))
          for (const auto &entry : fs::directory_iterator(path.parent_path()))
            {
              const std::string found = entry.path().filename().string();
              if (found.size() >= begin.size() + end.size() && found.rfind(begin, 0) == 0 &&
                  found.compare(found.size() - end.size(), end.size(), end) == 0)
                fs::remove(entry.path());
            }
      }
  }
} // namespace Supple
