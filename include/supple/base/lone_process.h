#ifndef supple_lone_process_h
#define supple_lone_process_h

#include <string>
#include <vector>

namespace Supple
{
  /**
   * Spares a process that was not started by an MPI launcher what MPI prepares to speak with
   * others: Open MPI 4 looks for networks, for 0.2 s. To be made before MPI_Init, and gone after
   * it: programs that this one starts do not inherit it.
   *
   * It sets variables of the environment, but none that is there, and does nothing under a
   * launcher. Other kinds of MPI take no notice of them.
   */
  class LoneProcess
  {
  public:
    LoneProcess();

    /** Takes away what was set. */
    ~LoneProcess();

    LoneProcess(const LoneProcess &) = delete;
    LoneProcess &
    operator=(const LoneProcess &) = delete;

  private:
    std::vector<std::string> set; ///< names of variables
  };
} // namespace Supple

#endif
