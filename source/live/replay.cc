#include <supple/live/replay.h>

#include <supple/base/error.h>
#include <supple/base/progress.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <iostream>
#include <utility>

namespace Supple
{
  Replay::Replay(const Parameters &first,
                 const Session::Scene &scene,
                 const std::vector<Deed> &deeds,
                 const bool by_time,
                 const std::string &folder,
                 const bool quiet,
                 const double finer,
                 const MPI_Comm communicator)
    : deeds(deeds)
    , by_time(by_time)
    , talks(!quiet && dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
    , of_deeds(first, scene, folder, quiet, finer, communicator)
  {
    for (const auto &[asked, entry] :
         {std::make_pair(first.time.estimate_error, "Time/Estimate error"),
          std::make_pair(first.space.second_mesh != SpaceParameters::SecondMesh::none,
                         "Space/Second mesh")})
      if (asked)
        throw InputError(first.origin(entry) +
                         ": the other run would know nothing of hands. Repeat the motion with half "
                         "the step, Live/By = time, and compare.");
    if (deeds.empty())
      throw InputError(first.origin("Live/Motion") + ": nothing is done in this file.");
    of_deeds.check(deeds, false);
  }


  void
  Replay::check()
  {
    of_deeds.check(deeds, true);
    of_deeds.check_start();
    if (talks)
      std::cout << "  by hand    " << deeds.size() - (deeds.back().text == end_of_motion)
                << " deeds up to step " << deeds.back().step << ", " << deeds.back().time << " s"
                << std::endl;
  }


  void
  Replay::begin()
  {
    of_deeds.begin(deeds);
    next = of_deeds.deeds().size();
  }


  /** A step may end a little before the time at which a deed was done, by round-off. */
  bool
  Replay::is_due(const Deed &deed) const
  {
    if (!by_time)
      return deed.step <= of_deeds.now().measurement().step;
    const double accuracy = 1e-6 * of_deeds.now().present().parameters.time.step;
    return deed.time <= of_deeds.now().time() + accuracy;
  }


  void
  Replay::do_what_is_due()
  {
    for (; next < deeds.size() && is_due(deeds[next]) && deeds[next].text != end_of_motion; ++next)
      try
        {
          of_deeds.act(deeds[next].text);
        }
      catch (const InputError &error)
        {
          of_deeds.end();
          throw InputError(deeds[next].place + ": " + error.what());
        }
    if (next < deeds.size() && by_time)
      of_deeds.stop_at(deeds[next].time);
  }


  bool
  Replay::finished() const
  {
    return next == deeds.size() || (deeds[next].text == end_of_motion && is_due(deeds[next])) ||
           of_deeds.now().finished();
  }


  bool
  Replay::advance()
  {
    do_what_is_due();
    return finished() || of_deeds.step();
  }


  double
  Replay::part_done() const
  {
    return std::min(1., of_deeds.now().time() / std::max(deeds.back().time, 1e-300));
  }


  void
  Replay::run()
  {
    Progress progress(talks,
                      dealii::Utilities::MPI::n_mpi_processes(
                        of_deeds.now().present().mesh.communicator) > 1);
    begin();
    while (!finished())
      {
        const bool goes_on = advance();
        progress.update(of_deeds.now().measurement().step, part_done());
        if (!goes_on && !finished())
          {
            progress.clear();
            of_deeds.interrupt();
          }
      }
    progress.clear();
    of_deeds.end();
    if (talks && deeds.back().text != end_of_motion)
      std::cout
        << "  warning     The motion has no end: its session was cut off. It was repeated up "
           "to its last line, "
        << of_deeds.now().time() << " s." << std::endl;
  }
} // namespace Supple
