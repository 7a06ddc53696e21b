#ifndef supple_interrupt_h
#define supple_interrupt_h

#include <mpi.h>

namespace Supple
{
  /** While it lives, Ctrl-C (SIGINT) and SIGTERM are noted and do not end the program. One may live
   * within another. */
  class InterruptGuard
  {
  public:
    InterruptGuard();
    ~InterruptGuard();

    InterruptGuard(const InterruptGuard &) = delete;
    InterruptGuard &
    operator=(const InterruptGuard &) = delete;

    /** Whether any process has been asked to stop; the same answer on all. */
    bool
    requested(MPI_Comm communicator) const;

  private:
    using Handler = void (*)(int);

    const Handler outer_interrupt, outer_termination;
  };
} // namespace Supple

#endif
