#ifndef supple_corotational_h
#define supple_corotational_h

#include <supple/linear_algebra/symmetric_eigen.h>
#include <supple/mechanics/law.h>
#include <supple/mechanics/rotation.h>

namespace Supple
{
  /**
   * Corotational elasticity of n_lanes cells: Hooke's law in the frame that a cell's rotation R
   * carries along (Mueller & Gross 2004; Hauth & Strasser 2004); linear elasticity where R = I.
   *
   *   S = R^T F                             in the cell's rotated frame
   *   e = sym(S) - I                        strain
   *   P = 2 mu e + lambda tr(e) I           stress
   *   W = V (mu e:e + lambda/2 tr(e)^2)     energy
   *   f_a = V R P g_a                       force of node a
   *   K_ab = V (lambda h_a h_b^T + mu h_b h_a^T + mu (h_a.h_b) I),   h_a = R g_a
   *
   * If polar rotations are to follow the displacement (Chao et al. 2010; McAdams et al. 2011), the
   * stress has one more derivative: with the axial vector a = sum_a g_a x R^T du_a of twice the
   * skew part of R^T dF,
   *
   *   dW^2 = (frozen) + V a.H a,  H = mu I - (2 mu - lambda tr(S - I)) (tr(S) I - S)^-1,
   *
   * which acts on skew parts alone, as the frozen part does on symmetric ones: it can be projected
   * to a positive semidefinite H by itself.
   *
   * In an axisymmetric body R turns about z, so that neither F33 nor the direction e_x of its
   * change take part in it; with the hoop's gradient c
   *
   *   K_ab = V (lambda (h_a + c e_x) (h_b + c e_x)^T + mu h_b h_a^T + mu (h_a.h_b) I
   *             + 2 mu c^2 e_x e_x^T).
   */
  struct Corotational
  {
    using Batch     = Cells::Batch;
    using NodalPack = Cells::NodalPack;
    using Vector3   = std::array<Pack, 3>;

    /** What the derivatives of the rotations add to the tangent: V R H R^T. */
    using Turning = Matrix3<Pack>;

    /** A part of the tangent holds the rotation, see LawSweeps. */
    static constexpr bool tangent_is_whole = false;

    RotationMethod method;

    static std::string
    name()
    {
      return "corotational";
    }

    bool
    is_linear() const
    {
      return method == RotationMethod::none;
    }

    /** Gram-Schmidt rotations have none. */
    bool
    has_energy() const
    {
      return method == RotationMethod::none || method == RotationMethod::polar;
    }

    bool
    has_rotations() const
    {
      return method != RotationMethod::none;
    }

    Matrix3<Pack>
    rotation(const Matrix3<Pack> &F) const
    {
      return Supple::rotation(method, F);
    }

    /** About z, of a plane body. */
    Matrix3<Pack>
    rotation_in_plane(const Matrix3<Pack> &F) const
    {
      return Supple::rotation_in_plane(method, F);
    }

    /** P in the rotated frame [Pa]. */
    static Matrix3<Pack>
    stress(const Batch &batch, const Matrix3<Pack> &R, const Matrix3<Pack> &F)
    {
      return hooke(batch, strain(R, F));
    }

    /** The change of P with that of F, R as it is [Pa]. */
    static Matrix3<Pack>
    stress_change(const Batch &batch, const Matrix3<Pack> &R, const Matrix3<Pack> &dF)
    {
      return hooke(batch, rotated_back(R, dF));
    }

    /** W / V [J/m^3] */
    static Pack
    energy_density(const Batch &batch, const Matrix3<Pack> &R, const Matrix3<Pack> &F)
    {
      const Matrix3<Pack> e = strain(R, F);
      const Pack tr         = trace(e);
      return batch.mu * norm_square(e) + 0.5 * batch.lambda * tr * tr;
    }

    /** @param R_of_strain of S in H; R, or an older one
     * @param mean_stress that is not the cell's own, in the measure `trace` [Pa]
     * @param definite  whether H is projected */
    static Turning
    turning(const Batch &batch,
            const Matrix3<Pack> &R,
            const Matrix3<Pack> &R_of_strain,
            const Matrix3<Pack> &F,
            const Pack &mean_stress,
            bool definite);

    /** What the derivatives of the rotations add to the forces when the nodes move by w. */
    static NodalPack
    turning_product(const Turning &RHRt, const NodalPack &h, const NodalPack &w)
    {
      Vector3 turn{{Pack(0.), Pack(0.), Pack(0.)}};
      for (unsigned int a = 0; a < 4; ++a)
        {
          const Vector3 part = cross(h[a], w[a]);
          for (unsigned int i = 0; i < 3; ++i)
            turn[i] += part[i];
        }
      const Vector3 moment = product(RHRt, turn);
      NodalPack f;
      for (unsigned int a = 0; a < 4; ++a)
        f[a] = cross(moment, h[a]);
      return f;
    }

    /** h_a = R g_a */
    static NodalPack
    rotated_gradients(const Batch &batch, const Matrix3<Pack> &R)
    {
      NodalPack h;
      for (unsigned int a = 0; a < 4; ++a)
        h[a] = product(R, batch.gradients[a]);
      return h;
    }

