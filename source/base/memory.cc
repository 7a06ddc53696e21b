#include <supple/base/memory.h>

#include <cstdint>
#include <sys/mman.h>

namespace Supple
{
  void
  advise_huge_pages(void *const begin, const std::size_t n_bytes)
  {
    constexpr std::uintptr_t page = 2u << 20;

    const auto address         = reinterpret_cast<std::uintptr_t>(begin);
    const std::uintptr_t first = (address + page - 1) / page * page;
    const std::uintptr_t end   = (address + n_bytes) / page * page;
    if (end > first)
      madvise(reinterpret_cast<void *>(first), end - first, MADV_HUGEPAGE);
  }
} // namespace Supple
