#ifndef supple_idle_entries_h
#define supple_idle_entries_h

#include <supple/scene/parameters.h>

#include <string>
#include <vector>

namespace Supple
{
  /** Entries that say something else than their default and count for nothing, because another
   * entry is missing or says otherwise; in sentences that begin with where they were set. */
  std::vector<std::string>
  idle_entries(const Parameters &parameters);
} // namespace Supple

#endif
