#include <supple/output/gnuplot.h>

#include <sys/wait.h>

#include <spawn.h>
#include <unistd.h>

#include <vector>

extern char **environ; // POSIX declares it in no header

namespace Supple
{
  namespace
  {
    /** Runs a program without a word. @return its exit status, or -1 if it is not there */
    int
    execute(const std::vector<std::string> &command)
    {
      std::vector<char *> words;
      for (const std::string &word : command)
        words.push_back(const_cast<char *>(word.c_str()));
      words.push_back(nullptr);

      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", 1, 0);
      posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", 1, 0);
      pid_t process;
      const int problem =
        posix_spawnp(&process, words[0], &actions, nullptr, words.data(), environ);
      posix_spawn_file_actions_destroy(&actions);
      int status = 0;
      if (problem != 0 || waitpid(process, &status, 0) < 0)
        return -1;
      return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
  } // namespace


  std::string
  quoted(const std::string &text)
  {
    std::string result = "\"";
    for (const char c : text)
      result += (c == '"' || c == '\\') ? std::string("\\") + c : std::string(1, c);
    return result + "\"";
  }


  std::string
  draw(const std::string &folder, const std::string &plot)
  {
    const int status = execute({"gnuplot", "-c", folder + "/" + plot + ".gp", folder});
    if (status == 0)
      return "";
    return (status < 0 ? "gnuplot (Debian: gnuplot-nox) is not there" : "gnuplot failed") +
           std::string(": no plots; ") + plot + ".gp draws them.";
  }
} // namespace Supple
