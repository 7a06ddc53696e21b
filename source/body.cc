#include <supple/body.h>

#include <supple/compatibility.h>
#include <supple/error.h>
#include <supple/expression.h>

#include <deal.II/fe/fe_simplex_p.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using namespace dealii;

  Body::Body(const Mesh &mesh, const Parameters &parameters)
    : mesh(mesh)
    , rotation(parameters.corotation.rotation)
    , fe(FE_SimplexP<3>(1), 3)
    , dof_handler(mesh.triangulation)
  {
    dof_handler.distribute_dofs(fe);
    number_nodes();
    collect_cells(parameters);
  }


  void
  Body::number_nodes()
  {
    partitioner =
      std::make_shared<Utilities::MPI::Partitioner>(dof_handler.locally_owned_dofs(),
                                                    Compatibility::locally_relevant_dofs(
                                                      dof_handler),
                                                    mesh.communicator);
    n_owned = partitioner->locally_owned_size() / 3;
    n_local = n_owned + partitioner->n_ghost_indices() / 3;
  }


  void
  Body::collect_cells(const Parameters &parameters)
  {
    positions.resize(n_local);
    serial_vertex.resize(n_local);

    const auto exceptions = parameters.material.exceptions(parameters.origin("Material/By id"));
    for (const auto &[id, n_cells] : mesh.materials)
      {
        const auto exception = exceptions.find(id);
        materials[id] =
          exception == exceptions.end() ? parameters.material.preset() : exception->second;
      }
    for (const auto &[id, other_material] : exceptions)
      if (mesh.materials.find(id) == mesh.materials.end())
        throw InputError(parameters.origin("Material/By id") + ": no cell has the material id " +
                         std::to_string(id) + ".");

    std::vector<Tetrahedron> cells;
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_cell());
    for (const auto &cell : dof_handler.active_cell_iterators())
      {
        if (cell->is_artificial())
          continue;
        cell->get_dof_indices(dofs);

        Tetrahedron tetrahedron;
        bool touches_owned = false;
        for (unsigned int a = 0; a < 4; ++a)
          {
            const unsigned int first = partitioner->global_to_local(dofs[3 * a]);
            // The rest of the program counts on three numbers in a row for each vertex.
            AssertThrow(first % 3 == 0 &&
                          partitioner->global_to_local(dofs[3 * a + 1]) == first + 1 &&
                          partitioner->global_to_local(dofs[3 * a + 2]) == first + 2,
                        ExcInternalError());
            const unsigned int node = first / 3;
            tetrahedron.nodes[a]    = node;
            touches_owned           = touches_owned || node < n_owned;
            for (unsigned int d = 0; d < 3; ++d)
              positions[node][d] = cell->vertex(a)[d];
            serial_vertex[node] = mesh.serial_vertex[cell->vertex_index(a)];
          }
        if (!touches_owned && !cell->is_locally_owned())
          continue;
        tetrahedron.material = material(cell->material_id());
        tetrahedron.owned    = cell->is_locally_owned();
        cells.push_back(tetrahedron);
        cell_nodes.push_back(tetrahedron.nodes);
        active_cell.push_back(cell->active_cell_index());
        cell_material.push_back(cell->material_id());
      }
    tetrahedra = std::make_unique<Tetrahedra>(positions, cells, parameters.material.lumped);
  }


  void
  Body::initialize(Vector &vector) const
  {
    vector.reinit(partitioner);
  }


  void
  Body::update_rotations(const Vector &displacement, Effort &effort) const
  {
    if (rotation == RotationMethod::none)
      return;
    const PhaseTimer timer(effort, Phase::rotations);
    const GhostValues values(displacement);
    tetrahedra->update_rotations(rotation, values.data());
    effort.rotations_computed += cell_nodes.size();
  }


  void
  Body::internal_force(Vector &force, const Vector &displacement, Effort &effort) const
  {
    const PhaseTimer timer(effort, Phase::forces);
    const GhostValues values(displacement);
    sum_into(force, [&](double *sum) { tetrahedra->add_internal_force(values.data(), sum); });
  }


  const IsotropicMaterial &
  Body::material(const unsigned int id) const
  {
    return materials.at(id);
  }


  Point<3>
  Body::position(const unsigned int node) const
  {
    return {positions[node][0], positions[node][1], positions[node][2]};
  }


  std::vector<bool>
  Body::boundary_nodes(const unsigned int boundary_id, const std::string &origin) const
  {
    if (mesh.boundaries.find(boundary_id) == mesh.boundaries.end())
      {
        std::string known;
        for (const auto &[id, n_faces] : mesh.boundaries)
          known += (known.empty() ? "" : ", ") + std::to_string(id) + " (" +
                   std::to_string(n_faces) + " faces)";
        throw InputError(origin + ": the body has no boundary " + std::to_string(boundary_id) +
                         ". It has: " + known + ".");
      }

    // A face is seen by the process that owns its cell; its nodes may be owned by another one.
    Vector marked;
    initialize(marked);
    std::vector<types::global_dof_index> dofs(fe.n_dofs_per_face());
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() && cell->face(f)->boundary_id() == boundary_id)
            {
              cell->face(f)->get_dof_indices(dofs);
              for (const auto dof : dofs)
                marked.local_element(partitioner->global_to_local(dof)) = 1.;
            }
    marked.compress(VectorOperation::add);

    const GhostValues values(marked);
    std::vector<bool> nodes(n_local);
    for (unsigned int node = 0; node < n_local; ++node)
      nodes[node] = values.data()[3 * node] > 0.;
    return nodes;
  }


  std::vector<bool>
  Body::region_nodes(const std::string &expression, const std::string &origin) const
  {
    const Expression inside(expression, 1, origin);
    if (inside.depends_on_time())
      throw InputError(origin + ": a region is made of x, y and z; it can't depend on the time t.");
    std::vector<bool> nodes(n_local);
    unsigned int n_found = 0;
    bool is_finite       = true;
    for (unsigned int node = 0; node < n_local; ++node)
      {
        const double value = inside.value(position(node), 0.);
        is_finite          = is_finite && std::isfinite(value);
        nodes[node]        = value != 0.;
        n_found += nodes[node];
      }
    if (Utilities::MPI::max(is_finite ? 0 : 1, mesh.communicator) > 0)
      throw InputError(origin + ": it is not a finite number at every vertex.");
    if (Utilities::MPI::max(n_found, mesh.communicator) == 0)
      {
        std::string known;
        for (const auto &[id, n_faces] : mesh.boundaries)
          known += (known.empty() ? "" : ", ") + std::to_string(id);
        throw InputError(origin + ": this region has no vertex of the body, which lies in " +
                         mesh.extent() + " m and has the boundaries " + known + ".");
      }
    return nodes;
  }
} // namespace Supple
