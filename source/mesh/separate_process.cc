#include <supple/mesh/separate_process.h>

#include <supple/base/error.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <new>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace Supple
{
  namespace
  {
    // The first byte of an answer says what follows; one without the last byte is not whole.
    constexpr char result = 'r', input_error = 'i', other_error = 'o', end_of_answer = '.';


    void
    write_all(const int pipe, const std::string &text)
    {
      for (std::size_t done = 0; done < text.size();)
        {
          const ssize_t n = write(pipe, text.data() + done, text.size() - done);
          if (n < 0 && errno != EINTR)
            return;
          if (n > 0)
            done += n;
        }
    }


    std::string
    read_all(const int pipe)
    {
      std::string text;
      std::string part(1 << 16, '\0');
      while (true)
        {
          const ssize_t n = read(pipe, &part[0], part.size());
          if (n > 0)
            text.append(part, 0, n);
          else if (n == 0 || errno != EINTR)
            return text;
        }
    }


    /** A crash is told by the parent alone: no handlers of MPI, no core file, no last words of the
     * C library. */
    void
    be_silent()
    {
      for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM, SIGTERM})
        std::signal(signal, SIG_DFL);
      std::signal(SIGINT, SIG_IGN); // goes to the parent too, which decides
      const rlimit none{0, 0};
      setrlimit(RLIMIT_CORE, &none);
      const int nowhere = open("/dev/null", O_RDWR);
      for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        dup2(nowhere, stream);
    }


    void
    set_limits(const ProcessLimits &limits)
    {
      prctl(PR_SET_PDEATHSIG, SIGKILL); // no orphans
      alarm(limits.seconds);

      // The limit counts data that is there already: the sixth number, in pages.
      std::ifstream statm("/proc/self/statm");
      rlim_t pages = 0;
      for (unsigned int i = 0; i < 6; ++i)
        statm >> pages;
      if (!statm)
        return;
      const rlim_t bytes = pages * sysconf(_SC_PAGESIZE) + limits.memory;
      const rlimit data{bytes, bytes};
      setrlimit(RLIMIT_DATA, &data);
    }


    [[noreturn]] void
    answer(const int pipe,
           const std::function<std::string()> &function,
           const ProcessLimits &limits)
    {
      be_silent();
      set_limits(limits);
      std::string text;
      try
        {
          text = result + function();
        }
      catch (const std::bad_alloc &)
        {
          text = other_error + std::string("it needs too much memory");
        }
      catch (const InputError &error)
        {
          text = input_error + std::string(error.what());
        }
      catch (const std::exception &error)
        {
          text = other_error + std::string(error.what());
        }
      write_all(pipe, text + end_of_answer);
      _exit(0); // MPI and all that is to be tidied up at the end belong to the parent
    }


    std::string
    why_it_ended(const int status, const ProcessLimits &limits)
    {
      if (!WIFSIGNALED(status))
        return "it ended too early";
      if (WTERMSIG(status) == SIGALRM)
        return "it takes longer than " + std::to_string(limits.seconds) + " s";
      return strsignal(WTERMSIG(status));
    }
  } // namespace


  std::string
  in_separate_process(const std::function<std::string()> &function, const ProcessLimits &limits)
  {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw SeparateProcessError(strerror(errno));
    const pid_t child = fork();
    if (child == 0)
      answer(ends[1], function, limits);

    close(ends[1]);
    std::string text = child > 0 ? read_all(ends[0]) : "";
    close(ends[0]);
    if (child < 0)
      throw SeparateProcessError("there can be no further process");
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
      ;

    if (text.size() < 2 || text.back() != end_of_answer)
      throw SeparateProcessError(why_it_ended(status, limits));
    text.pop_back();
    const char kind = text.front();
    text.erase(0, 1);
    if (kind == input_error)
      throw InputError(text);
    if (kind == other_error)
      throw SeparateProcessError(text);
    return text;
  }
} // namespace Supple
