#include <supple/observe/recovery.h>

#include <supple/mechanics/quadratic_cells.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Supple
{
  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;


    /** With fewer cells around it a site takes the polynomials of its neighbours. */
    unsigned int
    least_cells(const unsigned int n_nodes)
    {
      return n_nodes == 4 ? 8 : 4;
    }


    /**
     * Solves the normal equations A x = b of three slopes, by L D L^T; x takes the place of b. In a
     * direction in which all points are at the same place there is no slope. @param A its lower
     * half, row by row; positive semidefinite
     */
    void
    solve(const std::array<double, 6> &A, std::array<Octet, 3> &x)
    {
      constexpr double flat = 1e-10; // of the trace
      const double least    = flat * (A[0] + A[2] + A[5]);
      double L[3][3]{}, D[3], inverse[3];
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int i = k; i < 3; ++i)
          {
            double entry = A[i * (i + 1) / 2 + k];
            for (unsigned int j = 0; j < k; ++j)
              entry -= L[i][j] * L[k][j] * D[j];
            if (i == k)
              {
                D[k]       = entry > least ? entry : 0.;
                inverse[k] = D[k] > 0. ? 1. / D[k] : 0.;
              }
            else
              L[i][k] = entry * inverse[k];
          }
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int j = 0; j < k; ++j)
          x[k].lanes -= L[k][j] * x[j].lanes;
      for (unsigned int k = 3; k-- > 0;)
        {
          x[k].lanes *= inverse[k];
          for (unsigned int i = k + 1; i < 3; ++i)
            x[k].lanes -= L[i][k] * x[i].lanes;
        }
    }
  } // namespace


  Recovery::Recovery(const Body &body)
    : body(body)
    , halo(body.partitioner, 3)
    , n_nodes(body.cells->n_nodes)
    , n_points(body.cells->n_points())
  {
    place_points();
    find_materials();
    find_sites();
    find_poor_sites();
  }


  double
  Recovery::volume(const std::size_t cell) const
  {
    double sum = points[n_points * cell].volume;
    for (unsigned int q = 1; q < n_points; ++q)
      sum += points[n_points * cell + q].volume;
    return sum;
  }


  std::array<unsigned int, 4>
  Recovery::corners(const std::size_t cell) const
  {
    if (n_points == 1)
      return body.cell_nodes[cell];
    const Cells::TenNodes &nodes = body.cells->nodes_of(cell / n_lanes);
    std::array<unsigned int, 4> list;
    for (unsigned int v = 0; v < 4; ++v)
      list[v] = nodes[Quadratic::node[v][v]][cell % n_lanes];
    return list;
  }


  void
  Recovery::place_points()
  {
    points.resize(n_points * body.cell_nodes.size());
    const Cells &cells = *body.cells;
    if (cells.is_quadratic())
      return place_quadratic_points();
    for (std::size_t b = 0; b < cells.n_batches(); ++b)
      cells.for_lanes(b, [&](const unsigned int lane, const std::size_t c) {
        points[c].volume = cells.batch(b).volume[lane];
      });
    for (std::size_t c = 0; c < points.size(); ++c)
      {
        Place sum{};
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int i = 0; i < 3; ++i)
            sum[i] += body.positions[body.cell_nodes[c][a]][i];
        for (unsigned int i = 0; i < 3; ++i)
          points[c].place[i] = sum[i] / n_nodes;
      }
  }


  void
  Recovery::place_quadratic_points()
  {
    const Cells &cells = *body.cells;
    for (std::size_t b = 0; b < cells.n_batches(); ++b)
      for (unsigned int q = 0; q < n_points; ++q)
        {
          const Pack volume = cells.point(b, q).volume;
          cells.for_lanes(b, [&](const unsigned int lane, const std::size_t c) {
            Point &point = points[n_points * c + q];
            point.volume = volume[lane];
            point.place  = cells.place_of_point(c, q);
          });
        }
  }


  void
  Recovery::find_materials()
  {
    if (body.mesh.materials.size() == 1)
      {
        materials.assign(body.n_local, body.mesh.materials.begin()->first);
        return;
      }
    std::vector<std::vector<unsigned int>> list(body.n_owned);
    for (std::size_t c = 0; c < body.cell_nodes.size(); ++c)
      for (unsigned int a = 0; a < n_nodes; ++a)
        if (const unsigned int node = body.cell_nodes[c][a]; node < body.n_owned)
          list[node].push_back(body.cell_material[c]);
    unsigned int most = 1;
    for (auto &ids : list)
      {
        std::sort(ids.begin(), ids.end());
        ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
        most = std::max<unsigned int>(most, ids.size());
      }
    n_slots = dealii::Utilities::MPI::max(most, body.mesh.communicator);
    materials.assign(std::size_t(n_slots) * body.n_local, none);
    for (unsigned int node = 0; node < body.n_owned; ++node)
      std::copy(list[node].begin(), list[node].end(), &materials[std::size_t(n_slots) * node]);
    halo.update(reinterpret_cast<char *>(materials.data()), n_slots * sizeof(unsigned int));
  }


  std::size_t
  Recovery::site_of(const unsigned int node, const unsigned int material) const
  {
    std::size_t site = std::size_t(n_slots) * node;
    while (n_slots > 1 && materials[site] != material)
      ++site;
    return site;
  }


  void
  Recovery::find_sites()
  {
    sites_of_cells.resize(body.cell_nodes.size());
    start.assign(materials.size() + 1, 0);
    for (std::size_t c = 0; c < body.cell_nodes.size(); ++c)
      {
        const std::array<unsigned int, 4> vertices = corners(c);
        for (unsigned int a = 0; a < n_nodes; ++a)
          {
            sites_of_cells[c][a] = site_of(vertices[a], body.cell_material[c]);
            ++start[sites_of_cells[c][a] + 1];
          }
      }
    for (std::size_t site = 1; site < start.size(); ++site)
      start[site] += start[site - 1];
    cells_around.resize(start.back());
    std::vector<std::size_t> end(start.begin(), start.end() - 1);
    for (std::size_t c = 0; c < body.cell_nodes.size(); ++c)
      for (unsigned int a = 0; a < n_nodes; ++a)
        cells_around[end[sites_of_cells[c][a]]++] = c;
  }


  void
  Recovery::find_poor_sites()
  {
    std::vector<unsigned int> n_cells(materials.size());
    for (std::size_t site = 0; site < n_cells.size(); ++site)
      n_cells[site] = start[site + 1] - start[site];
    halo.update(reinterpret_cast<char *>(n_cells.data()), n_slots * sizeof(unsigned int));

    std::vector<unsigned int> known(materials.size());
    for (std::size_t site = 0; site < known.size(); ++site)
      known[site] = n_cells[site] >= least_cells(n_nodes);
    start_of_neighbours.push_back(0);
    for (bool more = true; more;)
      {
        const std::size_t before = poor.size();
        find_poor_sites_beside(known);
        more = dealii::Utilities::MPI::max(poor.size() - before, body.mesh.communicator) > 0;
        if (more)
          end_of_round.push_back(poor.size());
        for (std::size_t number = before; number < poor.size(); ++number)
          known[poor[number]] = 1;
        halo.update(reinterpret_cast<char *>(known.data()), n_slots * sizeof(unsigned int));
      }
    bool here = true;
    for (std::size_t site = 0; site < std::size_t(n_slots) * body.n_owned; ++site)
      here = here && (known[site] || start[site + 1] == start[site]);
    everywhere = dealii::Utilities::MPI::min(here ? 1 : 0, body.mesh.communicator) == 1;
  }


  bool
  Recovery::is_rough() const
  {
    std::vector<double> here(2), all(2); // sites, and those with too few cells
    for (std::size_t site = 0; site < std::size_t(n_slots) * body.n_owned; ++site)
      if (const std::size_t n_cells = start[site + 1] - start[site]; n_cells > 0)
        {
          ++here[0];
          here[1] += n_cells < least_cells(n_nodes);
        }
    dealii::Utilities::MPI::sum(here, body.mesh.communicator, all);
    return all[1] > (n_nodes == 4 ? 0.5 : 0.75) * all[0];
  }


  void
  Recovery::find_poor_sites_beside(const std::vector<unsigned int> &known)
  {
    for (std::size_t site = 0; site < std::size_t(n_slots) * body.n_owned; ++site)
      {
        if (known[site])
          continue;
        for (std::size_t k = start[site]; k < start[site + 1]; ++k)
          for (unsigned int a = 0; a < n_nodes; ++a)
            if (const auto near = sites_of_cells[cells_around[k]][a]; known[near])
              neighbours.push_back(near);
        const auto first = neighbours.begin() + start_of_neighbours.back();
        std::sort(first, neighbours.end());
        neighbours.erase(std::unique(first, neighbours.end()), neighbours.end());
        if (neighbours.size() == start_of_neighbours.back())
          continue;
        poor.push_back(site);
        start_of_neighbours.push_back(neighbours.size());
      }
  }


  Recovery::Fit
  Recovery::fit(const std::size_t site, const std::vector<Octet> &of_points) const
  {
    const Place &vertex = body.positions[site / n_slots];
    Fit fit{};
    double volume = 0.;
    Place first{};
    std::array<double, 6> second{};
    const auto add = [&](const std::size_t p) {
      const Point &point       = points[p];
      const Lanes<double, 6> x = point.volume * of_points[p].lanes;
      volume += point.volume;
      fit.value.lanes += x;
      for (unsigned int i = 0, ij = 0; i < 3; ++i)
        {
          const double arm = point.place[i] - vertex[i];
          fit.slopes[i].lanes += arm * x;
          first[i] += point.volume * arm;
          for (unsigned int j = 0; j <= i; ++j, ++ij)
            second[ij] += point.volume * arm * (point.place[j] - vertex[j]);
        }
    };
    for (std::size_t k = start[site]; k < start[site + 1]; ++k)
      for (unsigned int q = 0; q < n_points; ++q)
        add(std::size_t(n_points) * cells_around[k] + q);
    // About the centroid of all, where mean and slopes do not know of each other.
    fit.value.lanes /= volume;
    for (unsigned int i = 0, ij = 0; i < 3; ++i)
      {
        fit.slopes[i].lanes -= first[i] * fit.value.lanes;
        for (unsigned int j = 0; j <= i; ++j, ++ij)
          second[ij] -= first[i] * first[j] / volume;
      }
    solve(second, fit.slopes);
    for (unsigned int i = 0; i < 3; ++i)
      fit.value.lanes -= first[i] / volume * fit.slopes[i].lanes;
    return fit;
  }


  Recovery::Fit
  Recovery::mean_of_neighbours(const std::size_t number, const std::vector<Fit> &fits) const
  {
    const Place &vertex     = body.positions[poor[number] / n_slots];
    const std::size_t begin = start_of_neighbours[number], end = start_of_neighbours[number + 1];
    const double share = 1. / (end - begin);
    Fit mean{};
    for (std::size_t k = begin; k < end; ++k)
      {
        const Fit &near    = fits[neighbours[k]];
        const Place &place = body.positions[neighbours[k] / n_slots];
        mean.value.lanes += share * near.value.lanes;
        for (unsigned int i = 0; i < 3; ++i)
          {
            mean.value.lanes += share * (vertex[i] - place[i]) * near.slopes[i].lanes;
            mean.slopes[i].lanes += share * near.slopes[i].lanes;
          }
      }
    return mean;
  }


  Recovery::Field
  Recovery::recover(std::vector<Octet> of_points) const
  {
    std::vector<Fit> fits(materials.size());
    for (std::size_t site = 0; site < std::size_t(n_slots) * body.n_owned; ++site)
      if (start[site + 1] > start[site])
        fits[site] = fit(site, of_points);
    std::size_t number = 0;
    for (const std::size_t end : end_of_round)
      {
        halo.update(reinterpret_cast<char *>(fits.data()), n_slots * sizeof(Fit));
        for (; number < end; ++number)
          fits[poor[number]] = mean_of_neighbours(number, fits);
      }
    halo.update(reinterpret_cast<char *>(fits.data()), n_slots * sizeof(Fit));
    return {std::move(of_points), std::move(fits)};
  }


  Recovery::NodalOctets
  Recovery::differences(const Field &x, const std::size_t cell) const
  {
    if (n_points > 1)
      return quadratic_differences(x, cell);
    NodalOctets d{};
    for (unsigned int a = 0; a < n_nodes; ++a)
      d[a].lanes = x.of_sites[sites_of_cells[cell][a]].value.lanes - x.of_points[cell].lanes;
    return d;
  }


  Recovery::NodalOctets
  Recovery::quadratic_differences(const Field &x, const std::size_t cell) const
  {
    // x at corner v is that of the points times (delta_vq - b)/(a - b), with a - b = c.
    constexpr double c = Quadratic::c, b = 0.25 * (1. - c);
    std::array<Octet, 4> at_corners;
    Octet sum{};
    for (unsigned int q = 0; q < 4; ++q)
      sum.lanes += x.of_points[4 * cell + q].lanes;
    for (unsigned int v = 0; v < 4; ++v)
      at_corners[v].lanes = (x.of_points[4 * cell + v].lanes - b * sum.lanes) / c;

    const auto &sites            = sites_of_cells[cell];
    const Cells::TenNodes &nodes = body.cells->nodes_of(cell / n_lanes);
    const auto value             = [&](const std::size_t site, const Place &place) {
      const Fit &fit      = x.of_sites[site];
      const Place &vertex = body.positions[site / n_slots];
      Octet value         = fit.value;
      for (unsigned int i = 0; i < 3; ++i)
        value.lanes += (place[i] - vertex[i]) * fit.slopes[i].lanes;
      return value;
    };
    NodalOctets d{};
    for (unsigned int a = 0; a < Quadratic::n_nodes; ++a)
      {
        const unsigned int v = Quadratic::corners[a][0], w = Quadratic::corners[a][1];
        const Place &place = body.positions[nodes[a][cell % n_lanes]];
        d[a].lanes         = 0.5 * (value(sites[v], place).lanes - at_corners[v].lanes) +
                     0.5 * (value(sites[w], place).lanes - at_corners[w].lanes);
      }
    return d;
  }


  std::array<double, 3>
  Recovery::nodal_radii(const std::size_t cell) const
  {
    std::array<double, 3> radii;
    for (unsigned int a = 0; a < 3; ++a)
      radii[a] = body.positions[body.cell_nodes[cell][a]][0] / points[cell].place[0];
    return radii;
  }


  /** The integral of N_a N_c is (1 + delta_ac) V/20 in a tetrahedron, V/12 in a triangle, and all
   * around an axis (3 + r_a/r + r_c/r)/5 times that. */
  Octet
  Recovery::product(const Field &x, const Field &y, const std::size_t cell) const
  {
    const NodalOctets d = differences(x, cell), e = differences(y, cell);
    if (n_points > 1)
      return quadratic_product(d, e, cell);
    const double share = volume(cell) / (n_nodes * (n_nodes + 1));
    Octet sum{}, all_d{}, all_e{};
    for (unsigned int a = 0; a < n_nodes; ++a)
      {
        all_d.lanes += d[a].lanes;
        all_e.lanes += e[a].lanes;
      }
    if (!body.mesh.section.axisymmetric())
      {
        sum.lanes = all_d.lanes * all_e.lanes;
        for (unsigned int a = 0; a < n_nodes; ++a)
          sum.lanes += d[a].lanes * e[a].lanes;
        sum.lanes *= share;
        return sum;
      }
    const std::array<double, 3> r = nodal_radii(cell);
    sum.lanes                     = 3. * all_d.lanes * all_e.lanes;
    for (unsigned int a = 0; a < n_nodes; ++a)
      sum.lanes += (3. + 2. * r[a]) * d[a].lanes * e[a].lanes +
                   r[a] * (d[a].lanes * all_e.lanes + all_d.lanes * e[a].lanes);
    sum.lanes *= 0.2 * share;
    return sum;
  }


  Octet
  Recovery::quadratic_product(const NodalOctets &d,
                              const NodalOctets &e,
                              const std::size_t cell) const
  {
    Octet sum{};
    for (unsigned int a = 0; a < Quadratic::n_nodes; ++a)
      {
        Octet row{};
        for (unsigned int c = 0; c < Quadratic::n_nodes; ++c)
          row.lanes += Quadratic::product(a, c) * e[c].lanes;
        sum.lanes += d[a].lanes * row.lanes;
      }
    sum.lanes *= volume(cell);
    return sum;
  }


  Octet
  Recovery::difference_at(const Field &x, const std::size_t cell, const unsigned int point) const
  {
    const NodalOctets d = differences(x, cell);
    Octet mean{};
    if (n_points > 1)
      {
        for (unsigned int a = 0; a < Quadratic::n_nodes; ++a)
          mean.lanes += Quadratic::value(a, point) * d[a].lanes;
        return mean;
      }
    if (!body.mesh.section.axisymmetric())
      {
        for (unsigned int a = 0; a < n_nodes; ++a)
          mean.lanes += d[a].lanes;
        mean.lanes /= n_nodes;
        return mean;
      }
    const std::array<double, 3> r = nodal_radii(cell);
    for (unsigned int a = 0; a < 3; ++a)
      mean.lanes += (3. + r[a]) / 12. * d[a].lanes;
    return mean;
  }
} // namespace Supple
