#include <supple/mechanics/cells.h>

#include <supple/base/memory.h>
#include <supple/mechanics/quadratic_cells.h>
#include <supple/mesh/serial_mesh.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  namespace stdx = std::experimental;

  namespace
  {
    using Vector3 = std::array<double, 3>;

    Vector3
    difference(const Vector3 &a, const Vector3 &b)
    {
      return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
    }

    Vector3
    cross(const Vector3 &a, const Vector3 &b)
    {
      return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
    }


    /** Gradients of the four linear shape functions; returns the volume. */
    double
    shape_gradients(const std::array<Vector3, 4> &X, std::array<Vector3, 4> &g)
    {
      const Vector3 d1 = difference(X[1], X[0]), d2 = difference(X[2], X[0]),
                    d3 = difference(X[3], X[0]);

      g[1] = cross(d2, d3);
      g[2] = cross(d3, d1);
      g[3] = cross(d1, d2);

      const double six_volumes = d1[0] * g[1][0] + d1[1] * g[1][1] + d1[2] * g[1][2];
      for (unsigned int i = 0; i < 3; ++i)
        {
          g[0][i] = 0.;
          for (unsigned int a = 1; a < 4; ++a)
            {
              g[a][i] /= six_volumes;
              g[0][i] -= g[a][i];
            }
        }
      return six_volumes / 6.;
    }


    /** The same for the three of a triangle in the plane z = 0; returns the area. */
    double
    shape_gradients_in_plane(const std::array<Vector3, 4> &X, std::array<Vector3, 4> &g)
    {
      const Vector3 d1 = difference(X[1], X[0]), d2 = difference(X[2], X[0]);
      const double two_areas = d1[0] * d2[1] - d1[1] * d2[0];

      g[1] = {{d2[1] / two_areas, -d2[0] / two_areas, 0.}};
      g[2] = {{-d1[1] / two_areas, d1[0] / two_areas, 0.}};
      g[0] = {{-g[1][0] - g[2][0], -g[1][1] - g[2][1], 0.}};
      g[3] = {{0., 0., 0.}};
      return two_areas / 2.;
    }
  } // namespace


  Cells::Cells(const std::vector<std::array<double, 3>> &positions,
               const unsigned int n_owned,
               const std::vector<Cell> &cells,
               const bool lumped_mass,
               const double vertex_mass,
               const Section &section,
               const unsigned int n_threads,
               const bool quadratic)
    : n_cells(cells.size())
    , n_owned(n_owned)
    , vertex_mass(vertex_mass)
    , section(section)
    , n_nodes(section.plane() ? 3 : 4)
    , lumped_mass(lumped_mass)
    , pair_share(1. / (n_nodes * (n_nodes + 1)))
    , positions(positions)
  {
    // Empty lanes: zero volume, node 0.
    resize_in_huge_pages(batches, (cells.size() + n_lanes - 1) / n_lanes);
    if (section.axisymmetric())
      hoops.resize(batches.size());
    if (quadratic)
      resize_in_huge_pages(ten_nodes, batches.size());
    for (std::size_t c = 0; c < n_cells; ++c)
      add_cell(c, cells[c]);
    if (quadratic && any_is_curved())
      find_curved_points();
    cut_into_chunks(n_threads);
  }


  void
  Cells::cut_into_chunks(const unsigned int n_threads)
  {
    chunk_start = {0, batches.size()};
    for (std::size_t n_chunks = 2 * n_threads; n_chunks > 2; n_chunks -= 2)
      {
        chunk_start.clear();
        for (std::size_t chunk = 0; chunk <= n_chunks; ++chunk)
          chunk_start.push_back(chunk * batches.size() / n_chunks);
        if (chunks_are_apart())
          return;
      }
    chunk_start = {0, batches.size()};
  }


  bool
  Cells::chunks_are_apart() const
  {
    constexpr std::size_t none = -1;
    std::array<std::vector<std::size_t>, 2> chunk_of_node; // of even and of odd number
    chunk_of_node.fill(std::vector<std::size_t>(positions.size(), none));
    for (std::size_t chunk = 0; chunk + 1 < chunk_start.size(); ++chunk)
      for (std::size_t b = chunk_start[chunk]; b < chunk_start[chunk + 1]; ++b)
        for (const auto &nodes_of_lanes : batches[b].nodes)
          for (const std::uint32_t node : nodes_of_lanes) // of empty lanes too: zero is added there
            {
              std::size_t &known = chunk_of_node[chunk % 2][node];
              if (known != none && known != chunk)
                return false;
              known = chunk;
            }
    return true;
  }


  void
  Cells::add_cell(const std::size_t number, const Cell &cell)
  {
    Batch &batch            = batches[number / n_lanes];
    const unsigned int lane = number % n_lanes;

    std::array<Vector3, 4> X, g;
    for (unsigned int a = 0; a < n_nodes; ++a)
      X[a] = positions[cell.nodes[a]];
    if (section.plane())
      {
        const double centroid = (X[0][0] + X[1][0] + X[2][0]) / 3.;
        batch.volume[lane]    = shape_gradients_in_plane(X, g) * section.thickness_at(centroid);
      }
    else
      batch.volume[lane] = shape_gradients(X, g);

    const IsotropicMaterial material = effective(cell.material, section);
    batch.lambda[lane]               = material.lambda;
    batch.mu[lane]                   = material.mu;
    batch.density[lane]              = material.density;
    batch.owned[lane]                = cell.owned ? 1. : 0.;

    // Nodes in ascending order: then each pair lies below the diagonal of the matrix.
    const auto number_of = [&](const unsigned int a) {
      return a < n_nodes ? cell.nodes[a] : dealii::numbers::invalid_unsigned_int;
    };
    std::array<unsigned int, 4> order = {{0, 1, 2, 3}};
    std::sort(order.begin(), order.end(), [&](const unsigned int a, const unsigned int b) {
      return number_of(a) < number_of(b);
    });
    for (unsigned int a = 0; a < 4; ++a)
      {
        // The fourth node of a triangle: somewhere to read zero times a number from.
        batch.nodes[a][lane] = cell.nodes[order[std::min(a, n_nodes - 1)]];
        for (unsigned int i = 0; i < 3; ++i)
          batch.gradients[a][i][lane] = g[order[a]][i];
      }
    if (section.axisymmetric())
      {
        const double radius                    = (X[0][0] + X[1][0] + X[2][0]) / 3.;
        hoops[number / n_lanes].gradient[lane] = 1. / (3. * radius);
        for (unsigned int a = 0; a < 3; ++a)
          hoops[number / n_lanes].nodal_radius[a][lane] = X[order[a]][0] / radius;
      }
    if (is_quadratic())
      add_middles(number, cell, order);
  }


  void
  Cells::add_middles(const std::size_t number,
                     const Cell &cell,
                     const std::array<unsigned int, 4> &order)
  {
    std::array<std::array<unsigned int, 4>, 4> edge{};
    for (unsigned int e = 0; e < tetrahedron_edges.size(); ++e)
      {
        const auto &[v, w] = tetrahedron_edges[e];
        edge[v][w] = edge[w][v] = e;
      }
    TenNodes &nodes = ten_nodes[number / n_lanes];
    for (unsigned int a = 0; a < Quadratic::n_nodes; ++a)
      {
        const unsigned int v = order[Quadratic::corners[a][0]], w = order[Quadratic::corners[a][1]];
        nodes[a][number % n_lanes] = v == w ? cell.nodes[v] : cell.middles[edge[v][w]];
      }
  }


  std::array<double, 3>
  Cells::place_of_point(const std::size_t cell, const unsigned int q) const
  {
    std::array<double, 3> place{};
    for (unsigned int a = 0; a < Quadratic::n_nodes; ++a)
      for (unsigned int i = 0; i < 3; ++i)
        place[i] +=
          Quadratic::value(a, q) * positions[ten_nodes[cell / n_lanes][a][cell % n_lanes]][i];
    return place;
  }


  bool
  Cells::any_is_curved() const
  {
    constexpr double round_off = 1e-9; // of the edge
    for (std::size_t c = 0; c < n_cells; ++c)
      for (unsigned int a = 0; a < Quadratic::n_nodes; ++a)
        {
          const TenNodes &nodes = ten_nodes[c / n_lanes];
          const auto place      = [&](const unsigned int node) {
            return positions[nodes[node][c % n_lanes]];
          };
          const Vector3 v = place(
                          Quadratic::node[Quadratic::corners[a][0]][Quadratic::corners[a][0]]),
                        w = place(
                          Quadratic::node[Quadratic::corners[a][1]][Quadratic::corners[a][1]]),
                        x = place(a);
          double off = 0., length = 0.;
          for (unsigned int i = 0; i < 3; ++i)
            {
              off    = std::max(off, std::abs(x[i] - 0.5 * (v[i] + w[i])));
              length = std::max(length, std::abs(v[i] - w[i]));
            }
          if (off > round_off * length)
            return true;
        }
    return false;
  }


  void
  Cells::find_curved_points()
  {
    resize_in_huge_pages(curved, batches.size());
    for (std::size_t c = 0; c < n_cells; ++c)
      {
        const std::size_t b     = c / n_lanes;
        const unsigned int lane = c % n_lanes;
        std::array<Vector3, Quadratic::n_nodes> X;
        for (unsigned int a = 0; a < Quadratic::n_nodes; ++a)
          X[a] = positions[ten_nodes[b][a][lane]];
        const auto corners      = Quadratic::at_points(X);
        batches[b].volume[lane] = 0.;
        for (unsigned int q = 0; q < Quadratic::n_points; ++q)
          {
            std::array<Vector3, 4> g;
            // Corners that are sorted may be a mirrored cell.
            const double weight       = 0.25 * std::abs(shape_gradients(corners[q], g));
            curved[b][q].weight[lane] = weight;
            batches[b].volume[lane] += weight;
            for (unsigned int k = 0; k < 4; ++k)
              for (unsigned int i = 0; i < 3; ++i)
                curved[b][q].gradients[k][i][lane] = g[k][i];
          }
      }
  }


  Cells::NodalPack
  Cells::integral(const std::size_t b,
                  const Pack &weight,
                  const bool lumped,
                  const NodalPack &values) const
  {
    const Pack share    = weight * pair_share;
    const double fourth = n_nodes == 4 ? 1. : 0.; // a triangle has no such node
    NodalPack integrals;
    for (unsigned int i = 0; i < 3; ++i)
      if (lumped)
        for (unsigned int a = 0; a < 4; ++a)
          integrals[a][i] = nodal_share(b, a) * weight * values[a][i];
      else if (hoops.empty())
        {
          const Pack sum = values[0][i] + values[1][i] + values[2][i] + fourth * values[3][i];
          for (unsigned int a = 0; a < 4; ++a)
            integrals[a][i] = share * (sum + values[a][i]);
        }
      else
        {
          const auto &r       = hoops[b].nodal_radius;
          const Pack sum      = values[0][i] + values[1][i] + values[2][i];
          const Pack weighted = r[0] * values[0][i] + r[1] * values[1][i] + r[2] * values[2][i];
          for (unsigned int a = 0; a < 4; ++a)
            integrals[a][i] =
              0.2 * share * ((3. + r[a]) * sum + weighted + (3. + 2. * r[a]) * values[a][i]);
        }
    for (unsigned int i = 0; i < 3; ++i)
      integrals[3][i] *= fourth;
    return integrals;
  }


  double
  Cells::share_of_pair(const unsigned int a, const unsigned int c) const
  {
    if (!lumped_mass)
      return Quadratic::product(a, c);
    return a == c ? Quadratic::share(a, true) : 0.;
  }


  Pack
  Cells::vertex_mass_entry(const std::size_t b, const bool diagonal) const
  {
    // Consistent: that of linear cells. Lumped: s_v + 3 s_e/4 and s_e/4 with the shares of vertices
    // and middles.
    const double share = lumped_mass ? (diagonal ? 5. / 36. : 1. / 27.) : (diagonal ? 0.1 : 0.05);
    return share * batches[b].density * batches[b].volume;
  }


  Cells::NodalPack
  Cells::mass_product(const std::size_t b, const NodalPack &values) const
  {
    return integral(b, batches[b].density * batches[b].volume, lumped_mass, values);
  }


  void
  Cells::add_mass_product(const double *w, double *y) const
  {
    if (is_quadratic())
      for_batches_in_turn([&](const std::size_t b) {
        const Pack mass = batches[b].density * batches[b].volume;
        Quadratic::scatter(ten_nodes[b],
                           Quadratic::mass_product(mass,
                                                   lumped_mass,
                                                   Quadratic::gather(ten_nodes[b], w)),
                           y);
      });
    else
      for_batches_in_turn([&](const std::size_t b) {
        scatter(batches[b], mass_product(b, gather(batches[b], w)), y);
      });
    if (vertex_mass > 0.)
      for (std::size_t dof = 0; dof < 3 * positions.size(); ++dof)
        y[dof] += vertex_mass * w[dof];
  }


  void
  Cells::add_load(const double *force_density, double *force) const
  {
    for (std::size_t b = 0; b < batches.size(); ++b)
      if (is_quadratic())
        Quadratic::scatter(ten_nodes[b],
                           Quadratic::mass_product(batches[b].volume,
                                                   false,
                                                   Quadratic::gather(ten_nodes[b], force_density)),
                           force);
      else
        scatter(batches[b],
                integral(b, batches[b].volume, false, gather(batches[b], force_density)),
                force);
  }


  void
  Cells::add_nodal_mass(double *mass) const
  {
    for (std::size_t b = 0; b < batches.size(); ++b)
      for (unsigned int a = 0; a < (is_quadratic() ? Quadratic::n_nodes : n_nodes); ++a)
        {
          const Pack part =
            is_quadratic() ? Pack(Quadratic::share(a, lumped_mass)) : nodal_share(b, a);
          const Pack share  = part * batches[b].density * batches[b].volume;
          const auto &nodes = is_quadratic() ? ten_nodes[b][a] : batches[b].nodes[a];
          for (unsigned int lane = 0; lane < n_lanes; ++lane)
            mass[nodes[lane]] += share[lane];
        }
    for (std::size_t node = 0; node < positions.size(); ++node)
      mass[node] += vertex_mass;
  }


  namespace
  {
    /** M += what a batch adds at these places. */
    template <class Slot, class Entry>
    void
    add_entries(const Slot &slot, const Entry &entry, std::vector<double> &to)
    {
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        to[slot[lane]] += entry[lane];
    }
  } // namespace


  void
  Cells::add_mass(const CellSlots &slots, SymmetricScalarMatrix &M) const
  {
    for (std::size_t b = 0; b < batches.size(); ++b)
      if (is_quadratic())
        {
          const CellSlots::QuadraticPlaces &places = slots.quadratic(b);
          for (unsigned int a = 0, p = 0; a < Quadratic::n_nodes; ++a)
            {
              add_entries(places.diagonal[a], mass_entry(b, a, a), M.diagonal);
              for (unsigned int c = 0; c < a; ++c, ++p)
                add_entries(places.lower[p], mass_entry(b, a, c), M.lower);
            }
        }
      else
        {
          for (unsigned int a = 0; a < 4; ++a)
            add_entries(slots.diagonal(b)[a], mass_entry(b, a, a), M.diagonal);
          for (unsigned int p = 0; p < 6; ++p)
            {
              const auto &[row, column] = CellSlots::lower_pairs[p];
              add_entries(slots.lower(b)[p], mass_entry(b, row, column), M.lower);
            }
        }
    for (unsigned int node = 0; node < n_owned; ++node)
      M.diagonal[node] += vertex_mass;
  }


  MotionSums
  Cells::motion(const double *displacement, const double *velocity, const double *momentum) const
  {
    MotionSums sums;
    for (std::size_t node = 0; node < n_owned; ++node)
      {
        Vector3 x, p;
        for (unsigned int i = 0; i < 3; ++i)
          {
            const std::size_t dof = 3 * node + i;
            x[i]                  = positions[node][i] + displacement[dof];
            p[i]                  = momentum[dof];
            sums.kinetic += 0.5 * p[i] * velocity[dof];
            sums.linear_momentum[i] += p[i];
          }
        const Vector3 angular = cross(x, p);
        for (unsigned int i = 0; i < 3; ++i)
          sums.angular_momentum[i] += angular[i];
      }
    if (section.axisymmetric())
      {
        sums.linear_momentum[0] = 0.;
        sums.angular_momentum   = {{0., 0., 0.}};
      }
    return sums;
  }


  CellSlots::CellSlots(const Cells &cells, const SymmetricPattern &pattern)
  {
    if (cells.is_quadratic())
      find_quadratic_places(cells, pattern);
    else
      find_places(cells,
                  pattern,
                  [&](const std::size_t b, const unsigned int a, const unsigned int lane) {
                    return cells.batch(b).nodes[a][lane];
                  });
  }


  CellSlots::CellSlots(const Cells &cells,
                       const SymmetricPattern &pattern,
                       const std::vector<std::uint32_t> &vertex)
  {
    find_places(cells,
                pattern,
                [&](const std::size_t b, const unsigned int a, const unsigned int lane) {
                  return vertex[cells.batch(b).nodes[a][lane]];
                });
  }


  template <class Number>
  void
  CellSlots::find_places(const Cells &cells, const SymmetricPattern &pattern, const Number &number)
  {
    resize_in_huge_pages(places, cells.n_batches());
    const std::vector<std::size_t> &chunk_starts = cells.chunk_starts();
    std::size_t chunk                            = 0;
    for (std::size_t b = 0; b < places.size(); ++b)
      for (unsigned int lane = 0; lane < n_lanes; ++lane)
        {
          while (b >= chunk_starts[chunk + 1])
            ++chunk;
          const std::size_t spare = chunk / 2; // that of its thread
          const bool empty        = b * n_lanes + lane >= cells.n_cells;
          const auto node         = [&](const unsigned int a) { return number(b, a, lane); };
          const auto exists = [&](const unsigned int a) { return !empty && a < cells.n_nodes; };
          for (unsigned int a = 0; a < 4; ++a)
            places[b].diagonal[a][lane] =
              exists(a) && node(a) < pattern.n_owned ? node(a) : pattern.n_owned + spare;
          for (unsigned int p = 0; p < 6; ++p)
            places[b].lower[p][lane] =
              exists(lower_pairs[p][0])
                ? place_of_pair(pattern, node(lower_pairs[p][0]), node(lower_pairs[p][1]), spare)
                : pattern.n_entries() + spare;
        }
  }


  std::uint32_t
  CellSlots::place_of_pair(const SymmetricPattern &pattern,
                           const std::uint32_t node,
                           const std::uint32_t other,
                           const std::size_t spare)
  {
    const std::size_t place = pattern.position(std::max(node, other), std::min(node, other));
    return place == pattern.n_entries() ? place + spare : place;
  }


  void
  CellSlots::find_quadratic_places(const Cells &cells, const SymmetricPattern &pattern)
  {
    static_assert(n_lanes <= 8, "a bit for each lane");
    resize_in_huge_pages(quadratic_places, cells.n_batches());
    const std::vector<std::size_t> &chunk_starts = cells.chunk_starts();
    std::size_t chunk                            = 0;
    for (std::size_t b = 0; b < quadratic_places.size(); ++b)
      {
        while (b >= chunk_starts[chunk + 1])
          ++chunk;
        const std::size_t spare = chunk / 2; // that of its thread
        QuadraticPlaces &of     = quadratic_places[b];
        of.transposed.fill(0);
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            const bool empty = b * n_lanes + lane >= cells.n_cells;
            const auto node  = [&](const unsigned int a) { return cells.nodes_of(b)[a][lane]; };
            for (unsigned int a = 0, p = 0; a < Quadratic::n_nodes; ++a)
              {
                of.diagonal[a][lane] =
                  !empty && node(a) < pattern.n_owned ? node(a) : pattern.n_owned + spare;
                for (unsigned int c = 0; c < a; ++c, ++p)
                  {
                    of.lower[p][lane] = empty ? pattern.n_entries() + spare
                                              : place_of_pair(pattern, node(a), node(c), spare);
                    if (!empty && node(a) < node(c))
                      of.transposed[p] |= 1u << lane;
                  }
              }
          }
      }
  }
} // namespace Supple
