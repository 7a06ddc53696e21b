#include <supple/run/adaptation.h>

#include <supple/base/error.h>
#include <supple/base/interrupt.h>
#include <supple/base/progress.h>
#include <supple/base/stopwatch.h>
#include <supple/base/text.h>
#include <supple/run/error_words.h>
#include <supple/run/simulation.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <iostream>
#include <limits>

namespace Supple
{
  namespace
  {
    using Pilot = RefinementParameters::Pilot;


    /** Runs a scene, which from then on keeps the vertices that its points have chosen. */
    Pilot
    run_pilot(Parameters &scene, const std::string &quantity, const MPI_Comm communicator)
    {
      const Stopwatch stopwatch;
      Simulation simulation(Companion::scene(scene), "", true, communicator);
      const std::unique_ptr<CellIndicators> indicators = simulation.make_indicators(quantity);
      simulation.run(indicators.get());
      scene = simulation.with_chosen_vertices(scene);
      Pilot pilot;
      pilot.cells   = simulation.summary().size.cells;
      pilot.dofs    = simulation.summary().size.dofs;
      pilot.of      = indicators->of();
      pilot.error   = indicators->error();
      pilot.marked  = indicators->cells_to_cut();
      pilot.seconds = stopwatch.seconds();
      return pilot;
    }


    std::string
    error_in_words(const Pilot &pilot)
    {
      return std::isfinite(pilot.error) ? "in space " + part_of(pilot.error, false, pilot.of)
                                        : "refined by " + pilot.of;
    }


    void
    print(const Pilot &pilot, const unsigned int number)
    {
      std::cout << "pilot run " << number << ": " << pilot.cells << " cells, " << pilot.dofs
                << " unknowns, " << error_in_words(pilot) << ", "
                << readable_duration(pilot.seconds) << std::endl;
    }


    /** @throws InputError if the aim can't be told from the run */
    void
    require_error(const Pilot &pilot, const Parameters &scene)
    {
      if (!std::isfinite(pilot.error))
        throw InputError(scene.origin("Space/Aim") +
                         ": the error of the energy is unknown, for a force acts at a point or "
                         "along a line, where the exact one is infinite. Refine by a probe "
                         "(Mesh/Refine).");
    }
  } // namespace


  bool
  asks_for_pilots(const Parameters &scene)
  {
    return !scene.mesh.refinement.by.empty() || scene.space.aim > 0.;
  }


  Parameters
  adapted(const Parameters &scene, const bool talks, const MPI_Comm communicator)
  {
    if (!asks_for_pilots(scene))
      return scene;
    const bool root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    Parameters fine = scene;

    const RefinementParameters &asked = scene.mesh.refinement;
    std::vector<Pilot> &pilots        = fine.mesh.refinement.pilots;
    std::string quantity              = asked.quantity();
    const unsigned int most =
      asked.by.empty() ? std::numeric_limits<unsigned int>::max() : asked.n_rounds();
    const double aim = scene.space.aim;
    const InterruptGuard interrupt;
    bool goes_on = true;
    while (goes_on && pilots.size() < most)
      {
        const std::string number = std::to_string(pilots.size() + 1);
        try
          {
            pilots.push_back(run_pilot(fine, quantity, communicator));
          }
        catch (const InterruptedError &)
          {
            throw InterruptedError("Interrupted in pilot run " + number +
                                   ", which was to refine the mesh; nothing is written.");
          }
        catch (const ComputationError &error)
          {
            throw ComputationError("Pilot run " + number +
                                   ", which was to refine the mesh: " + error.what());
          }
        catch (const InputError &error)
          {
            if (aim == 0. || pilots.empty())
              throw;
            fine.mesh.refinement.end_of_pilots = error.what(); // a finer mesh there can't be
            break;
          }
        if (interrupt.requested(communicator))
          throw InterruptedError("Interrupted after pilot run " + number +
                                 ", which was to refine the mesh; nothing is written.");
        quantity = pilots.back().of;
        if (talks && root)
          print(pilots.back(), pilots.size());
        if (aim > 0.)
          require_error(pilots.back(), scene);
        goes_on = !(pilots.back().error <= aim);
      }
    if (!goes_on || !fine.mesh.refinement.end_of_pilots.empty())
      pilots.back().marked.clear();
    return fine;
  }


  void
  check_adaptation(const Parameters &scene, const MPI_Comm communicator)
  {
    if (asks_for_pilots(scene))
      Simulation(Companion::scene(scene), "", true, communicator)
        .make_indicators(scene.mesh.refinement.quantity());
  }
} // namespace Supple
