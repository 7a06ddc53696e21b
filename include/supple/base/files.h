#ifndef supple_files_h
#define supple_files_h

#include <functional>
#include <mpi.h>
#include <string>

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


  /** Writes a text file aside and renames it, so that it is there as a whole or not at all. @throws
   * WriteError */
  void
  write_whole_file(const std::string &file, const std::string &content);
} // namespace Supple

#endif
