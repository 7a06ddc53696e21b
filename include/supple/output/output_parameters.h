#ifndef supple_output_parameters_h
#define supple_output_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace Supple
{
  /** Subsection Output: which files are written, and where. */
  struct OutputParameters
  {
    enum class Frames
    {
      adaptive,
      every,
      interval,
      none
    };

    std::string folder;
    Frames frames              = Frames::adaptive;
    double motion              = 0.02;
    double volume_ratio_change = 0.1;
    double longest_interval    = 0.;
    unsigned int every         = 1;
    double interval            = 0.1;
    bool history               = true;
    bool report                = true;
    bool mesh                  = false;

    void
    declare(dealii::ParameterHandler &prm);
  };


  /** Subsection Checkpoint: when a checkpoint is written, and whether a run goes on from one. */
  struct CheckpointParameters
  {
    unsigned int every = 0;  ///< steps; 0: never
    double minutes     = 0.; ///< of wall time; 0: never
    bool resume        = false;

    void
    declare(dealii::ParameterHandler &prm);

    bool
    wanted() const
    {
      return every > 0 || minutes > 0.;
    }
  };
} // namespace Supple

#endif
