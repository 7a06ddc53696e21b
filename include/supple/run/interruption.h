#ifndef supple_interruption_h
#define supple_interruption_h

#include <supple/base/interrupt.h>
#include <supple/run/listener.h>

#include <mpi.h>

#include <optional>

namespace Supple
{
  /** Interrupts a run at the step in which Ctrl-C, SIGTERM, the end of the terminal
   * (SIGHUP) or that of the time that the system allows (SIGXCPU) reach it. */
  class Interruption : public Listener
  {
  public:
    explicit Interruption(const MPI_Comm communicator)
      : communicator(communicator)
    {
    }

    void
    begin(const Observation & /* now */, const bool /* resumed */) override
    {
      guard.emplace();
    }

    bool
    after_step(const Observation & /* now */) override
    {
      return !guard->requested(communicator);
    }

    void
    end(const Observation & /* now */) override
    {
      guard.reset();
    }

  private:
    const MPI_Comm communicator;
    std::optional<InterruptGuard> guard; ///< from begin() on
  };
} // namespace Supple

#endif
