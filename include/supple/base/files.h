#ifndef supple_files_h
#define supple_files_h

#include <filesystem>
#include <functional>
#include <mpi.h>
#include <string>
#include <vector>

namespace Supple
{
  /**
   * Has the first process make an output folder ready by @p make; collective.
   * @throws InputError on all processes if that can't be done. What @p make itself says of the
   * input goes through.
   */
  void
  prepare_output_folder(const std::string &folder,
                        MPI_Comm communicator,
                        const std::function<void()> &make);


  /** All bytes of a file; none if it can't be read. */
  std::string
  content_of(const std::string &file);


  /** Writes a text file aside and renames it, so that it is there as a whole or not at all. @throws
   * WriteError */
  void
  write_whole_file(const std::string &file, const std::string &content);


  /** As write_whole_file(); and the file is on the disk before it is renamed, so that a loss of
   * power leaves the old one or the new one. Takes some milliseconds. @throws WriteError */
  void
  write_durable_file(const std::string &file, const std::string &content);


  /** Has the system write to the disk what it still keeps of the files in a folder and in its
   * subfolder of this name, but for those that have not been written since an instant. */
  void
  sync_folder(const std::string &folder,
              const std::string &subfolder,
              std::filesystem::file_time_type since = std::filesystem::file_time_type::min());


  /**
   * Removes the files of these names that are there.
   * @param names relative to the folder; the last part of a path may have one *, which stands for
   * any text, as in "solution/frame_*"
   * @throws std::filesystem::filesystem_error
   */
  void
  remove_files(const std::string &folder, const std::vector<std::string> &names);
} // namespace Supple

#endif
