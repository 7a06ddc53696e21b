#include <supple/interrupt.h>

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
  {
    signal_received = 0;
    std::signal(SIGINT, note_signal);
    std::signal(SIGTERM, note_signal);
  }


  InterruptGuard::~InterruptGuard()
  {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
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
