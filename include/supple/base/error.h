#ifndef supple_error_h
#define supple_error_h

#include <stdexcept>
#include <string>

namespace Supple
{
  /** What the user gave is wrong. Thrown on all processes alike; the program ends with exit
   * status 1. */
  class InputError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };


  /**
   * The computation failed. Thrown on all processes alike; the program ends with exit status 2, and
   * what was written stays readable.
   */
  class ComputationError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };


  /** The user stopped the computation by Ctrl-C or SIGTERM. Exit status 2, as for a failure. */
  class InterruptedError : public ComputationError
  {
  public:
    using ComputationError::ComputationError;
  };


  /** Results can't be written any more. Thrown on one process alone; the program ends with exit
   * status 2. */
  class WriteError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };
} // namespace Supple

#endif
