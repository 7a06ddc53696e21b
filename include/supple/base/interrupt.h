#ifndef supple_interrupt_h
#define supple_interrupt_h

#include <mpi.h>

#include <array>

namespace Supple
{
  /**
   * While it lives, Ctrl-C (SIGINT), SIGTERM, the end of the terminal (SIGHUP) and that of the time
   * that the system allows (SIGXCPU) are noted and do not end the program. SIGHUP stays ignored
   * where it was, as under nohup. One may live within another.
   */
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

    std::array<Handler, 4> outer; ///< what was done before with each signal
  };
} // namespace Supple

#endif
