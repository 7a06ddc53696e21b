#include <supple/observe/space_parameters.h>

#include <supple/input/entries.h>

namespace Supple
{
  void
  SpaceParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Space");
    Entries::add_choice(
      prm,
      "Estimate error",
      estimate,
      {{"end", Estimate::end}, {"frames", Estimate::frames}, {"never", Estimate::never}},
      "When the error that the mesh makes is estimated from the stress (doc/error.md). end: in the "
      "last state, for the end of the run, summary.json and the last frame. frames: at each frame "
      "too, with a field of the cells in the frames and a column in history.csv.");
    prm.leave_subsection();
  }
} // namespace Supple
