#include <supple/base/interrupt.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
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


    /** As under nohup. To be asked before libraries put handlers of their own in its place. */
    bool
    hangup_is_ignored()
    {
      const auto handler = std::signal(SIGHUP, SIG_IGN);
      std::signal(SIGHUP, handler);
      return handler == SIG_IGN;
    }


    const bool hangup_was_ignored = hangup_is_ignored();

    constexpr std::array<int, 4> signals = {{SIGINT, SIGTERM, SIGHUP, SIGXCPU}};
  } // namespace


  InterruptGuard::InterruptGuard()
  {
    std::transform(signals.begin(), signals.end(), outer.begin(), [](const int signal) {
      return std::signal(signal, note_signal);
    });
    if (outer[0] != note_signal)
      signal_received = 0;
    if (hangup_was_ignored)
      std::signal(SIGHUP, SIG_IGN);
  }


  InterruptGuard::~InterruptGuard()
  {
    for (unsigned int i = 0; i < signals.size(); ++i)
      std::signal(signals[i], outer[i]);
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
