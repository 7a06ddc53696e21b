#include <supple/program/tasks.h>

#include <supple/base/error.h>
#include <supple/base/first_process.h>
#include <supple/base/folder_lock.h>
#include <supple/identification/identification.h>
#include <supple/live/live_run.h>
#include <supple/live/replay.h>
#include <supple/program/parameter_reference.h>
#include <supple/run/adaptation.h>
#include <supple/run/simulation.h>
#include <supple/scene/read_scene.h>
#include <supple/study/aim_search.h>
#include <supple/study/study.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>
#include <optional>

namespace Supple
{
  namespace
  {
    template <typename Task, typename TaskParameters>
    void
    run_or_check(const CommandLine &line,
                 const TaskParameters &parameters,
                 const MPI_Comm communicator)
    {
      const auto folder = line.output.empty() ? parameters.output_folder() : line.output;
      Task task(parameters, folder, line.quiet, communicator);
      if (line.action == CommandLine::Action::run)
        task.run();
      else
        task.check();
    }


    /** Looks whether results can be written, before pilot runs take their time for nothing.
     * @throws InputError if the folder or one above it is none, or another run writes there */
    void
    require_folder(const std::string &folder, const MPI_Comm communicator)
    {
      namespace fs = std::filesystem;
      on_first_process(communicator, [&] {
        std::error_code none; // what can't be looked at is refused when it is to be made
        fs::path place = fs::absolute(folder, none);
        while (!fs::exists(place, none) && place.has_relative_path())
          place = place.parent_path();
        if (!fs::is_directory(place, none))
          throw InputError("The output folder " + folder + " can't be written (" + place.string() +
                           " is no folder). Name another one with --output.");
        if (fs::is_directory(folder, none))
          FolderLock lock(folder);
      });
    }


    /** What a study says, or the aim of a scene; none of other scenes. @throws InputError */
    std::optional<StudyParameters>
    study_of(const CommandLine &line)
    {
      if (StudyParameters::is_study(line.scene))
        return StudyParameters::read(line.scene, line.overrides);
      if (!line.aims)
        return {};
      if (IdentificationParameters::is_identification(line.scene))
        throw InputError("--aim: " + line.scene +
                         " is an identification, whose runs are static; an aim goes with scenes "
                         "and studies.");
      return StudyParameters::aim_of_scene(line.scene, line.overrides);
    }


    /** The scene of the command line, as its file is now, with more changes. */
    Session::Scene
    reader_of(const CommandLine &line)
    {
      return [file = ParameterFile(line.scene),
              own  = line.overrides](const std::vector<Override> &more) {
        std::vector<Override> all = own;
        all.insert(all.end(), more.begin(), more.end());
        return read_scene(file, all);
      };
    }


    /** With the mesh that its pilot runs find, unless it is checked alone. */
    Parameters
    scene_of(const CommandLine &line, const MPI_Comm communicator)
    {
      const Parameters scene = read_scene(line.scene, line.overrides);
      if (line.action != CommandLine::Action::check)
        {
          if (asks_for_pilots(scene))
            require_folder(line.output.empty() ? scene.output_folder() : line.output, communicator);
          return adapted(scene, !line.quiet, communicator);
        }
      check_adaptation(scene, communicator);
      return scene;
    }


    /** What was done by hand in a live session, once more. */
    void
    run_or_check_replay(const CommandLine &line,
                        const Parameters &scene,
                        const MPI_Comm communicator)
    {
      Replay replay(scene,
                    reader_of(line),
                    read_motion(scene.live.path(scene.file)),
                    scene.live.by == LiveParameters::By::time,
                    line.output.empty() ? scene.output_folder() : line.output,
                    line.quiet,
                    1.,
                    communicator);
      if (line.action == CommandLine::Action::run)
        replay.run();
      else
        replay.check();
    }


    void
    live_run(const CommandLine &line, const MPI_Comm communicator)
    {
      const std::string live = "--live " + line.scene + ": ";
      if (line.aims || StudyParameters::is_study(line.scene) ||
          IdentificationParameters::is_identification(line.scene))
        throw InputError(live + "a session runs a single scene, neither a study nor an aim.");
      const Parameters scene = scene_of(line, communicator);
      if (!scene.live.motion.empty())
        throw InputError(live +
                         "this scene is a session that has ended. Without --live it is "
                         "run once more.");
      const std::string folder =
        line.output.empty() ? scene.output_folder() + "-live" : line.output;
      LiveRun(scene, reader_of(line), folder, line.quiet, communicator).run();
    }
  } // namespace


  void
  execute(const CommandLine &line, const MPI_Comm communicator)
  {
    using Action    = CommandLine::Action;
    const bool root = dealii::Utilities::MPI::this_mpi_process(communicator) == 0;
    switch (line.action)
      {
        case Action::print_help:
          if (root)
            std::cout << CommandLine::help();
          return;
        case Action::print_version:
          if (root)
            std::cout << "supple " << SUPPLE_VERSION << std::endl;
          return;
        case Action::print_parameters:
          if (root)
            print_reference(std::cout, line.format);
          return;
        case Action::live:
          live_run(line, communicator);
          return;
        case Action::check:
        case Action::run:
          if (const auto study = study_of(line))
            {
              if (study->aim.empty())
                run_or_check<Study>(line, *study, communicator);
              else
                run_or_check<AimSearch>(line, *study, communicator);
            }
          else if (IdentificationParameters::is_identification(line.scene))
            run_or_check<Identification>(line,
                                         IdentificationParameters::read(line.scene, line.overrides),
                                         communicator);
          else if (const Parameters scene = scene_of(line, communicator); scene.live.motion.empty())
            run_or_check<Simulation>(line, scene, communicator);
          else
            run_or_check_replay(line, scene, communicator);
      }
  }
} // namespace Supple
