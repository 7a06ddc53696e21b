#include <supple/mechanics/volumetric_patches.h>

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
  {
    find_nodes(list);
    bulk.resize(start.size() - 1, 1.);
    volume.resize(start.size() - 1);
    constant.resize(start.size() - 1);
    change.reinit(partitioner);

    const std::vector<double> rest(3 * (1 + *std::max_element(node.begin(), node.end())));
    find_volume_changes(cells, {}, measure, rest.data(), changes);
    for (std::size_t c = 0; c < list.size(); ++c)
      {
        bulk[patch_of[c]] = list[c].bulk;
        volume[patch_of[c]] += changes[c].volume;
      }
    update({}, rest.data());
  }


  void
  VolumetricPatches::find_nodes(const std::vector<PatchCell> &list)
  {
    const std::size_t n_patches = n_own() + partitioner->n_ghost_indices();
    std::vector<std::vector<unsigned int>> nodes_of(n_patches);
    for (const PatchCell &cell : list)
      {
        patch_of.push_back(partitioner->global_to_local(cell.patch));
        auto &nodes = nodes_of[patch_of.back()];
        nodes.insert(nodes.end(), cell.nodes.begin(), cell.nodes.end());
      }
    start.push_back(0);
    for (auto &nodes : nodes_of)
      {
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        node.insert(node.end(), nodes.begin(), nodes.end());
        start.push_back(node.size());
      }
    gradient.resize(node.size());

    for (std::size_t c = 0; c < list.size(); ++c)
      {
        std::vector<unsigned int> nodes = list[c].nodes;
        std::sort(nodes.begin(), nodes.end());
        const auto begin = node.begin() + start[patch_of[c]];
        const auto end   = node.begin() + start[patch_of[c] + 1];
        places.push_back({});
        for (unsigned int a = 0; a < 4; ++a) // a triangle's fourth adds nothing
          places.back()[a] =
            std::lower_bound(begin, end, nodes[std::min<std::size_t>(a, nodes.size() - 1)]) -
            node.begin();
      }
  }


  void
  VolumetricPatches::update(const CellRotations::List &rotations, const double *displacement)
  {
    find_volume_changes(cells, rotations, measure, displacement, changes);
    std::fill(gradient.begin(), gradient.end(), std::array<double, 3>{});
    std::fill(constant.begin(), constant.end(), 0.);
    for (std::size_t c = 0; c < changes.size(); ++c)
      {
        constant[patch_of[c]] += changes[c].constant;
        for (unsigned int a = 0; a < 4; ++a)
          for (unsigned int i = 0; i < 3; ++i)
            gradient[places[c][a]][i] += changes[c].gradients[a][i];
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


  std::vector<double>
  VolumetricPatches::mean_stress(const double *displacement) const
  {
    reduce(change, displacement, gradient);
    for (unsigned int p = 0; p < n_own(); ++p)
      change.local_element(p) = stiffness(p) * (change.local_element(p) + constant[p]);
    const GhostValues stress(change);
    std::vector<double> of_cells;
    for (const unsigned int p : patch_of)
      of_cells.push_back(stress.data()[p]);
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
    growth.reserve(changes.size());
    for (std::size_t c = 0; c < changes.size(); ++c)
      {
        double sum = constant_part * changes[c].constant;
        for (unsigned int a = 0; a < 4; ++a)
          for (unsigned int i = 0; i < 3; ++i)
            sum += changes[c].gradients[a][i] * w[3 * std::size_t(node[places[c][a]]) + i];
        growth.push_back({sum / changes[c].volume, of_patches.data()[patch_of[c]]});
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
