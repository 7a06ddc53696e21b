#ifndef supple_rotation_h
#define supple_rotation_h

#include <supple/linear_algebra/matrix3.h>

namespace Supple
{
  /**
   * How the rotation R of a cell is taken from its deformation gradient F.
   *
   * - none: R = I, linear elasticity.
   * - gram_schmidt: the columns of F made orthonormal one after the other. Quick, but it depends on
   * how the body at rest lies to the axes, and the force is not the gradient of an energy: it has a
   * net moment.
   * - polar: the rotation nearest to F, that is the one which maximizes trace(R^T F). For det F > 0
   * it is the rotation of the polar decomposition F = R U.
   */
  enum class RotationMethod
  {
    none,
    gram_schmidt,
    polar
  };


  /**
   * The proper rotation nearest to @p F, for every F: singular value decomposition with the sign of
   * the smallest singular value chosen so that det R = 1. The identity where F is zero or not
   * finite.
   */
  Matrix3<double>
  nearest_rotation(const Matrix3<double> &F);


  /** |R^T R - I|^2, zero for a rotation or reflection, not-a-number if R has one. */
  template <class Number>
  Number
  orthogonality_defect(const Matrix3<Number> &R)
  {
    Matrix3<Number> S = transposed_product(R, R);
    for (unsigned int i = 0; i < 3; ++i)
      S(i, i) -= 1.;
    return norm_square(S);
  }


  /**
   * The nearest rotation in closed form. The largest root l of
   *   l^4 - 2 |F|^2 l^2 - 8 det(F) l + |F|^4 - 4 |cof F|^2 = 0
   * is the maximum of trace(R^T F) (Horn 1987, the characteristic polynomial of his 4x4 matrix);
   * Newton's method from sqrt(3) |F| >= l falls onto it monotonically. Then R = ((l^2 + |F|^2) F +
   * 2 l cof F - 2 F F^T F) / (l (l^2 - |F|^2) - 2 det F). It loses accuracy where the maximum is
   * nearly attained twice (F flat along two axes, or mirrored with two equal smallest stretches):
   * look at orthogonality_defect() of the result.
   */
  template <class Number>
  Matrix3<Number>
  closed_form_rotation(const Matrix3<Number> &F)
  {
    using std::sqrt;
    using std::experimental::all_of;
    using std::experimental::sqrt;

    const Matrix3<Number> C = cofactor(F);
    const Number f2         = norm_square(F);
    const Number c0         = f2 * f2 - 4. * norm_square(C);
    const Number det        = F(0, 0) * C(0, 0) + F(0, 1) * C(0, 1) + F(0, 2) * C(0, 2);

    Number l = sqrt(3. * f2);
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        const Number l2    = l * l;
        const Number value = ((l2 - 2. * f2) * l - 8. * det) * l + c0;
        const Number slope = 4. * (l2 - f2) * l - 8. * det;
        const Number step  = value / slope;
        l -= step;
        if (all_of(step * step <= 1e-29 * l2))
          break;
      }

    const Number a       = l * l + f2;
    const Number inverse = 1. / (l * (l * l - f2) - 2. * det);

    const Matrix3<Number> FFtF = F * transposed_product(F, F);
    Matrix3<Number> R;
    for (unsigned int k = 0; k < 9; ++k)
      R.entries[k] = inverse * (a * F.entries[k] + 2. * l * C.entries[k] - 2. * FFtF.entries[k]);
    return R;
  }


  /** The columns of F made orthonormal in their order; the third is the cross product of the first
   * two. */
  template <class Number>
  Matrix3<Number>
  gram_schmidt_rotation(const Matrix3<Number> &F)
  {
    using std::sqrt;
    using std::experimental::sqrt;

    std::array<Number, 3> a{{F(0, 0), F(1, 0), F(2, 0)}}, b{{F(0, 1), F(1, 1), F(2, 1)}};

    const Number a_length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (unsigned int i = 0; i < 3; ++i)
      a[i] /= a_length;

    const Number projection = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    for (unsigned int i = 0; i < 3; ++i)
      b[i] -= projection * a[i];
    const Number b_length = sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    for (unsigned int i = 0; i < 3; ++i)
      b[i] /= b_length;

    Matrix3<Number> R;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        R(i, 0) = a[i];
        R(i, 1) = b[i];
        R(i, 2) = a[i1] * b[i2] - a[i2] * b[i1];
      }
    return R;
  }


  /**
   * A proper rotation about z, for every F. polar: the nearest one to F in the plane, of the angle
   * atan2(F21 - F12, F11 + F22); gram_schmidt: that of the first column of F. The identity where
   * they say nothing (F in the plane is zero or a reflection) or are not finite.
   */
  inline Matrix3<Pack>
  rotation_in_plane(const RotationMethod method, const Matrix3<Pack> &F)
  {
    namespace stdx = std::experimental;

    Matrix3<Pack> R = Matrix3<Pack>::identity();
    if (method == RotationMethod::none)
      return R;
    const bool polar = method == RotationMethod::polar;
    Pack cosine      = polar ? F(0, 0) + F(1, 1) : F(0, 0);
    Pack sine        = polar ? F(1, 0) - F(0, 1) : F(1, 0);

    Pack scale           = stdx::max(stdx::abs(cosine), stdx::abs(sine)); // no over- or underflow
    const auto undefined = !(scale > 0. && cosine - cosine == 0. && sine - sine == 0.);

    stdx::where(undefined, scale)  = 1.;
    stdx::where(undefined, cosine) = 1.;
    stdx::where(undefined, sine)   = 0.;
    cosine /= scale;
    sine /= scale;
    const Pack length = stdx::sqrt(cosine * cosine + sine * sine);

    R(0, 0) = R(1, 1) = cosine / length;
    R(1, 0)           = sine / length;
    R(0, 1)           = -R(1, 0);
    return R;
  }


  /** What is more than this is no rotation. */
  constexpr double largest_orthogonality_defect = 1e-22;


  /** Replaces those lanes of @p R which are no rotation by nearest_rotation(). */
  void
  repair_rotations(const Matrix3<Pack> &F, Matrix3<Pack> &R);


  /** A proper rotation in every lane, for every F. */
  inline Matrix3<Pack>
  rotation(const RotationMethod method, const Matrix3<Pack> &F)
  {
    Matrix3<Pack> R;
    switch (method)
      {
        case RotationMethod::none:
          return Matrix3<Pack>::identity();
        case RotationMethod::gram_schmidt:
          R = gram_schmidt_rotation(F);
          break;
        case RotationMethod::polar:
          R = closed_form_rotation(F);
          break;
      }
    if (!std::experimental::all_of(orthogonality_defect(R) <= largest_orthogonality_defect))
      repair_rotations(F, R);
    return R;
  }
} // namespace Supple

#endif
