#ifndef supple_energies_h
#define supple_energies_h

#include <supple/linear_algebra/matrix3.h>
#include <supple/mechanics/law_choice.h>

namespace Supple
{
  /**
   * The derivatives of an energy W(I1, I2, J, tr S) for each volume at rest [Pa], with
   *
   *   I1 = |F|^2,  I2 = |cof F|^2,  J = det F,  S = R^T F (R the rotation nearest to F).
   *
   * Those that are not here are zero in all laws below. Every term is finite for every F: nothing
   * is divided by J or by a stretch, so that no law needs an extension where cells are flat or
   * inside out.
   */
  struct EnergyDerivatives
  {
    Pack W1  = Pack(0.); ///< by I1
    Pack W2  = Pack(0.); ///< by I2
    Pack WJ  = Pack(0.); ///< by J
    Pack WS  = Pack(0.); ///< by tr S
    Pack W11 = Pack(0.); ///< twice by I1
    Pack WJJ = Pack(0.); ///< twice by J
  };


  /** How far the invariants of F are from those of I, with all digits where F is near I. */
  struct Excess
  {
    Pack J;              ///< J - 1
    Pack I1;             ///< I1 - 3
    Pack shear1, shear2; ///< I1 - 3 - 2 (J - 1), I2 - 3 - 4 (J - 1): of second order about F = I

    explicit Excess(const Matrix3<Pack> &F)
    {
      Matrix3<Pack> H = F;
      for (unsigned int i = 0; i < 3; ++i)
        H(i, i) -= 1.;
      const Matrix3<Pack> cof = cofactor(H);
      const Pack det          = determinant(H);
      const Pack second       = trace(cof);
      Matrix3<Pack> D         = cof; // cof F - I
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          D(i, j) -= H(j, i);
      for (unsigned int i = 0; i < 3; ++i)
        D(i, i) += trace(H);
      J      = trace(H) + second + det;
      I1     = 2. * trace(H) + norm_square(H);
      shear1 = norm_square(H) - 2. * (second + det);
      shear2 = norm_square(D) - 2. * second - 4. * det;
    }
  };


  /** |S - I|^2, S = R^T F. */
  inline Pack
  square_of_stretches(const Matrix3<Pack> &R, const Matrix3<Pack> &F)
  {
    Matrix3<Pack> S = transposed_product(R, F);
    for (unsigned int i = 0; i < 3; ++i)
      S(i, i) -= 1.;
    return norm_square(S);
  }


  /**
   * W = mu |S - I|^2 + lambda/2 (J - 1)^2  (Stomakhin, Howes, Schroeder & Teran 2012).
   *
   * As all structs below: lambda and mu are those of linear elasticity at rest; volume_term() is k
   * in the part k/2 (J - 1)^2 of W.
   */
  struct FixedCorotated
  {
    static constexpr const char *name                 = "fixed corotated";
    static constexpr bool has_rotation                = true;
    static constexpr bool depends_on_second_invariant = false;

    explicit FixedCorotated(const LawChoice &)
    {
    }

    template <class Number>
    Number
    volume_term(const Number &lambda, const Number &) const
    {
      return lambda;
    }

    EnergyDerivatives
    derivatives(const Pack &lambda, const Pack &mu, const Pack &, const Pack &J) const
    {
      EnergyDerivatives d;
      d.W1  = mu;
      d.WS  = -2. * mu;
      d.WJ  = lambda * (J - 1.);
      d.WJJ = lambda;
      return d;
    }

    Pack
    density(const Pack &lambda,
            const Pack &mu,
            const Matrix3<Pack> &R,
            const Matrix3<Pack> &F) const
    {
      const Excess excess(F);
      return mu * square_of_stretches(R, F) + 0.5 * lambda * excess.J * excess.J;
    }
  };


  /** W = mu/2 (I1 - 3) - mu (J - 1) + k/2 (J - 1)^2,  k = lambda + mu  (Ogden 1984; the volume term
   * is finite for every J). */
  struct NeoHookean
  {
    static constexpr const char *name                 = "neo-hookean";
    static constexpr bool has_rotation                = false;
    static constexpr bool depends_on_second_invariant = false;

    explicit NeoHookean(const LawChoice &)
    {
    }

    template <class Number>
    Number
    volume_term(const Number &lambda, const Number &mu) const
    {
      return lambda + mu;
    }

    EnergyDerivatives
    derivatives(const Pack &lambda, const Pack &mu, const Pack &, const Pack &J) const
    {
      EnergyDerivatives d;
      d.W1  = 0.5 * mu;
      d.WJJ = volume_term(lambda, mu);
      d.WJ  = d.WJJ * (J - 1.) - mu;
      return d;
    }

    Pack
    density(const Pack &lambda, const Pack &mu, const Matrix3<Pack> &, const Matrix3<Pack> &F) const
    {
      const Excess excess(F);
      return 0.5 * mu * excess.shear1 + 0.5 * volume_term(lambda, mu) * excess.J * excess.J;
    }
  };


  /**
   * W = m/2 (I1 - 3) - m/2 log((I1 + 1)/4) - 3/4 m (J - 1) + k/2 (J - 1)^2,  m = 4/3 mu,
   * k = lambda + 5/6 mu  (Smith, de Goes & Kim 2018, with their constants such that small strains
   * are those of Hooke's law).
   */
  struct StableNeoHookean
  {
    static constexpr const char *name                 = "stable neo-hookean";
    static constexpr bool has_rotation                = false;
    static constexpr bool depends_on_second_invariant = false;

