// What is set for a process without a launcher, and that nothing stays.

#include <supple/base/lone_process.h>

#include <cstdio>
#include <cstdlib>

using namespace Supple;

namespace
{
  void
  print(const char *const when)
  {
    std::printf("%s:", when);
    for (const char *const name :
         {"OMPI_MCA_pml", "OMPI_MCA_btl", "OMPI_MCA_ess_singleton_isolated"})
      {
        const char *const value = std::getenv(name);
        std::printf(" %s", value ? value : "-");
      }
    std::printf("\n");
  }


  void
  print_all(const char *const what)
  {
    std::printf("%s\n", what);
    print("  before");
    {
      const LoneProcess alone;
      print("  during");
    }
    print("  after");
  }
} // namespace


int
main()
{
  for (const char *const name : {"OMPI_COMM_WORLD_SIZE",
                                 "PMIX_RANK",
                                 "PMI_RANK",
                                 "OMPI_MCA_pml",
                                 "OMPI_MCA_btl",
                                 "OMPI_MCA_orte_tmpdir_base",
                                 "OMPI_MCA_ess_singleton_isolated"})
    unsetenv(name);
  print_all("alone");
  for (const char *const launcher : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"})
    {
      setenv(launcher, "0", 1);
      print_all(launcher);
      unsetenv(launcher);
    }
  setenv("OMPI_MCA_pml", "cm", 1);
  setenv("OMPI_MCA_btl", "^tcp", 1);
  print_all("with settings of one's own");
}
