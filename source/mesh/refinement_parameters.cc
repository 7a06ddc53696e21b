#include <supple/mesh/refinement_parameters.h>

#include <supple/base/error.h>
#include <supple/input/entries.h>

#include <regex>

namespace Supple
{
  using namespace Entries;

  namespace
  {
    /** "3 by tip.uz" in parts: how often, and by what; zero if it is not of that form. */
    std::pair<unsigned int, std::string>
    taken_apart(const std::string &text)
    {
      std::smatch found;
      if (!std::regex_match(text, found, std::regex("\\s*(\\d{1,3})\\s+by\\s+(\\S+)\\s*")))
        return {0, ""};
      const unsigned int n = std::stoul(found[1]);
      return {n <= 100 ? n : 0, found[2]};
    }
  } // namespace


  unsigned int
  RefinementParameters::n_rounds() const
  {
    return by.empty() ? 0 : taken_apart(by).first;
  }


  std::string
  RefinementParameters::quantity() const
  {
    return by.empty() ? "" : taken_apart(by).second;
  }


  void
  RefinementParameters::declare(dealii::ParameterHandler &prm)
  {
    const Range form("N by QUANTITY, N from 1 to 100, or nothing", [](const std::string &text) {
      return text.empty() || taken_apart(text).first > 0;
    });
    add(prm,
        "Refine",
        by,
        "none",
        form,
        "Such as 3 by tip.uz: three times the scene is run without results, the cells with half of "
        "the error in space are cut, and so are neighbours as far as edges fit together; the run "
        "itself is on the last mesh. By energy: those with most of the error of the elastic "
        "energy; in a dynamic scene the most over the run. By a displacement in probes.csv, in a "
        "static scene: those with most of its error, by a dual solution. Empty: no such runs.");
    prm.add_parameter(
      "Refine region",
      region,
      "Where cells are cut before anything else, such as 0.1 - sqrt(x^2 + y^2): an expression that "
      "is greater than 0 at the middle or a vertex of a cell to be cut, in the body at rest. "
      "Empty: "
      "nowhere. Unit: m. Range: an expression of x, y, z.",
      dealii::Patterns::Anything());
    add(prm,
        "Refine region times",
        region_times,
        "none",
        Range::whole_number(1),
        "How often all edges of the cells of Refine region are halved.");
    add(prm,
        "Refine region size",
        region_size,
        "m",
        Range::at_least(0),
        "Cells of Refine region are cut until no edge of theirs is longer; 0: as often as Refine "
        "region times says.");
    add(prm,
        "Refine most cells",
        most_cells,
        "none",
        Range::whole_number(1),
        "A mesh that would get more cells by Refine, Refine region or Space/Aim is refused. A run "
        "takes about 1.4 kB a cell with multigrid, and more with a factorization.");
  }
} // namespace Supple
