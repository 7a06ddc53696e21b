#ifndef supple_packed_number_h
#define supple_packed_number_h

#include <algorithm>
#include <array>
#include <cstring>

namespace Supple
{
  /** The number that stands in sizeof(Number) bytes of a binary file.
   * @param swapped whether they have the order of another machine */
  template <class Number>
  Number
  packed_number(const char *const bytes, const bool swapped)
  {
    std::array<char, sizeof(Number)> own;
    std::copy_n(bytes, own.size(), own.begin());
    if (swapped)
      std::reverse(own.begin(), own.end());
    Number number;
    std::memcpy(&number, own.data(), own.size());
    return number;
  }
} // namespace Supple

#endif
