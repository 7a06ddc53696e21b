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
    if (descriptor < 0 || lock())
      return;
    if (errno != EWOULDBLOCK) // such as NFS, which locks what is open for writing alone
      {
        close(descriptor);
        descriptor = open((folder + "/.lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0 || lock() || errno != EWOULDBLOCK)
          return;
      }
    close(descriptor);
    throw InputError("Another run writes into the output folder " + folder +
                     " right now. Wait for its end, or name another folder with --output.");
  }


  bool
  FolderLock::lock() const
  {
    return flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  }


  FolderLock::~FolderLock()
  {
    if (descriptor >= 0)
      close(descriptor);
  }
} // namespace Supple
