#ifndef supple_task_output_h
#define supple_task_output_h

#include <supple/base/folder_lock.h>

#include <mpi.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Supple
{
  /** What a task of many runs has for its results: a folder for itself, and the screen. */
  class TaskOutput
  {
  public:
    /** @param quiet no words on the screen */
    TaskOutput(const std::string &folder, bool quiet, MPI_Comm communicator);

    /**
     * Makes the folder, takes it for this process, and removes what an earlier task has left there;
     * collective.
     * @param earlier names of files as for remove_files()
     * @param begin   writes the first file, on the first process
     * @throws InputError on all processes if that can't be done
     */
    void
    open(const std::vector<std::string> &earlier, const std::function<void()> &begin);

    /** A line on the screen; nothing if there is nothing to say. */
    void
    say(const std::string &text) const;

    const std::string folder;
    const MPI_Comm communicator;
    const bool root; ///< this process writes

  private:
    const bool talks;
    std::unique_ptr<const FolderLock> lock; ///< of the folder, on the first process
  };
} // namespace Supple

#endif
