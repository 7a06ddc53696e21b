#include <supple/mechanics/volumetric_patches.h>

#include <supple/mechanics/patch_functions.h>

#include <algorithm>
#include <limits>

namespace Supple
{
  VolumetricPatches::VolumetricPatches(
    const Cells &cells,
    const std::vector<PatchCell> &list,
    const unsigned int n_owned,
    const VolumeMeasure measure,
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner)
    : measure(measure)
    , partitioner(partitioner)
    , cells(cells)
    , n_owned(n_owned)
    , n_points(cells.n_points())
    , n_functions(cells.is_quadratic() ? 4 : 1)
  {
    find_nodes(list);
    bulk.resize(start.size() - 1, 1.);
    volume.resize(start.size() - 1);
    constant.resize(start.size() - 1);
    change.reinit(partitioner);

    const std::vector<double> rest(3 * (1 + *std::max_element(node.begin(), node.end())));
    find_volume_changes(cells, {}, measure, rest.data(), changes);
    for (std::size_t c = 0; c < list.size(); ++c)
      for (unsigned int k = 0; k < n_functions; ++k)
        {
          bulk[patch_of[c] + k] = list[c].bulk;
          for (unsigned int q = 0; q < n_points; ++q)
            volume[patch_of[c] + k] += changes.volume[n_points * c + q];
        }
    if (n_functions > 1)
      find_functions();
    update({}, rest.data());
  }


  std::vector<unsigned int>
  VolumetricPatches::nodes_of(const PatchCell &cell, const std::size_t number) const
  {
    std::vector<unsigned int> nodes = cell.nodes;
    std::sort(nodes.begin(), nodes.end());
    if (cells.is_quadratic())
      for (const auto &lanes : cells.nodes_of(number / n_lanes))
        nodes.push_back(lanes[number % n_lanes]);
    if (nodes.size() == 3) // a triangle's fourth adds nothing
      nodes.push_back(nodes.back());
    return nodes;
  }


  void
  VolumetricPatches::find_nodes(const std::vector<PatchCell> &list)
  {
    const std::size_t n_all = n_own() + partitioner->n_ghost_indices(); // functions
    std::vector<std::vector<unsigned int>> nodes_of_patch(n_all);
    for (std::size_t c = 0; c < list.size(); ++c)
      {
        patch_of.push_back(partitioner->global_to_local(n_functions * list[c].patch));
        const std::vector<unsigned int> nodes = nodes_of(list[c], c);
        for (unsigned int k = 0; k < n_functions; ++k)
          {
            auto &all = nodes_of_patch[patch_of.back() + k];
            all.insert(all.end(), nodes.begin(), nodes.end());
          }
      }
    start.push_back(0);
    for (auto &nodes : nodes_of_patch)
      {
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        node.insert(node.end(), nodes.begin(), nodes.end());
        start.push_back(node.size());
      }
    gradient.resize(node.size());

    for (std::size_t c = 0; c < list.size(); ++c)
      {
        const auto begin = node.begin() + start[patch_of[c]];
        const auto end   = node.begin() + start[patch_of[c] + 1];
        for (const unsigned int of_cell : nodes_of(list[c], c))
          places.push_back(std::lower_bound(begin, end, of_cell) - node.begin());
      }
  }


  /** The owner of a patch, who has all of its cells, makes 1, x, y, z orthogonal in turn; others
   * learn the coefficients. */
  void
  VolumetricPatches::find_functions()
  {
    std::vector<std::vector<PatchPoint>> of_patches(n_own() / n_functions);
    for (std::size_t point = 0; point < changes.volume.size(); ++point)
      if (const unsigned int first = patch_of[point / n_points]; first < n_own())
        of_patches[first / n_functions].push_back(
          {cells.place_of_point(point / n_points, point % n_points), changes.volume[point]});

    std::array<Vector, 4> coefficients; // of 1, x, y, z
    for (Vector &of_functions : coefficients)
      of_functions.reinit(partitioner);
    for (unsigned int patch = 0; patch < of_patches.size(); ++patch)
      {
        const LinearFunctions made = orthogonal_functions(of_patches[patch]);
        for (unsigned int k = 0; k < n_functions; ++k)
          for (unsigned int j = 0; j < 4; ++j)
            coefficients[j].local_element(n_functions * patch + k) = made[k][j];
      }

    const GhostValues one(coefficients[0]), x(coefficients[1]), y(coefficients[2]),
      z(coefficients[3]);
    for (std::size_t point = 0; point < changes.volume.size(); ++point)
      {
        const auto place = cells.place_of_point(point / n_points, point % n_points);
        for (unsigned int m = patch_of[point / n_points], k = 0; k < n_functions; ++k, ++m)
          functions.push_back(one.data()[m] + x.data()[m] * place[0] + y.data()[m] * place[1] +
                              z.data()[m] * place[2]);
      }
  }


  void
  VolumetricPatches::update(const CellRotations::List &rotations, const double *displacement)
  {
    find_volume_changes(cells, rotations, measure, displacement, changes);
    std::fill(gradient.begin(), gradient.end(), std::array<double, 3>{});
    std::fill(constant.begin(), constant.end(), 0.);
    for (std::size_t point = 0; point < changes.volume.size(); ++point)
      {
        const std::size_t c = point / n_points;
        for (unsigned int k = 0; k < n_functions; ++k)
          {
            const double psi        = function(point, k);
            const unsigned int m    = patch_of[c] + k;
            const std::size_t shift = start[m] - start[patch_of[c]];
            constant[m] += psi * changes.constant[point];
            for (unsigned int a = 0; a < changes.n_nodes; ++a)
              for (unsigned int i = 0; i < 3; ++i)
                gradient[places[changes.n_nodes * c + a] + shift][i] +=
                  psi * changes.gradients[changes.n_nodes * point + a][i];
          }
      }
  }


