#include <supple/output_folder.h>

#include <supple/error.h>

#include <deal.II/base/mpi.h>

namespace Supple
{
  void
  prepare_output_folder(const std::string &folder,
                        const MPI_Comm communicator,
                        const std::function<void()> &make)
  {
    std::string problem;
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      try
        {
          make();
        }
      catch (const InputError &error)
        {
          problem = error.what();
        }
      catch (const std::exception &exception)
        {
          problem = "The output folder " + folder + " can't be written (" + exception.what() +
                    "). Name another one with --output.";
        }
    problem = dealii::Utilities::MPI::broadcast(communicator, problem);
    if (!problem.empty())
      throw InputError(problem);
  }
} // namespace Supple
