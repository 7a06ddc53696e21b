#ifndef supple_quadratic_cells_h
#define supple_quadratic_cells_h

#include <supple/mechanics/cells.h>

#include <array>

namespace Supple
{
  /**
   * Quadratic tetrahedra: displacements of degree two in a cell, by ten nodes, each at the middle
   * of two corners v <= w, which are the same for a corner itself:
   *
   *   N_vv = L_v (2 L_v - 1),   N_vw = 4 L_v L_w,   nodes v0 e01 e02 e03 v1 e12 e13 v2 e23 v3,
   *
   * and four points q, at which L_q = a and the other L = b, of the same weight (Hammer and Stroud
   * 1956; exact to degree two):
   *
   *            3
   *           /|\          a = (1 + 3 c)/4,  b = (1 - c)/4,  c = 1/sqrt(5)
   *          e | e
   *         /  e  \        At a point the gradient of a field x is that of a linear cell with the
   *        0-e-|-e-2       corner values
   *         \  |  /
   *          e | e           W_k(q) = sum_a dN_a/dL_k x_a
   *           \|/                   = -c x_kk + (1 - c) sum_(w != k) x_kw + 4 c x_kq,
   *            1
   *                        sum_k W_k(q) g_k^T. So each point is a linear cell, by the formulas of
   * one, and what comes of it at four corners goes to the ten nodes by the transpose.
   */
  namespace Quadratic
  {
    constexpr unsigned int n_nodes = 10, n_points = 4;

    /** The corners of the edge of each node. */
    constexpr std::array<std::array<unsigned int, 2>, n_nodes> corners = {{{{0, 0}},
                                                                           {{0, 1}},
                                                                           {{0, 2}},
                                                                           {{0, 3}},
                                                                           {{1, 1}},
                                                                           {{1, 2}},
                                                                           {{1, 3}},
                                                                           {{2, 2}},
                                                                           {{2, 3}},
                                                                           {{3, 3}}}};

    /** The node of each pair of corners. */
    constexpr std::array<std::array<unsigned int, 4>, 4> node = {
      {{{0, 1, 2, 3}}, {{1, 4, 5, 6}}, {{2, 5, 7, 8}}, {{3, 6, 8, 9}}}};

    constexpr double c = 0.44721359549995794; ///< 1/sqrt(5)

    constexpr bool
    is_corner(const unsigned int a)
    {
      return corners[a][0] == corners[a][1];
    }

    /** The derivative of N_a by L_k at a point. */
    constexpr double
    slope(const unsigned int a, const unsigned int k, const unsigned int point)
    {
      const unsigned int v = corners[a][0], w = corners[a][1];
      if (v != k && w != k)
        return 0.;
      const unsigned int other = v == k ? w : v;
      return (is_corner(a) ? -c : 1. - c) + (other == point ? 4. * c : 0.);
    }

    /** N_a at a point. */
    constexpr double
    value(const unsigned int a, const unsigned int point)
    {
      const unsigned int v = corners[a][0], w = corners[a][1];
      const double L_v = 0.25 * (v == point ? 1. + 3. * c : 1. - c);
      const double L_w = 0.25 * (w == point ? 1. + 3. * c : 1. - c);
      return is_corner(a) ? L_v * (2. * L_v - 1.) : 4. * L_v * L_w;
    }

    /** The integral of N_a N_b over a cell of volume one. */
    constexpr double
    product(const unsigned int a, const unsigned int b)
    {
      if (a == b)
        return is_corner(a) ? 1. / 70. : 8. / 105.;
      unsigned int n_shared = 0; // corners of one edge that are on the other
      for (const unsigned int v : corners[a])
        n_shared += v == corners[b][0] || v == corners[b][1];
      if (is_corner(a) && is_corner(b))
        return 1. / 420.;
      if (is_corner(a) || is_corner(b))
        return n_shared > 0 ? -1. / 105. : -1. / 70.;
      return n_shared > 0 ? 4. / 105. : 2. / 105.;
    }

    /** What a node has of a cell's mass: row sums of the consistent mass matrix, or its diagonal
     * scaled to the whole mass (Hinton, Rock and Zienkiewicz 1976), which is positive. */
    constexpr double
    share(const unsigned int a, const bool lumped)
    {
      if (lumped)
        return is_corner(a) ? 1. / 36. : 4. / 27.;
      return is_corner(a) ? -1. / 20. : 1. / 5.;
    }

    /** A vector at each of the ten nodes. */
    using NodalPack = std::array<std::array<Pack, 3>, n_nodes>;

    /** A vector at the four corners of each point. */
    using PointValues = std::array<Cells::NodalPack, n_points>;


    inline NodalPack
    gather(const Cells::TenNodes &nodes, const double *nodal)
    {
      NodalPack values;
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          alignas(64) double buffer[3][n_lanes];
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            for (unsigned int i = 0; i < 3; ++i)
              buffer[i][lane] = nodal[3 * static_cast<std::size_t>(nodes[a][lane]) + i];
          for (unsigned int i = 0; i < 3; ++i)
            values[a][i].copy_from(buffer[i], std::experimental::vector_aligned);
        }
      return values;
    }


