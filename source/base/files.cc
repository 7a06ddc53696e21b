#include <supple/base/files.h>

#include <supple/base/error.h>
#include <supple/base/first_process.h>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

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


  namespace
  {
    void
    write_aside(const std::string &file, const std::string &aside, const std::string &content)
    {
      std::ofstream stream(aside);
      stream << content << std::flush;
      if (stream)
        return;
      stream.close();
      std::remove(aside.c_str());
      const auto folder = std::filesystem::path(file).parent_path();
      std::error_code problem;
      const bool gone = !folder.empty() && !std::filesystem::exists(folder, problem);
      throw WriteError(file + " can't be written; " +
                       (gone ? "its folder is gone." : "is the disk full?"));
    }


    void
    rename_whole(const std::string &aside, const std::string &file)
    {
      std::error_code problem;
      std::filesystem::rename(aside, file, problem);
      if (problem)
        throw WriteError(file + " can't be written (" + problem.message() + ").");
    }


    /** A file or a folder. @return 0, or the errno of what was written and can't be kept: a full
     * disk may show only now. What can't be opened, or is on no disk, is left alone. */
    int
    sync(const std::filesystem::path &path)
    {
      const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC);
      if (descriptor < 0)
        return 0;
      const int problem = fsync(descriptor) == 0 || errno == EINVAL ? 0 : errno;
      close(descriptor);
      return problem;
    }


    void
    sync_files_of(const std::filesystem::path &folder, const std::filesystem::file_time_type since)
    {
      std::error_code problem;
      for (std::filesystem::directory_iterator entry(folder, problem), end;
           !problem && entry != end;
           entry.increment(problem))
        if (entry->is_regular_file(problem) && entry->last_write_time(problem) >= since)
          sync(entry->path());
      sync(folder);
    }
  } // namespace


  std::string
  content_of(const std::string &file)
  {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    return content.str();
  }


  void
  write_whole_file(const std::string &file, const std::string &content)
  {
    const std::string aside = file + ".partial";
    write_aside(file, aside, content);
    rename_whole(aside, file);
  }


  void
  write_durable_file(const std::string &file, const std::string &content)
  {
    const std::string aside = file + ".partial";
    write_aside(file, aside, content);
    if (const int problem = sync(aside))
      throw WriteError(file + " can't be written (" + std::strerror(problem) + ").");
    rename_whole(aside, file);
    const auto folder = std::filesystem::path(file).parent_path();
    sync(folder.empty() ? "." : folder);
  }


  void
  sync_folder(const std::string &folder,
              const std::string &subfolder,
              const std::filesystem::file_time_type since)
  {
    sync_files_of(std::filesystem::path(folder) / subfolder, since);
    sync_files_of(folder, since);
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
