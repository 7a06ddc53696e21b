#include <supple/base/first_process.h>

#include <supple/base/error.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace Supple
{
  void
  on_first_process(const MPI_Comm communicator, const std::function<void()> &action)
  {
    std::string problem;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      try
        {
          action();
        }
      catch (const InputError &error)
        {
          problem = error.what();
        }
    problem = dealii::Utilities::MPI::broadcast(communicator, problem);
    if (!problem.empty())
      throw InputError(problem);
  }
} // namespace Supple
