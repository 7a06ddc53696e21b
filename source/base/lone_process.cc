#include <supple/base/lone_process.h>

#include <array>
#include <cstdlib>
#include <utility>

namespace Supple
{
  namespace
  {
    /** By what Open MPI, PMIx and PMI tell the processes that they start. */
    bool
    was_launched()
    {
      for (const char *const name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
        if (std::getenv(name))
          return true;
      return false;
    }
  } // namespace


  LoneProcess::LoneProcess()
  {
    if (was_launched())
      return;
    // Not ess_singleton_isolated, which is quicker still: all processes with it share one folder of
    // temporary files, and MPI_Init fails where two of them make it at once.
    const std::array<std::pair<const char *, const char *>, 2> settings = {
      {{"OMPI_MCA_pml", "ob1"}, {"OMPI_MCA_btl", "self"}}};
    for (const auto &[name, value] : settings)
      if (!std::getenv(name) && setenv(name, value, 0) == 0)
        set.push_back(name);
  }


  LoneProcess::~LoneProcess()
  {
    for (const std::string &name : set)
      unsetenv(name.c_str());
  }
} // namespace Supple
