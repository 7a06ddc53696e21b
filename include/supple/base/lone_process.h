#ifndef supple_lone_process_h
#define supple_lone_process_h

#include <string>
#include <vector>

namespace Supple
{
  /**
   * Spares a process that was not started by an MPI launcher what MPI prepares to speak with
   * others: Open MPI 4 looks for networks and starts a daemon, which takes 0.3 s. To be made before
   * MPI_Init, and gone after it: programs that this one starts do not inherit it.
   *
   * It sets variables of the environment, but none that is there, and does nothing under a
   * launcher. Other kinds of MPI take no notice of them.
   */
  class LoneProcess
  {
  public:
    LoneProcess();

    /** Takes away what was set, and the folder of MPI's temporary files. */
    ~LoneProcess();

    LoneProcess(const LoneProcess &) = delete;
    LoneProcess &
    operator=(const LoneProcess &) = delete;

  private:
    void
    set(const char *name, const std::string &value);

    std::vector<std::string> names; ///< of variables that were set
    std::string folder;             ///< of temporary files of MPI
  };
} // namespace Supple

#endif
