#ifndef supple_matrix3_h
#define supple_matrix3_h

#include <array>
#include <cmath>
#include <experimental/simd>

namespace Supple
{
  /** As many doubles as the machine computes side by side: one lane per cell. */
  using Pack = std::experimental::native_simd<double>;

  constexpr unsigned int n_lanes = Pack::size();


  /** A 3x3 matrix, stored by rows, of doubles or of packs of them. */
  template <class Number>
  struct Matrix3
  {
    std::array<Number, 9> entries;

    const Number &
    operator()(const unsigned int row, const unsigned int column) const
    {
      return entries[3 * row + column];
    }

    Number &
    operator()(const unsigned int row, const unsigned int column)
    {
      return entries[3 * row + column];
    }

    static Matrix3
    identity()
    {
      const Number zero(0.), one(1.);
      return {{{one, zero, zero, zero, one, zero, zero, zero, one}}};
    }
  };


  template <class Number>
  Matrix3<Number>
  operator*(const Matrix3<Number> &A, const Matrix3<Number> &B)
  {
    Matrix3<Number> C;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        C(i, j) = A(i, 0) * B(0, j) + A(i, 1) * B(1, j) + A(i, 2) * B(2, j);
    return C;
  }


  /** A^T B */
  template <class Number>
  Matrix3<Number>
  transposed_product(const Matrix3<Number> &A, const Matrix3<Number> &B)
  {
    Matrix3<Number> C;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        C(i, j) = A(0, i) * B(0, j) + A(1, i) * B(1, j) + A(2, i) * B(2, j);
    return C;
  }


  /** The cofactor matrix, det(F) F^-T; it exists for every F. */
  template <class Number>
  Matrix3<Number>
  cofactor(const Matrix3<Number> &F)
  {
    Matrix3<Number> C;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        {
          const unsigned int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
          const unsigned int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
          C(i, j) = F(i1, j1) * F(i2, j2) - F(i1, j2) * F(i2, j1);
        }
    return C;
  }


  template <class Number>
  Number
  trace(const Matrix3<Number> &F)
  {
    return F(0, 0) + F(1, 1) + F(2, 2);
  }


  /** A : A */
  template <class Number>
  Number
  norm_square(const Matrix3<Number> &A)
  {
    Number sum = A.entries[0] * A.entries[0];
    for (unsigned int k = 1; k < 9; ++k)
      sum += A.entries[k] * A.entries[k];
    return sum;
  }


  template <class Number>
  Number
  determinant(const Matrix3<Number> &F)
  {
    return F(0, 0) * (F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1)) +
           F(0, 1) * (F(1, 2) * F(2, 0) - F(1, 0) * F(2, 2)) +
           F(0, 2) * (F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0));
  }
} // namespace Supple

#endif