  void
  VolumetricPatches::keep()
  {
    kept_gradient = gradient;
  }


  void
  VolumetricPatches::reduce(Vector &of_patches, const double *w, const Gradients &gradients) const
  {
    for (unsigned int p = 0; p < n_own(); ++p)
      {
        double sum = 0.;
        for (std::size_t k = start[p]; k < start[p + 1]; ++k)
          {
            const double *const value = w + 3 * static_cast<std::size_t>(node[k]);
            sum +=
              gradients[k][0] * value[0] + gradients[k][1] * value[1] + gradients[k][2] * value[2];
          }
        of_patches.local_element(p) = sum;
      }
  }


  void
  VolumetricPatches::expand(double *y, const double *of_patches, const Gradients &gradients) const
  {
    for (std::size_t p = 0; p + 1 < start.size(); ++p)
      for (std::size_t k = start[p]; k < start[p + 1]; ++k)
        if (node[k] < n_owned)
          for (unsigned int i = 0; i < 3; ++i)
            y[3 * static_cast<std::size_t>(node[k]) + i] += of_patches[p] * gradients[k][i];
  }


  void
  VolumetricPatches::subtract_force(const double *displacement, double *force) const
  {
    reduce(change, displacement, gradient);
    for (unsigned int p = 0; p < n_own(); ++p)
      change.local_element(p) = -stiffness(p) * (change.local_element(p) + constant[p]);
    const GhostValues stress(change);
    expand(force, stress.data(), gradient);
  }


  void
  VolumetricPatches::add_product(const double factor, const double *w, double *y) const
  {
    reduce(change, w);
    for (unsigned int p = 0; p < n_own(); ++p)
      change.local_element(p) *= factor * stiffness(p);
    const GhostValues stress(change);
    expand(y, stress.data());
  }


  double
  VolumetricPatches::energy(const double *displacement) const
  {
    reduce(change, displacement, gradient);
    double sum = 0.;
    for (unsigned int p = 0; p < n_own(); ++p)
      {
        const double growth = change.local_element(p) + constant[p];
        sum += 0.5 * stiffness(p) * growth * growth;
      }
    return sum;
  }


  double
  VolumetricPatches::value_at(const std::size_t point, const double *of_functions) const
  {
    const double *const of_patch = of_functions + patch_of[point / n_points];
    double value                 = function(point, 0) * of_patch[0];
    for (unsigned int k = 1; k < n_functions; ++k)
      value += function(point, k) * of_patch[k];
    return value;
  }


  std::vector<double>
  VolumetricPatches::mean_stress(const double *displacement) const
  {
    reduce(change, displacement, gradient);
    for (unsigned int p = 0; p < n_own(); ++p)
      change.local_element(p) = stiffness(p) * (change.local_element(p) + constant[p]);
    const GhostValues stress(change);
    std::vector<double> of_points;
    for (std::size_t point = 0; point < changes.volume.size(); ++point)
      of_points.push_back(value_at(point, stress.data()));
    return of_points;
  }


  std::vector<double>
  VolumetricPatches::mean_stress_of_cells(const double *displacement) const
  {
    const std::vector<double> of_points = mean_stress(displacement);
    if (n_points == 1)
      return of_points;
    std::vector<double> of_cells;
    for (std::size_t point = 0; point < of_points.size(); point += n_points)
      {
        double force = 0., whole = 0.;
        for (unsigned int q = 0; q < n_points; ++q)
          {
            force += changes.volume[point + q] * of_points[point + q];
            whole += changes.volume[point + q];
          }
        of_cells.push_back(force / whole);
      }
    return of_cells;
  }


  std::vector<VolumetricPatches::Growth>
  VolumetricPatches::growth(const double *displacement) const
  {
    return growth(displacement, 1.);
  }


  std::vector<VolumetricPatches::Growth>
  VolumetricPatches::growth_by_change(const double *change) const
  {
    return growth(change, 0.);
  }


  std::vector<VolumetricPatches::Growth>
  VolumetricPatches::growth(const double *w, const double constant_part) const
  {
    reduce(change, w, gradient);
    for (unsigned int p = 0; p < n_own(); ++p)
      change.local_element(p) = (change.local_element(p) + constant_part * constant[p]) / volume[p];
    const GhostValues of_patches(change);
    std::vector<Growth> growth;
    growth.reserve(changes.volume.size());
    for (std::size_t point = 0; point < changes.volume.size(); ++point)
      {
        double sum = constant_part * changes.constant[point];
        for (unsigned int a = 0; a < changes.n_nodes; ++a)
          {
            const std::size_t of_node = node[places[changes.n_nodes * (point / n_points) + a]];
            for (unsigned int i = 0; i < 3; ++i)
              sum += changes.gradients[changes.n_nodes * point + a][i] * w[3 * of_node + i];
          }
        growth.push_back({sum / changes.volume[point], value_at(point, of_patches.data())});
      }
    return growth;
  }


  double
  VolumetricPatches::round_off_square() const
  {
    constexpr double epsilon = 8. * std::numeric_limits<double>::epsilon();
    double sum               = 0.;
    for (unsigned int p = 0; p < n_own(); ++p)
      for (std::size_t k = start[p]; k < start[p + 1]; ++k)
        for (const double c : gradient[k])
          sum += epsilon * bulk[p] * c * epsilon * bulk[p] * c;
    return sum;
  }
} // namespace Supple
