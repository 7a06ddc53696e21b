#ifndef supple_tests_displacements_h
#define supple_tests_displacements_h

#include <array>
#include <cmath>

#include "driver/checks.h"

/** u = G x + waves sin(...), by rows of G. */
inline Nodal
wavy_displacement(const std::vector<std::array<double, 3>> &positions,
                  const std::array<double, 9> &G,
                  const double waves)
{
  Nodal u;
  for (const auto &x : positions)
    for (unsigned int i = 0; i < 3; ++i)
      u.push_back(G[3 * i] * x[0] + G[3 * i + 1] * x[1] + G[3 * i + 2] * x[2] +
                  waves * std::sin(3. * x[(i + 1) % 3] + 2. * x[i] + i));
  return u;
}


/** Rotation by an angle about (1, 2, 2)/3 minus the identity, by rows. */
inline std::array<double, 9>
rigid_rotation(const double angle)
{
  const double a[3] = {1. / 3., 2. / 3., 2. / 3.};
  std::array<double, 9> G;
  const double K[9] = {0., -a[2], a[1], a[2], 0., -a[0], -a[1], a[0], 0.};
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      {
        double KK = 0.;
        for (unsigned int k = 0; k < 3; ++k)
          KK += K[3 * i + k] * K[3 * k + j];
        G[3 * i + j] = std::sin(angle) * K[3 * i + j] + (1. - std::cos(angle)) * KK;
      }
  return G;
}

#endif
