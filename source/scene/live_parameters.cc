#include <supple/scene/live_parameters.h>

#include <supple/input/entries.h>

#include <filesystem>

namespace Supple
{
  using namespace dealii;

  void
  LiveParameters::declare(ParameterHandler &prm)
  {
    prm.enter_subsection("Live");
    Entries::add(prm,
                 "Motion",
                 motion,
                 "none",
                 Patterns::Anything(),
                 "File with what was done by hand in a live session (supple --live), relative to "
                 "the folder of the scene: it is done again at the same steps. Empty: nothing.");
    Entries::add_choice(prm,
                        "By",
                        by,
                        {{"step", By::step}, {"time", By::time}},
                        "When it is done again: after as many steps as in the session, which gives "
                        "the same digits, or at the same times, for runs with other steps.");
    prm.leave_subsection();
  }


  std::string
  LiveParameters::path(const ParameterFile &scene) const
  {
    return (std::filesystem::path(scene.folder()) / motion).string();
  }
} // namespace Supple
