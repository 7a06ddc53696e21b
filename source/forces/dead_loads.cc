#include <supple/forces/dead_loads.h>

#include <supple/base/error.h>
#include <supple/mechanics/selection.h>

#include <deal.II/base/utilities.h>

namespace Supple
{
  using namespace dealii;

  std::unique_ptr<Force>
  DeadLoads::make(const Body &body, const LoadParameters &parameters, const ParameterFile &scene)
  {
    auto loads = std::make_unique<DeadLoads>(body, parameters, scene);
    if (loads->body_force.is_zero() && loads->nodal_force.is_zero() && loads->traction.is_zero())
      return nullptr;
    return loads;
  }


  DeadLoads::DeadLoads(const Body &body,
                       const LoadParameters &parameters,
                       const ParameterFile &scene)
    : body(body)
    , body_force(parameters.body_force, 3, scene.origin("Loads/Body force"))
    , nodal_force(parameters.nodal_force, 3, scene.origin("Loads/Nodal force"))
    , traction(parameters.traction, 3, scene.origin("Loads/Traction"))
    , time_dependent(body_force.depends_on_time() || nodal_force.depends_on_time() ||
                     traction.depends_on_time())
  {
    const Faces faces =
      loaded_faces(body, !traction.is_zero(), parameters.traction_on, "Traction", scene);
    if (body.is_quadratic())
      quadratic_traction_faces = nodes_of<6>(faces);
    else
      traction_faces = nodes_of<3>(faces);
    if (!nodal_force.is_zero())
      {
        const auto nodes =
          Selection(body).selected_nodes(Utilities::trim(parameters.nodal_force_on),
                                         scene.origin("Loads/Nodal force on"));
        for (unsigned int node = 0; node < body.n_owned; ++node)
          if (nodes[node])
            forced_nodes.push_back(node);
      }
    body.initialize(force);
    const auto require_finite = [&](const std::string &entry) {
      if (!all_finite(force))
        throw InputError(scene.origin(entry) +
                         ": the loads are not finite numbers at every vertex at time 0.");
    };
    add_body_force(0., force);
    require_finite("Loads/Body force");
    add_nodal_force(0., force);
    require_finite("Loads/Nodal force");
    add_traction(0., force);
    require_finite("Loads/Traction");
  }


  /** Integrals of the force's interpolation times the shape functions. */
  void
  DeadLoads::add_body_force(const double time, Vector &to) const
  {
    if (body_force.is_zero())
      return;
    std::vector<double> values(3 * static_cast<std::size_t>(body.n_local));
    for (unsigned int node = 0; node < body.n_local; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        values[3 * node + i] = body_force.value(body.position(node), time, i);
    Vector part;
    body.initialize(part);
    sum_into(part, [&](double *sum) { body.cells->add_load(values.data(), sum); });
    to += part;
  }


  void
  DeadLoads::add_nodal_force(const double time, Vector &to) const
  {
    for (const unsigned int node : forced_nodes)
      for (unsigned int i = 0; i < 3; ++i)
        to.local_element(3 * node + i) += nodal_force.value(body.position(node), time, i);
  }


  template <unsigned int n>
  DeadLoads::TractionFace<n>
  DeadLoads::traction_on(const std::array<unsigned int, n> &nodes, const double time) const
  {
    TractionFace<n> face;
    for (unsigned int v = 0; v < n; ++v)
      {
        face.x[v] = body.position(nodes[v]);
        for (unsigned int i = 0; i < 3; ++i)
          face.values[v][i] = traction.value(face.x[v], time, i);
      }
    return face;
  }


  void
  DeadLoads::add_traction(const double time, Vector &to) const
  {
    const auto add = [&](const unsigned int node, const double factor, const Tensor<1, 3> &force) {
      for (unsigned int i = 0; i < 3 && node < body.n_owned; ++i)
        to.local_element(3 * node + i) += factor * force[i];
    };
    for (const auto &nodes : traction_faces)
      {
        const auto face = traction_on<3>(nodes, time);
        const FaceIntegrals over_face(face.x, body.mesh.section);
        const double size = over_face.normal.norm();
        for (unsigned int v = 0; v < 3; ++v)
          for (unsigned int w = 0; w < 3; ++w)
            add(nodes[v], size * over_face.products[v][w], face.values[w]);
      }
    for (const auto &nodes : quadratic_traction_faces)
      {
        const auto face = traction_on<6>(nodes, time);
        const CurvedFace over_face(face.x);
        for (unsigned int q = 0; q < CurvedFace::n_points; ++q)
          {
            const std::array<double, 6> &N = CurvedFace::shape_values()[q];
            Tensor<1, 3> force;
            for (unsigned int v = 0; v < 6; ++v)
              force += over_face.normals[q].norm() * N[v] * face.values[v];
            for (unsigned int v = 0; v < 6; ++v)
              add(nodes[v], N[v], force);
          }
      }
  }


  const Vector &
  DeadLoads::force_at(const Configuration &, const double time) const
  {
    if (time_dependent && time != force_time)
      {
        force_time = time;
        force      = 0.;
        add_body_force(time, force);
        add_nodal_force(time, force);
        add_traction(time, force);
      }
    return force;
  }
} // namespace Supple