    /** The blocks of the frozen tangent of a batch, times a factor. */
    template <bool axisymmetric>
    struct Blocks
    {
      const NodalPack h;
      NodalPack t; ///< h + c e_x, of the trace of the strain
      const Pack lambda, mu;
      Pack hoop_stiffness = Pack(0.); ///< 2 mu c^2

      Blocks(const Batch &batch,
             const Cells::Hoop *const hoop,
             const NodalPack &rotated_gradients,
             const double factor,
             const double added_bulk)
        : h(rotated_gradients)
        , lambda(factor * batch.volume * (batch.lambda + added_bulk * batch.mu))
        , mu(factor * batch.volume * batch.mu)
      {
        if constexpr (axisymmetric)
          {
            t = h;
            for (unsigned int a = 0; a < 3; ++a)
              t[a][0] += hoop->gradient;
            hoop_stiffness = 2. * mu * hoop->gradient * hoop->gradient;
          }
      }

      /** What stands on the diagonal of the block of nodes a, c beside the mass. */
      Pack
      shear(const unsigned int a, const unsigned int c) const
      {
        return mu * (h[a][0] * h[c][0] + h[a][1] * h[c][1] + h[a][2] * h[c][2]);
      }

      /** Entry (i, j) of the block of nodes a, c, with @p diagonal where i = j. */
      Pack
      entry(const unsigned int a,
            const unsigned int c,
            const unsigned int i,
            const unsigned int j,
            const Pack &diagonal) const
      {
        Pack value = mu * h[c][i] * h[a][j];
        if constexpr (axisymmetric)
          value += lambda * t[a][i] * t[c][j];
        else
          value += lambda * h[a][i] * h[c][j];
        if (i == j)
          value += diagonal;
        return value;
      }
    };

    /** The columns of V [h_a]^T R H R^T [h_c], [h] w = h x w. */
    static std::array<Vector3, 3>
    turning_block(const Turning &RHRt, const Vector3 &h_a, const Vector3 &h_c)
    {
      std::array<Vector3, 3> columns;
      for (unsigned int j = 0; j < 3; ++j)
        {
          Vector3 unit{{Pack(0.), Pack(0.), Pack(0.)}};
          unit[j]    = Pack(1.);
          columns[j] = cross(product(RHRt, cross(h_c, unit)), h_a);
        }
      return columns;
    }

  private:
    static Vector3
    cross(const Vector3 &a, const Vector3 &b)
    {
      return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
    }

    static Vector3
    product(const Matrix3<Pack> &A, const Vector3 &b)
    {
      Vector3 c;
      for (unsigned int i = 0; i < 3; ++i)
        c[i] = A(i, 0) * b[0] + A(i, 1) * b[1] + A(i, 2) * b[2];
      return c;
    }

    /** sym(R^T G) */
    static Matrix3<Pack>
    rotated_back(const Matrix3<Pack> &R, const Matrix3<Pack> &G)
    {
      Matrix3<Pack> S = transposed_product(R, G);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < i; ++j)
          S(i, j) = S(j, i) = 0.5 * (S(i, j) + S(j, i));
      return S;
    }

    /** sym(R^T F) - I */
    static Matrix3<Pack>
    strain(const Matrix3<Pack> &R, const Matrix3<Pack> &F)
    {
      Matrix3<Pack> e = rotated_back(R, F);
      for (unsigned int i = 0; i < 3; ++i)
        e(i, i) -= 1.;
      return e;
    }

    static Matrix3<Pack>
    hooke(const Batch &batch, const Matrix3<Pack> &strain)
    {
      Matrix3<Pack> P;
      for (unsigned int k = 0; k < 9; ++k)
        P.entries[k] = 2. * batch.mu * strain.entries[k];
      const Pack pressure = batch.lambda * trace(strain);
      for (unsigned int i = 0; i < 3; ++i)
        P(i, i) += pressure;
      return P;
    }
  };


  inline Corotational::Turning
  Corotational::turning(const Batch &batch,
                        const Matrix3<Pack> &R,
                        const Matrix3<Pack> &R_of_strain,
                        const Matrix3<Pack> &F,
                        const Pack &mean_stress,
                        const bool definite)
  {
    namespace stdx = std::experimental;

    const Matrix3<Pack> S       = rotated_back(R_of_strain, F);
    const SymmetricEigen eigen  = symmetric_eigen(S);
    const Matrix3<Pack> rotated = R * eigen.vectors;
    const Pack c                = 2. * batch.mu - batch.lambda * (trace(S) - 3.) - mean_stress;

    Turning H{};
    for (unsigned int k = 0; k < 3; ++k)
      {
        // Two stretches that add up to nothing: the rotation about the third axis is not unique.
        Pack sum                     = eigen.values[(k + 1) % 3] + eigen.values[(k + 2) % 3];
        stdx::where(sum < 1e-3, sum) = Pack(1e-3);

        Pack value = batch.mu - c / sum;
        if (definite)
          stdx::where(value < 0., value) = Pack(0.);
        value *= batch.volume;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            H(i, j) += value * rotated(i, k) * rotated(j, k);
      }
    return H;
  }
} // namespace Supple

#endif
