/**
 * Supple: soft elastic bodies in motion.
 *
 *   .prm -> Parameters -> Mesh -> Body -> ImplicitOperator -> TimeIntegrator -> Diagnostics ->
 * Frames, CSV, summary
 *
 * and Study -> many of these -> tables and plots of error against run time,
 * Identification -> many of these -> the layers of skin that fit to measurements.
 */

#include <supple/base/error.h>
#include <supple/base/lone_process.h>
#include <supple/input/command_line.h>
#include <supple/program/tasks.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <csignal>
#include <iostream>
#include <new>
#include <optional>


int
main(int argc, char **argv)
{
  // Only the program's name: libraries behind deal.II would take our options for theirs.
  int n_names = 1;
  std::optional<Supple::LoneProcess> lone_process(std::in_place);
  dealii::Utilities::MPI::MPI_InitFinalize mpi(n_names, argv, 1);
  lone_process.reset();
  std::signal(SIGPIPE, SIG_IGN); // whoever reads the screen may go away, as in supple ... | head
  dealii::deal_II_exceptions::disable_abort_on_exception(); // whatever fails ends with a message

  const bool root = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  const auto fail = [root](const std::exception &exception, const int exit_status) {
    if (root)
      std::cerr << "supple: " << Supple::on_one_screen(exception.what()) << std::endl;
    return exit_status;
  };
  // Perhaps on this process alone: the others must not wait for it.
  const auto abandon = [](const std::string &message) {
    std::cerr << "supple: " << Supple::on_one_screen(message) << std::endl;
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      MPI_Abort(MPI_COMM_WORLD, 2);
    return 2;
  };
  try
    {
      Supple::execute(Supple::CommandLine::parse(argc, argv), MPI_COMM_WORLD);
      return 0;
    }
  catch (const Supple::InputError &error)
    {
      return fail(error, 1);
    }
  catch (const Supple::ComputationError &error)
    {
      return fail(error, 2);
    }
  catch (const std::bad_alloc &)
    {
      return abandon("there is not enough memory for this scene.");
    }
  catch (const std::exception &error)
    {
      return abandon(error.what());
    }
}
