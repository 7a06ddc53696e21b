#include <supple/multigrid/coarse_level.h>

#include <algorithm>

namespace Supple
{
  std::uint32_t
  NodeNumbers::local(const std::uint32_t global) const
  {
    if (owns(global))
      return global - first_own;
    return n_owned + (std::lower_bound(ghosts.begin(), ghosts.end(), global) - ghosts.begin());
  }


  void
  NodeNumbers::complete()
  {
    std::sort(ghosts.begin(), ghosts.end());
    ghosts.erase(std::unique(ghosts.begin(), ghosts.end()), ghosts.end());
    ghosts.erase(std::remove_if(ghosts.begin(),
                                ghosts.end(),
                                [this](const auto node) { return owns(node); }),
                 ghosts.end());
  }
} // namespace Supple
