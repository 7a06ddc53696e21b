// supple --check for many scenes in one process, which saves the start of all its libraries.
//
// Reads lines "folder<tab>scene<tab>file" from standard input. Each scene is checked in the folder
// by a copy of this process, whose standard error goes to the file; prints the copy's status as
// waitpid gives it. Each copy may compute for as many seconds as the first argument says.

#include <supple/base/error.h>
#include <supple/identification/identification.h>
#include <supple/input/command_line.h>
#include <supple/run/simulation.h>
#include <supple/scene/read_scene.h>
#include <supple/study/study.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <cstdlib>
#include <fcntl.h>
#include <iostream>
#include <sstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace Supple;

namespace
{
  template <typename Task, typename TaskParameters>
  void
  check_task(const TaskParameters &parameters)
  {
    Task(parameters, "output", false, MPI_COMM_WORLD).check();
  }


  void
  check_scene(const std::string &scene)
  {
    if (StudyParameters::is_study(scene))
      check_task<Study>(StudyParameters::read(scene, {}));
    else if (IdentificationParameters::is_identification(scene))
      check_task<Identification>(IdentificationParameters::read(scene, {}));
    else
      check_task<Simulation>(read_scene(scene));
  }


  /** The exit status that main.cc gives. */
  int
  status_of_check(const std::string &scene)
  {
    try
      {
        check_scene(scene);
        return 0;
      }
    catch (const InputError &error)
      {
        std::cerr << "supple: " << on_one_screen(error.what()) << std::endl;
        return 1;
      }
    catch (const std::exception &error)
      {
        std::cerr << "supple: " << on_one_screen(error.what()) << std::endl;
        return 2;
      }
  }


  void
  set_up(const std::string &folder, const std::string &error_file, const rlim_t seconds)
  {
    const rlimit limit{seconds, seconds}, none{0, 0};
    setrlimit(RLIMIT_CPU, &limit);
    setrlimit(RLIMIT_CORE, &none);
    dup2(open("/dev/null", O_RDWR), STDIN_FILENO);
    dup2(open("/dev/null", O_RDWR), STDOUT_FILENO);
    dup2(open(error_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    if (chdir(folder.c_str()) != 0)
      _exit(3);
  }
} // namespace


int
main(int argc, char **argv)
{
  int n_names = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_names, argv, 1);
  dealii::deal_II_exceptions::disable_abort_on_exception();
  const rlim_t seconds = argc > 1 ? std::atoi(argv[1]) : 30;

  std::string line;
  while (std::getline(std::cin, line))
    {
      std::istringstream fields(line);
      std::string folder, scene, error_file;
      std::getline(fields, folder, '\t');
      std::getline(fields, scene, '\t');
      std::getline(fields, error_file);
      const pid_t child = fork();
      if (child == 0)
        {
          set_up(folder, error_file, seconds);
          _exit(status_of_check(scene));
        }
      int status = 0;
      waitpid(child, &status, 0);
      std::cout << status << std::endl;
    }
}
