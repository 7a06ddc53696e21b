#ifndef supple_huge_pages_h
#define supple_huge_pages_h

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
} // namespace Supple

#endif
