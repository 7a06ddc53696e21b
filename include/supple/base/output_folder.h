#ifndef supple_output_folder_h
#define supple_output_folder_h

#include <mpi.h>

#include <functional>
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
} // namespace Supple

#endif
