#include <supple/base/lone_process.h>

#include <cstdlib>
#include <filesystem>

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
    set("OMPI_MCA_pml", "ob1");
    set("OMPI_MCA_btl", "self");

    if (std::getenv("OMPI_MCA_orte_tmpdir_base"))
      return;
    // Isolated processes would all share one folder, and MPI_Init fails where two of them make it
    // at once.
    std::error_code problem;
    for (const auto &base : {std::filesystem::temp_directory_path(problem),
                             std::filesystem::path("/tmp"),
                             std::filesystem::path("/dev/shm")})
      {
        folder = (base / "supple-mpi-XXXXXX").string();
        if (mkdtemp(&folder[0]))
          {
            set("OMPI_MCA_orte_tmpdir_base", folder);
            set("OMPI_MCA_ess_singleton_isolated", "1");
            return;
          }
      }
    folder.clear();
  }


  void
  LoneProcess::set(const char *const name, const std::string &value)
  {
    if (!std::getenv(name) && setenv(name, value.c_str(), 0) == 0)
      names.push_back(name);
  }


  LoneProcess::~LoneProcess()
  {
    for (const std::string &name : names)
      unsetenv(name.c_str());
    std::error_code nothing_there;
    if (!folder.empty())
      std::filesystem::remove_all(folder, nothing_there);
  }
} // namespace Supple
