#ifndef supple_adaptation_h
#define supple_adaptation_h

#include <supple/scene/parameters.h>

#include <mpi.h>

namespace Supple
{
  /** Whether a scene's mesh is to be refined by pilot runs. */
  bool
  asks_for_pilots(const Parameters &scene);


  /**
   * A scene with its mesh refined by pilot runs, as Mesh/Refine and Space/Aim ask for: each runs
   * the scene on the mesh so far, without results, and the cells with most of the error are cut.
   * The scene itself if it asks for none. Collective.
   * @param talks a line on the screen for each pilot run
   * @throws InputError, ComputationError
   */
  Parameters
  adapted(const Parameters &scene, bool talks, MPI_Comm communicator);


  /** Checks what adapted() needs without a run. @throws InputError */
  void
  check_adaptation(const Parameters &scene, MPI_Comm communicator);
} // namespace Supple

#endif
