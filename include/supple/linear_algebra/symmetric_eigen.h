#ifndef supple_symmetric_eigen_h
#define supple_symmetric_eigen_h

#include <supple/linear_algebra/matrix3.h>

namespace Supple
{
  /** S = V diag(values) V^T */
  struct SymmetricEigen
  {
    std::array<Pack, 3> values;
    Matrix3<Pack> vectors; ///< in the columns
  };


  /**
   * Eigenvalues and eigenvectors of symmetric matrices, one in each lane, by cyclic Jacobi
   * rotations (Golub & Van Loan, Matrix Computations, 8.5). Five sweeps leave off-diagonal entries
   * of the size of round-off in every 3x3 matrix.
   */
  inline SymmetricEigen
  symmetric_eigen(Matrix3<Pack> S)
  {
    namespace stdx  = std::experimental;
    Matrix3<Pack> V = Matrix3<Pack>::identity();
    for (unsigned int sweep = 0; sweep < 5; ++sweep)
      for (const auto &[p, q] : {std::array<unsigned int, 2>{{0, 1}}, {{0, 2}}, {{1, 2}}})
        {
          // t = tan of the angle that makes S(p, q) zero, the smaller of the two.
          const Pack difference = 0.5 * (S(q, q) - S(p, p));
          const Pack length     = stdx::sqrt(difference * difference + S(p, q) * S(p, q));
          Pack denominator      = stdx::abs(difference) + length;
          stdx::where(denominator == 0., denominator) = Pack(1.);
          Pack t                                      = S(p, q) / denominator;
          stdx::where(difference < 0., t)             = -t;
          const Pack c = 1. / stdx::sqrt(1. + t * t), s = t * c;

          for (unsigned int k = 0; k < 3; ++k)
            {
              const Pack sp = S(k, p), sq = S(k, q), vp = V(k, p), vq = V(k, q);
              S(k, p) = c * sp - s * sq;
              S(k, q) = s * sp + c * sq;
              V(k, p) = c * vp - s * vq;
              V(k, q) = s * vp + c * vq;
            }
          for (unsigned int k = 0; k < 3; ++k)
            {
              const Pack sp = S(p, k), sq = S(q, k);
              S(p, k) = c * sp - s * sq;
              S(q, k) = s * sp + c * sq;
            }
        }
    return {{{S(0, 0), S(1, 1), S(2, 2)}}, V};
  }
} // namespace Supple

#endif
