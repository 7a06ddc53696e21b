#include <supple/base/folder_lock.h>

#include <supple/base/error.h>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

namespace Supple
{
  FolderLock::FolderLock(const std::string &folder)
    : descriptor(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
  {
    if (descriptor < 0 || flock(descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK)
      return;
    close(descriptor);
    throw InputError("Another run writes into the output folder " + folder +
                     " right now. Wait for its end, or name another folder with --output.");
  }


  FolderLock::~FolderLock()
  {
    if (descriptor >= 0)
      close(descriptor);
  }
} // namespace Supple
