#ifndef supple_probe_parameters_h
#define supple_probe_parameters_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>

#include <map>
#include <string>

namespace Supple
{
  /** Subsection Probes: what is followed. */
  struct ProbeParameters
  {
    std::string points;
    std::string boundaries;
    std::string regions;
    std::string profiles;
    dealii::Point<3> profile_center{0., 0., 0.};
    unsigned int profile_every = 1;

    /** Where at rest the nodes are that a pilot run has chosen, by the names of the probes; not of
     * the file [m]. */
    std::map<std::string, dealii::Point<3>> chosen;

    void
    declare(dealii::ParameterHandler &prm);
  };
} // namespace Supple

#endif