    explicit StableNeoHookean(const LawChoice &)
    {
    }

    template <class Number>
    Number
    volume_term(const Number &lambda, const Number &mu) const
    {
      return lambda + 5. / 6. * mu;
    }

    EnergyDerivatives
    derivatives(const Pack &lambda, const Pack &mu, const Pack &I1, const Pack &J) const
    {
      const Pack m = 4. / 3. * mu, inverse = 1. / (I1 + 1.);
      EnergyDerivatives d;
      d.W1  = 0.5 * m * (1. - inverse);
      d.W11 = 0.5 * m * inverse * inverse;
      d.WJJ = volume_term(lambda, mu);
      d.WJ  = d.WJJ * (J - 1.) - 0.75 * m;
      return d;
    }

    Pack
    density(const Pack &lambda, const Pack &mu, const Matrix3<Pack> &, const Matrix3<Pack> &F) const
    {
      const Excess excess(F);
      return 2. / 3. * mu * (0.75 * excess.shear1 + rest_of_logarithm(0.25 * excess.I1)) +
             0.5 * volume_term(lambda, mu) * excess.J * excess.J;
    }

  private:
    /** x - log(1 + x), by its series where it is small. */
    static Pack
    rest_of_logarithm(const Pack &x)
    {
      namespace stdx = std::experimental;
      Pack rest      = x - stdx::log(1. + x);
      const Pack series =
        x * x *
        (0.5 - x * (1. / 3. - x * (0.25 - x * (0.2 - x * (1. / 6. - x * (1. / 7. - 0.125 * x))))));
      stdx::where(stdx::abs(x) < 1e-2, rest) = series;
      return rest;
    }
  };


  /** W = c1 (I1 - 3) + c2 (I2 - 3) - 2 (c1 + 2 c2) (J - 1) + k/2 (J - 1)^2,  mu = 2 (c1 + c2),
   * k = lambda + 2 c1  (Mooney 1940, Rivlin 1948; Ciarlet & Geymonat 1982 for compressible bodies).
   */
  struct MooneyRivlin
  {
    static constexpr const char *name                 = "mooney-rivlin";
    static constexpr bool has_rotation                = false;
    static constexpr bool depends_on_second_invariant = true;

    explicit MooneyRivlin(const LawChoice &choice)
      : share(1. / (1. + choice.mooney_ratio))
    {
    }

    template <class Number>
    Number
    volume_term(const Number &lambda, const Number &mu) const
    {
      return lambda + share * mu;
    }

    EnergyDerivatives
    derivatives(const Pack &lambda, const Pack &mu, const Pack &, const Pack &J) const
    {
      EnergyDerivatives d;
      d.W1  = 0.5 * share * mu;
      d.W2  = 0.5 * (1. - share) * mu;
      d.WJJ = volume_term(lambda, mu);
      d.WJ  = d.WJJ * (J - 1.) - 2. * (d.W1 + 2. * d.W2);
      return d;
    }

    Pack
    density(const Pack &lambda, const Pack &mu, const Matrix3<Pack> &, const Matrix3<Pack> &F) const
    {
      const Excess excess(F);
      return 0.5 * mu * (share * excess.shear1 + (1. - share) * excess.shear2) +
             0.5 * volume_term(lambda, mu) * excess.J * excess.J;
    }

  private:
    const double share; ///< c1 / (c1 + c2)
  };


  /**
   * W = mu E:E + lambda/2 tr(E)^2,  E = (F^T F - I)/2. A cell that is crushed offers ever less
   * resistance, and none when it is flat. By invariants tr E = (I1 - 3)/2 and E:E = (I1^2 - 2 I2 -
   * 2 I1 + 3)/4. In place of k/2 (J - 1)^2 it has k/2 tr(E)^2.
   */
  struct SaintVenantKirchhoff
  {
    static constexpr const char *name                 = "st venant-kirchhoff";
    static constexpr bool has_rotation                = false;
    static constexpr bool depends_on_second_invariant = true;

    explicit SaintVenantKirchhoff(const LawChoice &)
    {
    }

    template <class Number>
    Number
    volume_term(const Number &lambda, const Number &mu) const
    {
      return lambda + 2. / 3. * mu;
    }

    EnergyDerivatives
    derivatives(const Pack &lambda, const Pack &mu, const Pack &I1, const Pack &) const
    {
      EnergyDerivatives d;
      d.W1  = 0.5 * mu * (I1 - 1.) + 0.25 * lambda * (I1 - 3.);
      d.W2  = -0.5 * mu;
      d.W11 = 0.5 * mu + 0.25 * lambda;
      return d;
    }

    Pack
    density(const Pack &lambda, const Pack &mu, const Matrix3<Pack> &, const Matrix3<Pack> &F) const
    {
      Matrix3<Pack> H = F;
      for (unsigned int i = 0; i < 3; ++i)
        H(i, i) -= 1.;
      Matrix3<Pack> E = transposed_product(H, H);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          E(i, j) = 0.5 * (E(i, j) + H(i, j) + H(j, i));
      const Pack tr = trace(E);
      return mu * norm_square(E) + 0.5 * lambda * tr * tr;
    }
  };
} // namespace Supple

#endif
