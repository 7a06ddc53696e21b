#include <supple/observe/point_forces.h>

#include <supple/base/expression.h>
#include <supple/mechanics/selection.h>
#include <supple/mesh/serial_mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <cmath>

namespace Supple
{
  using namespace dealii;

  PointForces::PointForces(const Body &body,
                           const Constraints &constraints,
                           const LoadParameters &loads,
                           const ParameterFile &scene)
    : body(body)
    , is_loaded(body.n_owned)
  {
    if (!Expression(loads.nodal_force, 3, scene.origin("Loads/Nodal force")).is_zero())
      is_loaded =
        without_face(Selection(body).selected_nodes(Utilities::trim(loads.nodal_force_on),
                                                    scene.origin("Loads/Nodal force on")));
    const unsigned int dimension = body.cells->n_nodes - 1;
    for (unsigned int i = 0; i < dimension; ++i)
      {
        std::vector<bool> held(body.n_local);
        for (unsigned int node = 0; node < body.n_local; ++node)
          held[node] = constraints.holds(3 * node + i) && !body.is_held_by_nature(3 * node + i);
        const std::vector<bool> alone = without_face(held);
        for (unsigned int node = 0; node < body.n_owned; ++node)
          if (alone[node])
            held_alone.push_back(3 * node + i);
      }
  }


  std::vector<bool>
  PointForces::without_face(const std::vector<bool> &nodes) const
  {
    const unsigned int n_nodes = body.cells->n_nodes;
    std::vector<bool> alone(nodes.begin(), nodes.begin() + body.n_owned);
    for (std::size_t c = 0; c < body.cell_nodes.size(); ++c)
      {
        const auto &cell      = body.cell_nodes[c];
        unsigned int n_chosen = 0; // of the vertices
        for (unsigned int a = 0; a < n_nodes; ++a)
          n_chosen += nodes[cell[a]];
        if (n_chosen + 1 < n_nodes)
          continue;
        for (unsigned int a = 0; a < n_nodes; ++a)
          if (nodes[cell[a]] && cell[a] < body.n_owned)
            alone[cell[a]] = false;
        for (unsigned int e = 0; e < 6 && body.is_quadratic(); ++e)
          {
            const auto &[v, w]        = tetrahedron_edges[e];
            const unsigned int middle = body.cell_middles[c][e];
            if (nodes[cell[v]] && nodes[cell[w]] && middle < body.n_owned)
              alone[middle] = alone[middle] && !nodes[middle];
          }
      }
    return alone;
  }


  bool
  PointForces::matter(const Vector &reactions, const Vector &loads) const
  {
    constexpr double little =
      0.05; // of the forces; vertices held on a plane of symmetry have noise
    const auto size = [](const Vector &forces, const unsigned int first, const unsigned int n) {
      double square = 0.;
      for (unsigned int dof = first; dof < first + n; ++dof)
        square += forces.local_element(dof) * forces.local_element(dof);
      return std::sqrt(square);
    };
    std::vector<double> here(4), all(4); // held alone, reactions, loads at points, loads
    for (const unsigned int dof : held_alone)
      here[0] += size(reactions, dof, 1);
    for (unsigned int node = 0; node < body.n_owned; ++node)
      {
        const double load = size(loads, 3 * node, 3);
        here[1] += size(reactions, 3 * node, 3);
        here[2] += is_loaded[node] ? load : 0.;
        here[3] += load;
      }
    Utilities::MPI::sum(here, body.mesh.communicator, all);
    return all[0] > little * (all[1] + all[3]) || all[2] > little * all[3];
  }
} // namespace Supple
