// supple for many command lines in one process, which saves the start of all its libraries.
//
// Reads lines from standard input, whose fields are set apart by the character 0x1f: a folder, a
// file for standard output, one for standard error, and the arguments of the program. Each line is
// done in the folder by a copy of this process, which leads a process group of its own; prints the
// copy's process id and its status as waitpid gives it. Each copy may compute for as many seconds
// as the first argument says, then it gets SIGXCPU; as many later as the second one says it is
// killed.

#include <supple/base/error.h>
#include <supple/base/lone_process.h>
#include <supple/input/command_line.h>
#include <supple/program/tasks.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

using namespace Supple;

namespace
{
  /** The exit status that main.cc gives. */
  int
  status_of(std::vector<std::string> &words)
  {
    std::vector<char *> argv;
    for (std::string &word : words)
      argv.push_back(word.data());
    try
      {
        execute(CommandLine::parse(argv.size(), argv.data()), MPI_COMM_WORLD);
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
  write_to(const std::string &file, const int descriptor)
  {
    dup2(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), descriptor);
  }


  void
  set_up(const std::vector<std::string> &fields, const rlim_t seconds, const rlim_t more)
  {
    const rlimit limit{seconds, seconds + more}, none{0, 0};
    setrlimit(RLIMIT_CPU, &limit);
    setrlimit(RLIMIT_CORE, &none);
    setpgid(0, 0);
    dup2(open("/dev/null", O_RDWR), STDIN_FILENO);
    write_to(fields[1], STDOUT_FILENO);
    write_to(fields[2], STDERR_FILENO);
    if (chdir(fields[0].c_str()) != 0)
      _exit(3);
  }


  std::vector<std::string>
  fields_of(const std::string &line)
  {
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, '\x1f');)
      fields.push_back(field);
    return fields;
  }
} // namespace


int
main(int argc, char **argv)
{
  int n_names = 1;
  std::optional<LoneProcess> lone_process(std::in_place);
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_names, argv, 1);
  lone_process.reset();
  std::signal(SIGPIPE, SIG_IGN);
  dealii::deal_II_exceptions::disable_abort_on_exception();
  const rlim_t seconds = argc > 1 ? std::atoi(argv[1]) : 30,
               more    = argc > 2 ? std::atoi(argv[2]) : 0;

  std::string line;
  while (std::getline(std::cin, line))
    {
      std::vector<std::string> fields = fields_of(line);
      const pid_t child               = fork();
      if (child == 0)
        {
          set_up(fields, seconds, more);
          std::vector<std::string> words(fields.begin() + 2, fields.end());
          words.front()    = "supple";
          const int status = status_of(words);
          std::cout << std::flush;
          _exit(status);
        }
      int status = 0;
      waitpid(child, &status, 0);
      std::cout << child << ' ' << status << std::endl;
    }
}
