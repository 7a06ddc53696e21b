#ifndef supple_live_parameters_h
#define supple_live_parameters_h

#include <supple/input/parameter_file.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Supple
{
  /** Subsection Live: what was done by hand in a live session, to be repeated. */
  struct LiveParameters
  {
    enum class By
    {
      step, ///< after as many steps as in the session
      time  ///< at the first step that begins then or later
    };

    std::string motion; ///< file, as written; empty: nothing was done by hand
    By by = By::step;

    void
    declare(dealii::ParameterHandler &prm);

    /** The file, from where the program was started. */
    std::string
    path(const ParameterFile &scene) const;
  };
} // namespace Supple

#endif
