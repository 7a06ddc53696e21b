#include <supple/base/output_folder.h>

#include <supple/base/error.h>
#include <supple/base/first_process.h>

namespace Supple
{
  void
  prepare_output_folder(const std::string &folder,
                        const MPI_Comm communicator,
                        const std::function<void()> &make)
  {
    on_first_process(communicator, [&] {
      try
        {
          make();
        }
      catch (const InputError &)
        {
          throw;
        }
      catch (const std::exception &exception)
        {
          throw InputError("The output folder " + folder + " can't be written (" +
                           exception.what() + "). Name another one with --output.");
        }
    });
  }
} // namespace Supple
