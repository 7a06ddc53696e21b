#include <supple/mechanics/body.h>

#include <supple/base/error.h>
#include <supple/base/text.h>

#include <algorithm>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    // Of one thread, at the least.
    constexpr std::size_t least_cells = 8000;


    unsigned int
    threads_for(const std::size_t n_cells, const unsigned int most)
    {
      const std::size_t sensible = std::max<std::size_t>(1, n_cells / least_cells);
      return std::min<std::size_t>(most, sensible);
    }


    /** What a patch takes over of the resistance to a change of volume [Pa], and what the cell
     * keeps. */
    std::pair<double, IsotropicMaterial>
    share_of_patch(const LawChoice &law, const IsotropicMaterial &material, const bool quadratic)
    {
      if (!law.is_hyperelastic())
        return quadratic ? std::make_pair(material.lambda, material.without_lambda())
                         : std::make_pair(material.bulk(), material.deviatoric());
      IsotropicMaterial kept = material;
      kept.lambda            = law.least_lambda(material);
      if (quadratic)
        kept.lambda += VolumetricPatches::bulk_of_quadratic_cells * material.mu;
      return {material.lambda - kept.lambda, kept};
    }


    /** With a negative factor before (J - 1)^2 bodies would grow without end.
     * @throws InputError */
    void
    check_law(const LawChoice &law,
              const std::map<unsigned int, IsotropicMaterial> &materials,
              const ParameterFile &scene)
    {
      for (const auto &[id, material] : materials)
        if (law.is_hyperelastic() && material.lambda < law.least_lambda(material))
          throw InputError(scene.origin("Material/Law") + ": " + law.name +
                           " has no least energy at the Poisson ratio of material " +
                           std::to_string(id) + ", " + digits(material.poisson(), 6) +
                           ". Take a greater one, or Law = neo-hookean.");
    }
  } // namespace


  Body::Body(const Mesh &mesh,
             const MaterialParameters &material,
             const unsigned int most_threads,
             const ParameterFile &scene)
    : mesh(mesh)
    , partitioner(mesh.parts->partitioner)
    , n_threads(threads_for(mesh.parts->cells.size(), most_threads))
    , n_owned(mesh.parts->n_owned)
    , n_local(mesh.parts->n_local)
    , positions(mesh.parts->positions)
    , serial_vertex(mesh.parts->serial_vertex)
    , volume_measure(material.volume_measure)
  {
    collect_cells(material, scene);
    if (has_patches() && is_quadratic())
      check_patches(scene);
  }


  unsigned int
  Body::n_dofs() const
  {
    return mesh.section.plane() ? partitioner->size() / 3 * 2 : partitioner->size();
  }


  bool
  Body::is_held_by_nature(const unsigned int dof) const
  {
    return (mesh.section.plane() && dof % 3 == 2) ||
           (mesh.section.axisymmetric() && dof % 3 == 0 && positions[dof / 3][0] == 0.);
  }


  void
  Body::collect_cells(const MaterialParameters &parameters, const ParameterFile &scene)
  {
    const auto exceptions =
      parameters.exceptions(scene.origin("Material/By id"), mesh.material_names);
    for (const auto &[id, n_cells] : mesh.materials)
      {
        const auto exception = exceptions.find(id);
        materials[id] = exception == exceptions.end() ? parameters.preset() : exception->second;
      }
    for (const auto &[id, other_material] : exceptions)
      if (mesh.materials.find(id) == mesh.materials.end())
        throw InputError(scene.origin("Material/By id") + ": no cell has the material id " +
                         std::to_string(id) + ".");
    const LawChoice law = parameters.law_choice();
    check_law(law, materials, scene);

    const bool cured = parameters.cure == MaterialParameters::LockingCure::patches;
    std::vector<Cell> known_cells;
    for (const LocalCell &cell : mesh.parts->cells)
      {
        const auto is_owned = [&](const unsigned int node) { return node < n_owned; };
        bool touches_owned  = std::any_of(cell.nodes.begin(), cell.nodes.end(), is_owned);
        if (is_quadratic() && !touches_owned)
          {
            const auto &middles = mesh.parts->cell_middles[cell.index];
            touches_owned       = std::any_of(middles.begin(), middles.end(), is_owned);
          }
        if (!touches_owned && !cell.owned)
          continue;
        IsotropicMaterial cell_is_of = material(cell.material_id);
        if (parameters.vertex_mass > 0.)
          cell_is_of.density = 0.;
        if (cured)
          {
            const auto [bulk, kept] = share_of_patch(law, cell_is_of, is_quadratic());
            patch_cells.push_back({{}, cell.patch, bulk});
            if (!is_quadratic())
              patch_cells.back().nodes.assign(cell.nodes.begin(),
                                              cell.nodes.begin() + (mesh.section.plane() ? 3 : 4));
            cell_is_of = kept;
          }
        known_cells.push_back({cell.nodes, cell_is_of, cell.owned});
        cell_nodes.push_back(cell.nodes);
        if (is_quadratic())
          {
            known_cells.back().middles = mesh.parts->cell_middles[cell.index];
            cell_middles.push_back(known_cells.back().middles);
          }
        cell_index.push_back(cell.index);
        serial_cell.push_back(cell.serial_cell);
        cell_owned.push_back(cell.owned);
        cell_material.push_back(cell.material_id);
      }
    cells = std::make_unique<const Cells>(positions,
                                          n_owned,
                                          known_cells,
                                          parameters.lumped,
                                          parameters.vertex_mass,
                                          mesh.section,
                                          n_threads,
                                          is_quadratic());
  }


  void
  Body::check_patches(const ParameterFile &scene) const
  {
    for (const auto &[id, n_cells] : mesh.materials)
      if (!(material(id).lambda > 0.))
        throw InputError(scene.origin("Material/Volumetric locking cure") +
                         ": patches of quadratic cells are for Poisson ratios above 0, and that of "
                         "material " +
                         std::to_string(id) + " is " + digits(material(id).poisson(), 6) +
                         ". No cell locks there; it must be none.");
  }


  std::vector<unsigned int>
  Body::nodes_of_cell(const std::size_t cell) const
  {
    std::vector<unsigned int> nodes(cell_nodes[cell].begin(), cell_nodes[cell].end());
    if (is_quadratic())
      nodes.insert(nodes.end(), cell_middles[cell].begin(), cell_middles[cell].end());
    return nodes;
  }


  void
  Body::initialize(Vector &vector) const
  {
    vector.reinit(partitioner);
  }


  void
  Body::set_mass_product(Vector &y, const Vector &x) const
  {
    const GhostValues values(x);
    sum_into(y, [&](double *sum) { cells->add_mass_product(values.data(), sum); });
  }


  std::unique_ptr<VolumetricPatches>
  Body::make_patches(const bool linear) const
  {
    if (!has_patches())
      return nullptr;
    return std::make_unique<VolumetricPatches>(*cells,
                                               patch_cells,
                                               n_owned,
                                               linear ? VolumeMeasure::trace : volume_measure,
                                               mesh.parts->patch_partitioner);
  }


  const IsotropicMaterial &
  Body::material(const unsigned int id) const
  {
    return materials.at(id);
  }


  double
  Body::largest_poisson() const
  {
    double poisson = -1.;
    for (const auto &[id, n_cells] : mesh.materials)
      poisson = std::max(poisson, material(id).poisson());
    return poisson;
  }


  Point<3>
  Body::position(const unsigned int node) const
  {
    return {positions[node][0], positions[node][1], positions[node][2]};
  }
} // namespace Supple
