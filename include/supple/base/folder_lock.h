#ifndef supple_folder_lock_h
#define supple_folder_lock_h

#include <string>

namespace Supple
{
  /**
   * While it lives, no other process gets one of the same folder. The system ends it with the
   * process, however that ends: what a dead run leaves behind locks nothing. Where a folder
   * can't be locked, a file .lock in it is; a file system that has no locks at all gives one to
   * everybody.
   */
  class FolderLock
  {
  public:
    /** @throws InputError if another process has one of this folder, which must exist */
    explicit FolderLock(const std::string &folder);
    ~FolderLock();

    FolderLock(const FolderLock &) = delete;
    FolderLock &
    operator=(const FolderLock &) = delete;

  private:
    /** @return whether there is one now; otherwise errno says why not */
    bool
    lock() const;

    int descriptor;
  };
} // namespace Supple

#endif
