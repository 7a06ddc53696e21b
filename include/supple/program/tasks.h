#ifndef supple_tasks_h
#define supple_tasks_h

#include <supple/input/command_line.h>

#include <mpi.h>

namespace Supple
{
  /**
   * Does what the command line asks for: runs or checks a scene, a study or an identification, or
   * prints help, version or parameters.
   * @throws InputError, ComputationError
   */
  void
  execute(const CommandLine &line, MPI_Comm communicator);
} // namespace Supple

#endif
