#include <supple/base/interrupt.h>

#include <deal.II/base/mpi.h>

#include <csignal>

namespace Supple
{
  namespace
  {
    volatile std::sig_atomic_t signal_received = 0; // a signal handler can reach nothing else

    void
    note_signal(const int signal)
    {
      signal_received = signal;
    }
  } // namespace


  InterruptGuard::InterruptGuard()
    : outer_interrupt(std::signal(SIGINT, note_signal))
    , outer_termination(std::signal(SIGTERM, note_signal))
  {
    if (outer_interrupt != note_signal)
      signal_received = 0;
  }


  InterruptGuard::~InterruptGuard()
  {
    std::signal(SIGINT, outer_interrupt);
    std::signal(SIGTERM, outer_termination);
  }


  bool
  InterruptGuard::requested(const MPI_Comm communicator) const
  {
    const int here = signal_received;
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
      return here != 0;
    return dealii::Utilities::MPI::max(here, communicator) != 0;
  }
} // namespace Supple
