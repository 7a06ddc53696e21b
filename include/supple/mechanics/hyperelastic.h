#ifndef supple_hyperelastic_h
#define supple_hyperelastic_h

#include <supple/linear_algebra/symmetric_eigen.h>
#include <supple/mechanics/cells.h>
#include <supple/mechanics/energies.h>
#include <supple/mechanics/rotation.h>

#include <algorithm>
#include <utility>

namespace Supple
{
  /** d^2 W / dF^2 of n_lanes cells, times their volume [J]: symmetric, of nine rows and columns, of
   * which entry (i, j) of F is number 3 i + j. */
  struct ElasticTangent
  {
    std::array<Pack, 45> entries; ///< by rows up to the diagonal
    Matrix3<Pack> cofactor;       ///< of F, in which volumes change

    static constexpr unsigned int
    place(const unsigned int row, const unsigned int column)
    {
      return row > column ? row * (row + 1) / 2 + column : column * (column + 1) / 2 + row;
    }

    const Pack &
    operator()(const unsigned int row, const unsigned int column) const
    {
      return entries[place(row, column)];
    }

    /** += factor m m^T */
    void
    add_mode(const Pack &factor, const Matrix3<Pack> &m)
    {
      for (unsigned int row = 0, k = 0; row < 9; ++row)
        {
          const Pack scaled = factor * m.entries[row];
          for (unsigned int column = 0; column <= row; ++column, ++k)
            entries[k] += scaled * m.entries[column];
        }
    }

    /** The stress that a change of F causes, times the volume. */
    Matrix3<Pack>
    stress_change(const Matrix3<Pack> &dF) const
    {
      Matrix3<Pack> P;
      for (unsigned int row = 0; row < 9; ++row)
        {
          P.entries[row] = (*this)(row, 0) * dF.entries[0];
          for (unsigned int column = 1; column < 9; ++column)
            P.entries[row] += (*this)(row, column) * dF.entries[column];
        }
      return P;
    }
  };


  /** F = U diag(s) V^T with proper rotations U and V, so that the product of the stretches s is det
   * F (Irving, Teran & Fedkiw 2004). */
  struct SignedStretches
  {
    Matrix3<Pack> U, V;
    std::array<Pack, 3> s;

    explicit SignedStretches(const Matrix3<Pack> &F)
    {
      const Matrix3<Pack> R = rotation(RotationMethod::polar, F);
      Matrix3<Pack> S       = transposed_product(R, F);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < i; ++j)
          S(i, j) = S(j, i) = 0.5 * (S(i, j) + S(j, i));
      const SymmetricEigen eigen = symmetric_eigen(S);
      V                          = eigen.vectors;
      U                          = R * V;
      s                          = eigen.values;
    }

    /** U D V^T with D = diag(d). */
    Matrix3<Pack>
    diagonal_mode(const std::array<Pack, 3> &d) const
    {
      Matrix3<Pack> m;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          m(i, j) = U(i, 0) * d[0] * V(j, 0) + U(i, 1) * d[1] * V(j, 1) + U(i, 2) * d[2] * V(j, 2);
      return m;
    }

    /** U D V^T with D_ab = 1 and D_ba = sign: a turn (-1) or a shear (+1) times sqrt(2). */
    Matrix3<Pack>
    pair_mode(const unsigned int a, const unsigned int b, const double sign) const
    {
      Matrix3<Pack> m;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          m(i, j) = U(i, a) * V(j, b) + sign * U(i, b) * V(j, a);
      return m;
    }

