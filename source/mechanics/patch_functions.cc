#include <supple/mechanics/patch_functions.h>

#include <cmath>

namespace Supple
{
  namespace
  {
    using Polynomial = std::array<double, 4>; // of the place about the middle of the points


    double
    value(const Polynomial &p, const PatchPoint &point)
    {
      return p[0] + p[1] * point.place[0] + p[2] * point.place[1] + p[3] * point.place[2];
    }


    double
    product(const Polynomial &p, const Polynomial &r, const std::vector<PatchPoint> &points)
    {
      double sum = 0.;
      for (const PatchPoint &point : points)
        sum += point.volume * value(p, point) * value(r, point);
      return sum;
    }


    void
    subtract(Polynomial &p, const double factor, const Polynomial &r)
    {
      for (unsigned int j = 0; j < 4; ++j)
        p[j] -= factor * r[j];
    }
  } // namespace


  LinearFunctions
  orthogonal_functions(const std::vector<PatchPoint> &points)
  {
    std::array<double, 3> middle{};
    double volume = 0.;
    for (const PatchPoint &point : points)
      {
        volume += point.volume;
        for (unsigned int i = 0; i < 3; ++i)
          middle[i] += point.volume * point.place[i];
      }
    std::vector<PatchPoint> about_middle = points;
    for (PatchPoint &point : about_middle)
      for (unsigned int i = 0; i < 3; ++i)
        point.place[i] -= middle[i] / volume;

    LinearFunctions psi{};
    for (unsigned int k = 0; k < 4; ++k)
      {
        psi[k][k] = 1.;
        for (unsigned int round = 0; round < 2; ++round) // the second one for round-off
          for (unsigned int l = 0; l < k; ++l)
            subtract(psi[k], product(psi[k], psi[l], about_middle) / volume, psi[l]);
        const double size = std::sqrt(product(psi[k], psi[k], about_middle) / volume);
        for (double &coefficient : psi[k])
          coefficient /= size;
      }
    for (Polynomial &p : psi)
      for (unsigned int i = 0; i < 3; ++i)
        p[0] -= p[i + 1] * middle[i] / volume;
    return psi;
  }
} // namespace Supple
