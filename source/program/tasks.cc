#include <supple/program/tasks.h>

#include <supple/base/error.h>
#include <supple/base/first_process.h>
#include <supple/base/folder_lock.h>
#include <supple/identification/identification.h>
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


    /** With the mesh that its pilot runs find, if it is to be run. */
    Parameters
    scene_of(const CommandLine &line, const MPI_Comm communicator)
    {
      const Parameters scene = read_scene(line.scene, line.overrides);
      if (line.action == CommandLine::Action::run)
        {
          if (asks_for_pilots(scene))
            require_folder(line.output.empty() ? scene.output_folder() : line.output, communicator);
          return adapted(scene, !line.quiet, communicator);
        }
      check_adaptation(scene, communicator);
      return scene;
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
          else
            run_or_check<Simulation>(line, scene_of(line, communicator), communicator);
      }
  }
} // namespace Supple