    /** s_a + s_b, not below what keeps the rotation's derivative finite: at zero the rotation about
     * the third axis is not unique. */
    Pack
    sum_of_pair(const unsigned int a, const unsigned int b) const
    {
      Pack sum                                  = s[a] + s[b];
      std::experimental::where(sum < 1e-3, sum) = Pack(1e-3);
      return sum;
    }
  };


  /**
   * An elastic law whose stress is the derivative of an isotropic energy W of the deformation
   * gradient: one of energies.h. Formulas for LawSweeps.
   *
   *   P = dW/dF = 2 W1 F + 2 W2 (I1 F - F F^T F) + W_J cof F + W_S R
   *   K_ab = V g_a . d^2W/dF^2 . g_b
   *
   * No part of the tangent is left when a rotation is held, so that all of it is in Turning: exact,
   * or definite. That one has the eigenvalues of d^2W/dF^2 clamped in the frame of the signed
   * stretches s (Smith, de Goes & Kim 2019), those of turns at zero and those of strains at a small
   * part of mu, so that a body that is held has a positive definite matrix: three of A_ij =
   * d^2W/ds_i ds_j, and for each pair of stretches, k being the third,
   *
   *   turn   (W_i + W_j)/(s_i + s_j) = 2 W1 + 2 W2 (s_k^2 + s_i s_j) + W_J s_k + 2 W_S/(s_i + s_j)
   *   shear  (W_i - W_j)/(s_i - s_j) = 2 W1 + 2 W2 (s_k^2 - s_i s_j) - W_J s_k
   *
   * The mean stress of a patch of cells adds to W_J before they are clamped.
   */
  template <class Energy>
  struct Hyperelastic
  {
    using Batch     = Cells::Batch;
    using NodalPack = Cells::NodalPack;
    using Turning   = ElasticTangent;

    static constexpr bool tangent_is_whole = true;

    /** Of strains in the definite tangent, over mu. */
    static constexpr double least_stiffness = 1e-3;

    Energy energy;

    static std::string
    name()
    {
      return Energy::name;
    }

    static constexpr bool
    is_linear()
    {
      return false;
    }

    static constexpr bool
    has_energy()
    {
      return true;
    }

    /** It has none that is kept. */
    static constexpr bool
    has_rotations()
    {
      return false;
    }

    static Matrix3<Pack>
    rotation(const Matrix3<Pack> &)
    {
      return Matrix3<Pack>::identity();
    }

    static Matrix3<Pack>
    rotation_in_plane(const Matrix3<Pack> &)
    {
      return Matrix3<Pack>::identity();
    }

    /** First Piola-Kirchhoff stress [Pa]. */
    Matrix3<Pack>
    stress(const Batch &batch, const Matrix3<Pack> &, const Matrix3<Pack> &F) const
    {
      const Matrix3<Pack> C     = cofactor(F);
      const Pack I1             = norm_square(F);
      const EnergyDerivatives d = energy.derivatives(batch.lambda, batch.mu, I1, determinant(F, C));
      Matrix3<Pack> P;
      for (unsigned int k = 0; k < 9; ++k)
        P.entries[k] = 2. * d.W1 * F.entries[k] + d.WJ * C.entries[k];
      if constexpr (Energy::depends_on_second_invariant)
        {
          const Matrix3<Pack> FFtF = F * transposed_product(F, F);
          for (unsigned int k = 0; k < 9; ++k)
            P.entries[k] += 2. * d.W2 * (I1 * F.entries[k] - FFtF.entries[k]);
        }
      if constexpr (Energy::has_rotation)
        {
          const Matrix3<Pack> R = turn(F);
          for (unsigned int k = 0; k < 9; ++k)
            P.entries[k] += d.WS * R.entries[k];
        }
      return P;
    }

    /** W [J/m^3] */
    Pack
    energy_density(const Batch &batch, const Matrix3<Pack> &R, const Matrix3<Pack> &F) const
    {
      return energy.density(batch.lambda, batch.mu, Energy::has_rotation ? turn(F) : R, F);
    }

    /** How a cell has turned, for those who look at it. */
    static Matrix3<Pack>
    turn(const Matrix3<Pack> &F)
    {
      return Supple::rotation(RotationMethod::polar, F);
    }

    /** P F^T / J [Pa]; of flat cells with a J of 0.001 or -0.001. */
    Matrix3<Pack>
    cauchy_stress(const Batch &batch, const Matrix3<Pack> &F) const
    {
      namespace stdx                 = std::experimental;
      const Matrix3<Pack> P          = stress(batch, F, F);
      const Pack J                   = determinant(F);
      Pack size                      = stdx::abs(J);
      stdx::where(size < 1e-3, size) = Pack(1e-3);
      stdx::where(J < 0., size)      = -size;
      Matrix3<Pack> T;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          T(i, j) = (P(i, 0) * F(j, 0) + P(i, 1) * F(j, 1) + P(i, 2) * F(j, 2)) / size;
      return T;
    }

    /** The second derivative. @param mean_stress of a patch [Pa], that is no stress of the cell
     * @param definite whether its eigenvalues are clamped */
    ElasticTangent
    turning(const Batch &batch,
            const Matrix3<Pack> &,
            const Matrix3<Pack> &,
            const Matrix3<Pack> &F,
            const Pack &mean_stress,
            const bool definite) const
    {
      ElasticTangent K;
      K.cofactor = cofactor(F);
      for (Pack &entry : K.entries)
        entry = Pack(0.);
      EnergyDerivatives d =
        energy.derivatives(batch.lambda, batch.mu, norm_square(F), determinant(F, K.cofactor));
      d.WJ += mean_stress;
      if (definite)
        add_clamped(d, least_stiffness * batch.mu, F, K);
      else
        add_exact(d, F, K);
      for (Pack &entry : K.entries)
        entry *= batch.volume;
      return K;
    }

    /** The blocks of a batch's tangent times a factor, from products with the gradients. */
    template <bool axisymmetric>
    struct Blocks
    {
      const NodalPack h;
      Pack hoop = Pack(0.);
      std::array<std::array<std::array<Pack, 3>, 9>, 4> half; ///< d^2W/dF^2 . g_c
      const Pack hoop_stiffness = Pack(0.);                   ///< is in the entries

      /** @param added_bulk this many shear moduli are added to the bulk modulus */
      Blocks(const ElasticTangent &tangent,
             const Batch &batch,
             const Cells::Hoop *const hoop_of_batch,
             const double factor,
             const double added_bulk)
        : h(batch.gradients)
      {
        if (added_bulk != 0.)
          {
            ElasticTangent stiffer = tangent;
            stiffer.add_mode(added_bulk * batch.volume * batch.mu, tangent.cofactor);
            set_half(stiffer, hoop_of_batch, factor);
          }
        else
          set_half(tangent, hoop_of_batch, factor);
      }

      void
      set_half(const ElasticTangent &K, const Cells::Hoop *const hoop_of_batch, const double factor)
      {
        if constexpr (axisymmetric)
          hoop = hoop_of_batch->gradient;
        for (unsigned int c = 0; c < 4; ++c)
          for (unsigned int row = 0; row < 9; ++row)
            for (unsigned int j = 0; j < 3; ++j)
              {
                Pack sum = K(row, 3 * j) * h[c][0] + K(row, 3 * j + 1) * h[c][1] +
                           K(row, 3 * j + 2) * h[c][2];
                if (axisymmetric && j == 0 && c < 3)
                  sum += K(row, 8) * hoop;
                half[c][row][j] = factor * sum;
              }
      }

      static Pack
      shear(unsigned int, unsigned int)
      {
        return Pack(0.);
      }

      /** Entry (i, j) of the block of nodes a, c, with @p diagonal where i = j. */
      Pack
      entry(const unsigned int a,
            const unsigned int c,
            const unsigned int i,
            const unsigned int j,
            const Pack &diagonal) const
      {
        Pack value = h[a][0] * half[c][3 * i][j] + h[a][1] * half[c][3 * i + 1][j] +
                     h[a][2] * half[c][3 * i + 2][j];
        if (axisymmetric && i == 0 && a < 3)
          value += hoop * half[c][8][j];
        if (i == j)
          value += diagonal;
        return value;
      }
    };

  private:
    static Pack
    determinant(const Matrix3<Pack> &F, const Matrix3<Pack> &C)
    {
      return F(0, 0) * C(0, 0) + F(0, 1) * C(0, 1) + F(0, 2) * C(0, 2);
    }

    static Pack
    determinant(const Matrix3<Pack> &F)
    {
      return Supple::determinant(F);
    }

    static void
    add_exact(const EnergyDerivatives &d, const Matrix3<Pack> &F, ElasticTangent &K)
    {
      for (unsigned int k = 0; k < 9; ++k)
        K.entries[ElasticTangent::place(k, k)] += 2. * d.W1;
      K.add_mode(d.WJJ, K.cofactor);
      K.add_mode(4. * d.W11 + 4. * d.W2, F);
      add_second_derivative_of_determinant(d.WJ, F, K);
      if constexpr (Energy::depends_on_second_invariant)
        add_rest_of_second_invariant(d.W2, F, K);
      if constexpr (Energy::has_rotation)
        {
          const SignedStretches stretches(F);
          for (unsigned int k = 0; k < 3; ++k)
            {
              const unsigned int a = (k + 1) % 3, b = (k + 2) % 3;
              K.add_mode(d.WS / stretches.sum_of_pair(a, b), stretches.pair_mode(a, b, -1.));
            }
        }
    }

    /** d^2 J / dF_ij dF_kl = e_ikm e_jln F_mn */
    static void
    add_second_derivative_of_determinant(const Pack &factor,
                                         const Matrix3<Pack> &F,
                                         ElasticTangent &K)
    {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int l = 0; l < 3; ++l)
            if (l != j)
              {
                const unsigned int k = (i + 1) % 3, m = (i + 2) % 3, n = 3 - j - l;
                const double sign = l == (j + 1) % 3 ? 1. : -1.;
                K.entries[ElasticTangent::place(3 * i + j, 3 * k + l)] += sign * factor * F(m, n);
              }
    }

    /** What is not 4 F F^T of the second derivative of I2 = (I1^2 - |F^T F|^2)/2. */
    static void
    add_rest_of_second_invariant(const Pack &factor, const Matrix3<Pack> &F, ElasticTangent &K)
    {
      const Pack I1           = norm_square(F);
      const Matrix3<Pack> FtF = transposed_product(F, F);
      Matrix3<Pack> FFt;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          FFt(i, j) = F(i, 0) * F(j, 0) + F(i, 1) * F(j, 1) + F(i, 2) * F(j, 2);
      for (unsigned int row = 0, place = 0; row < 9; ++row)
        for (unsigned int column = 0; column <= row; ++column, ++place)
          {
            const unsigned int i = row / 3, j = row % 3, k = column / 3, l = column % 3;
            Pack sum = -F(i, l) * F(k, j);
            if (row == column)
              sum += I1;
            if (i == k)
              sum -= FtF(j, l);
            if (j == l)
              sum -= FFt(i, k);
            K.entries[place] += 2. * factor * sum;
          }
    }

    /** @param least of strains; turns may have none */
    static void
    add_clamped(const EnergyDerivatives &d,
                const Pack &least,
                const Matrix3<Pack> &F,
                ElasticTangent &K)
    {
      const Pack none(0.);
      const SignedStretches stretches(F);
      const std::array<Pack, 3> &s = stretches.s;
      Matrix3<Pack> A;
      for (unsigned int k = 0; k < 3; ++k)
        {
          const unsigned int i = (k + 1) % 3, j = (k + 2) % 3;
          const Pack C_k = s[i] * s[j];
          A(k, k) = 2. * d.W1 + 2. * d.W2 * (s[i] * s[i] + s[j] * s[j]) + 4. * d.W11 * s[k] * s[k] +
                    d.WJJ * C_k * C_k;
          A(i, j) = A(j, i) =
            4. * (d.W2 + d.W11) * s[i] * s[j] + d.WJ * s[k] + d.WJJ * s[k] * s[k] * s[i] * s[j];
          const Pack common = 2. * d.W1 + 2. * d.W2 * s[k] * s[k];
          const Pack mixed  = 2. * d.W2 * s[i] * s[j] + d.WJ * s[k];
          Pack turn         = common + mixed;
          if constexpr (Energy::has_rotation)
            turn += 2. * d.WS / stretches.sum_of_pair(i, j);
          using std::experimental::max;
          K.add_mode(0.5 * max(turn, none), stretches.pair_mode(i, j, -1.));
          K.add_mode(0.5 * max(common - mixed, least), stretches.pair_mode(i, j, 1.));
        }
      const SymmetricEigen eigen = symmetric_eigen(A);
      for (unsigned int k = 0; k < 3; ++k)
        K.add_mode(std::experimental::max(eigen.values[k], least),
                   stretches.diagonal_mode(
                     {{eigen.vectors(0, k), eigen.vectors(1, k), eigen.vectors(2, k)}}));
    }
  };
} // namespace Supple

#endif
