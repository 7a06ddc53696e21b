#ifndef supple_lanes_h
#define supple_lanes_h

#include <cstdint>
#include <cstring>
#include <experimental/simd>

namespace Supple
{
  /** GCC's and Clang's vector types: n numbers that are computed side by side, on every machine. */
  template <class Number, unsigned int n>
  struct VectorType
  {
    typedef Number type __attribute__((vector_size(n * sizeof(Number))));
  };


  /** The numbers of one node of a multigrid level, 3 or 6 of them, in 4 or 8 lanes. */
  template <class Number, unsigned int B>
  using Lanes = typename VectorType<Number, (B == 3 ? 4 : 8)>::type;


  /** The numbers of a node in single precision; lanes past B are zero. */
  template <unsigned int B>
  struct NodeValues
  {
    Lanes<float, B> lanes;
  };


  /** Loads from any address. */
  template <class Vector, class Number>
  inline Vector
  load(const Number *from)
  {
    Vector vector;
    std::memcpy(&vector, from, sizeof(vector));
    return vector;
  }


  /** Eight whole numbers of sixteen bits as floating point numbers. */
  template <class Number>
  inline Lanes<Number, 6>
  load_converted(const std::int16_t *from)
  {
    // GCC 12 takes vectors apart to convert them, but not these.
    namespace stdx = std::experimental;
    const stdx::simd<Number, stdx::simd_abi::deduce_t<Number, 8>> converted(from,
                                                                            stdx::element_aligned);
    static_assert(sizeof(converted) == sizeof(Lanes<Number, 6>), "eight numbers without gaps");
    return load<Lanes<Number, 6>>(&converted);
  }


  /** Eight numbers, rounded towards zero to whole numbers of sixteen bits. */
  inline void
  store_converted(const Lanes<float, 6> &values, std::int16_t *to)
  {
    namespace stdx = std::experimental;
    const stdx::simd<float, stdx::simd_abi::deduce_t<float, 8>> converted(
      reinterpret_cast<const float *>(&values), stdx::element_aligned);
    converted.copy_to(to, stdx::element_aligned);
  }


  /** One number in the first B lanes, zero in the rest. */
  template <unsigned int B>
  inline Lanes<float, B>
  broadcast(const float value)
  {
    if constexpr (B == 3)
      return Lanes<float, B>{value, value, value, 0.f};
    else
      return Lanes<float, B>{value, value, value, value, value, value, 0.f, 0.f};
  }


  /** The sums of the lanes of four vectors. */
  inline Lanes<float, 3>
  sums_of_lanes(const Lanes<float, 3> &a,
                const Lanes<float, 3> &b,
                const Lanes<float, 3> &c,
                const Lanes<float, 3> &d)
  {
    const Lanes<float, 3> ab =
      __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Lanes<float, 3> cd =
      __builtin_shufflevector(c, d, 0, 4, 1, 5) + __builtin_shufflevector(c, d, 2, 6, 3, 7);
    return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) +
           __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  }


  /** In lane i, the sum of the lanes of rows[i]. */
  template <unsigned int B>
  inline Lanes<float, B>
  sums_of_lanes(const Lanes<float, 6> (&rows)[B])
  {
    const Lanes<float, 3> zero{};
    Lanes<float, 3> half[B];
    for (unsigned int i = 0; i < B; ++i)
      half[i] = __builtin_shufflevector(rows[i], rows[i], 0, 1, 2, 3) +
                __builtin_shufflevector(rows[i], rows[i], 4, 5, 6, 7);
    if constexpr (B == 3)
      return sums_of_lanes(half[0], half[1], half[2], zero);
    else
      return __builtin_shufflevector(sums_of_lanes(half[0], half[1], half[2], half[3]),
                                     sums_of_lanes(half[4], half[5], zero, zero),
                                     0,
                                     1,
                                     2,
                                     3,
                                     4,
                                     5,
                                     6,
                                     7);
  }


  /** The same for rows of four lanes. */
  inline Lanes<float, 3>
  sums_of_lanes(const Lanes<float, 3> (&rows)[3])
  {
    const Lanes<float, 3> zero{};
    return sums_of_lanes(rows[0], rows[1], rows[2], zero);
  }
} // namespace Supple

#endif
