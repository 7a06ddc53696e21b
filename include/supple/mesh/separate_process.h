#ifndef supple_separate_process_h
#define supple_separate_process_h

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

namespace Supple
{
  /** What a separate process may take; it is ended when it takes more. */
  struct ProcessLimits
  {
    unsigned int seconds; ///< on the clock
    std::size_t memory;   ///< beside what is there already [bytes]
  };


  /** A separate process has ended before its work was done. */
  class SeparateProcessError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };


  /**
   * Calls a function of a library that may crash, in a copy of this process, and gives the bytes
   * that it returned. It must not call MPI. Takes a few milliseconds.
   * @throws InputError that the function threw
   * @throws SeparateProcessError if there is no answer: the function threw something else, crashed,
   * took too long or too much memory
   */
  std::string
  in_separate_process(const std::function<std::string()> &function, const ProcessLimits &limits);
} // namespace Supple

#endif
