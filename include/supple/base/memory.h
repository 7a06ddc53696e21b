#ifndef supple_memory_h
#define supple_memory_h

#include <cstddef>
#include <vector>

namespace Supple
{
  /** Asks the operating system for pages of megabytes where they fit in; to be called before the
   * memory is first written to. Nothing but speed depends on it. */
  void
  advise_huge_pages(void *begin, std::size_t n_bytes);


  /** Resizes an empty vector that is swept through again and again: with large pages its addresses
   * are looked up less often. */
  template <class T>
  void
  resize_in_huge_pages(std::vector<T> &values, const std::size_t n)
  {
    values.reserve(n);
    advise_huge_pages(values.data(), n * sizeof(T));
    values.resize(n);
  }


  /** Asks memory for the line of what a sweep over a matrix comes to later, or has been at before
   * if it goes backwards. It may lie outside of the matrix. Nothing but speed depends on it. */
  template <int direction = 1>
  inline void
  ask_for_line_ahead(const void *const at)
  {
    constexpr std::ptrdiff_t lead = 8192; // bytes

    __builtin_prefetch(static_cast<const char *>(at) + direction * lead);
  }


  /** Asks memory for what a sweep over values, which is at k, comes to two later: one takes about
   * as long to compute as memory takes to answer. Nothing but speed depends on it. */
  template <class T>
  inline void
  ask_for_next(const std::vector<T> &values, const std::size_t k)
  {
    constexpr std::size_t lead = 2, line = 64; // bytes in a line of the caches

    if (k + lead >= values.size())
      return;
    const char *const next = reinterpret_cast<const char *>(&values[k + lead]);
    for (std::size_t byte = 0; byte < sizeof(T); byte += line)
      __builtin_prefetch(next + byte);
  }
} // namespace Supple

#endif
