#ifndef supple_refinement_parameters_h
#define supple_refinement_parameters_h

#include <supple/input/parameter_file.h>

#include <string>
#include <vector>

namespace Supple
{
  /** Subsection Mesh: where the mesh is refined, and what pilot runs have found of it. */
  struct RefinementParameters
  {
    std::string by; ///< such as "3 by tip.uz"; empty: no pilot runs
    std::string region;
    unsigned int region_times = 1;
    double region_size        = 0.; ///< [m]; 0: as often as region_times says
    unsigned int most_cells   = 2000000;

    /** A run that showed where the mesh is too coarse. */
    struct Pilot
    {
      unsigned int cells = 0;
      unsigned int dofs  = 0;
      std::string of;                   ///< what the error is a part of: "tip.uz"
      double error   = 0.;              ///< relative, in space; not a number if it is unknown
      double seconds = 0.;              ///< of the run, and of the cut that came before it
      std::vector<unsigned int> marked; ///< cells to be cut after it, on the first process alone
    };
    std::vector<Pilot> pilots; ///< in their order; not of the file

    /** Why there could be no more of them before the aim was met; not of the file. */
    std::string end_of_pilots;

    /** How often all edges are halved after that; not of the file. */
    unsigned int everywhere = 0;

    void
    declare(dealii::ParameterHandler &prm);

    /** Whether anything is to be cut. */
    bool
    wanted() const
    {
      return !region.empty() || !pilots.empty() || everywhere > 0;
    }

    /** Whether the scene asks for a mesh that is not the generator's or the file's. */
    bool
    asked() const
    {
      return !region.empty() || !by.empty() || !pilots.empty();
    }

    /** How many pilot runs `by` asks for. */
    unsigned int
    n_rounds() const;

    /** By what: energy or a column of a probe; empty without `by`. */
    std::string
    quantity() const;
  };
} // namespace Supple

#endif
