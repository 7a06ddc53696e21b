#ifndef supple_first_process_h
#define supple_first_process_h

#include <mpi.h>

#include <functional>

namespace Supple
{
  /**
   * Has the first process alone do something; collective.
   * @throws InputError on all processes if it throws one there. Whatever else it throws, it throws
   * there alone.
   */
  void
  on_first_process(MPI_Comm communicator, const std::function<void()> &action);
} // namespace Supple

#endif