    /** Adds the values to those of the nodes, or subtracts them (sign = -1). */
    template <int sign = 1>
    inline void
    scatter(const Cells::TenNodes &nodes, const NodalPack &values, double *nodal)
    {
      static_assert(sign == 1 || sign == -1, "values are added or subtracted");
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          alignas(64) double buffer[3][n_lanes];
          for (unsigned int i = 0; i < 3; ++i)
            values[a][i].copy_to(buffer[i], std::experimental::vector_aligned);
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            for (unsigned int i = 0; i < 3; ++i)
              nodal[3 * static_cast<std::size_t>(nodes[a][lane]) + i] += sign * buffer[i][lane];
        }
    }


    /** W_k(q) of nodal values, which may be numbers or packs of them. */
    template <class Number>
    inline std::array<std::array<std::array<Number, 3>, 4>, n_points>
    at_points(const std::array<std::array<Number, 3>, n_nodes> &x)
    {
      std::array<std::array<std::array<Number, 3>, 4>, n_points> W;
      for (unsigned int k = 0; k < 4; ++k)
        for (unsigned int i = 0; i < 3; ++i)
          {
            Number others =
              x[node[k][(k + 1) % 4]][i] + x[node[k][(k + 2) % 4]][i] + x[node[k][(k + 3) % 4]][i];
            const Number base = (1. - c) * others - c * x[node[k][k]][i];
            for (unsigned int q = 0; q < n_points; ++q)
              W[q][k][i] = base + 4. * c * x[node[k][q]][i];
          }
      return W;
    }


    /** The gradient of a field at a point, by its corner values there. */
    inline Matrix3<Pack>
    gradient(const Cells::Batch &point, const Cells::NodalPack &W)
    {
      Matrix3<Pack> G;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          G(i, j) = W[0][i] * point.gradients[0][j] + W[1][i] * point.gradients[1][j] +
                    W[2][i] * point.gradients[2][j] + W[3][i] * point.gradients[3][j];
      return G;
    }


    /** factor P g_k at the corners of a point. */
    inline Cells::NodalPack
    divergence(const Cells::Batch &point, const Matrix3<Pack> &P, const Pack &factor)
    {
      const auto &g = point.gradients;
      Cells::NodalPack f;
      for (unsigned int k = 0; k < 4; ++k)
        for (unsigned int i = 0; i < 3; ++i)
          f[k][i] = factor * (P(i, 0) * g[k][0] + P(i, 1) * g[k][1] + P(i, 2) * g[k][2]);
      return f;
    }


    /** What forces on the corners of one point are on the nodes. */
    inline NodalPack
    to_nodes(const Cells::NodalPack &f, const unsigned int point)
    {
      NodalPack values;
      for (unsigned int a = 0; a < n_nodes; ++a)
        {
          const unsigned int v = corners[a][0], w = corners[a][1];
          for (unsigned int i = 0; i < 3; ++i)
            {
              values[a][i] = slope(a, v, point) * f[v][i];
              if (v != w)
                values[a][i] += slope(a, w, point) * f[w][i];
            }
        }
      return values;
    }


    /** The transpose of at_points(): what forces on the corners of all points are on the nodes. */
    inline NodalPack
    to_nodes(const PointValues &f)
    {
      NodalPack values;
      for (unsigned int i = 0; i < 3; ++i)
        {
          std::array<Pack, 4> sum;
          for (unsigned int k = 0; k < 4; ++k)
            sum[k] = f[0][k][i] + f[1][k][i] + f[2][k][i] + f[3][k][i];
          for (unsigned int a = 0; a < n_nodes; ++a)
            {
              const unsigned int v = corners[a][0], w = corners[a][1];
              if (v == w)
                values[a][i] = 4. * c * f[v][v][i] - c * sum[v];
              else
                values[a][i] = (1. - c) * (sum[v] + sum[w]) + 4. * c * (f[w][v][i] + f[v][w][i]);
            }
        }
      return values;
    }


    /** The gradients of a field at the points of a batch of quadratic cells. */
    std::array<Matrix3<Pack>, n_points>
    gradients(const Cells &cells, std::size_t batch, const double *nodal);


    /** F at the points of a batch of quadratic cells. */
    std::array<Matrix3<Pack>, n_points>
    deformation_gradients(const Cells &cells, std::size_t batch, const double *displacement);


    /** The mass matrix of a batch times nodal values. */
    NodalPack
    mass_product(const Pack &mass, bool lumped, const NodalPack &values);
  } // namespace Quadratic


  /** The gradients of a field at the points of a batch of cells, linear or quadratic. */
  std::vector<Matrix3<Pack>>
  gradients_at_points(const Cells &cells, std::size_t batch, const double *nodal);


  /** The same of the deformed place, F. */
  std::vector<Matrix3<Pack>>
  deformation_gradients_at_points(const Cells &cells,
                                  std::size_t batch,
                                  const double *displacement);
} // namespace Supple

#endif
