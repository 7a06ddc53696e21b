#include <supple/forces/pressure.h>

#include <supple/base/error.h>

#include <algorithm>
#include <utility>

namespace Supple
{
  using namespace dealii;

  template <>
  void
  Pressure<3>::subtract_force(const std::array<unsigned int, 3> &nodes,
                              const LoadedFace &face) const
  {
    const FaceIntegrals over_face(face.x, body.mesh.section);
    for (unsigned int v = 0; v < 3; ++v)
      if (nodes[v] < body.n_owned)
        for (unsigned int w = 0; w < 3; ++w)
          for (unsigned int i = 0; i < 3; ++i)
            force.local_element(3 * nodes[v] + i) -=
              over_face.products[v][w] * face.p[w] * over_face.normal[i];
  }


  template <>
  void
  Pressure<6>::subtract_force(const std::array<unsigned int, 6> &nodes,
                              const LoadedFace &face) const
  {
    const CurvedFace over_face(face.x);
    for (unsigned int q = 0; q < CurvedFace::n_points; ++q)
      {
        const std::array<double, 6> &N = CurvedFace::shape_values()[q];
        double p                       = 0.;
        for (unsigned int v = 0; v < 6; ++v)
          p += N[v] * face.p[v];
        for (unsigned int v = 0; v < 6; ++v)
          if (nodes[v] < body.n_owned)
            for (unsigned int i = 0; i < 3; ++i)
              force.local_element(3 * nodes[v] + i) -= N[v] * p * over_face.normals[q][i];
      }
  }


  template <unsigned int n_nodes>
  Pressure<n_nodes>::Pressure(const Body &body,
                              const LoadParameters &parameters,
                              const ParameterFile &scene)
    : body(body)
    , pressure(parameters.pressure, 1, scene.origin("Loads/Pressure"))
    , follows(parameters.pressure_follows)
    , faces(nodes_of<n_nodes>(
        loaded_faces(body, !pressure.is_zero(), parameters.pressure_on, "Pressure", scene)))
  {
    Vector rest;
    body.initialize(rest);
    body.initialize(force);
    set_force(rest, 0.);
    if (!all_finite(force))
      throw InputError(scene.origin("Loads/Pressure") +
                       ": the loads are not finite numbers at every vertex at time 0.");
  }


  template <unsigned int n_nodes>
  typename Pressure<n_nodes>::LoadedFace
  Pressure<n_nodes>::loaded_face(const std::array<unsigned int, n_nodes> &nodes,
                                 const double *u,
                                 const double time) const
  {
    LoadedFace face;
    for (unsigned int v = 0; v < n_nodes; ++v)
      {
        face.x[v] = body.position(nodes[v]);
        face.p[v] = pressure.value(face.x[v], time);
        if (follows)
          for (unsigned int i = 0; i < 3; ++i)
            face.x[v][i] += u[3 * nodes[v] + i];
      }
    return face;
  }


  template <unsigned int n_nodes>
  void
  Pressure<n_nodes>::set_force(const Vector &surface_displacement, const double time) const
  {
    force = 0.;
    const GhostValues u(surface_displacement);
    for (const auto &nodes : faces)
      subtract_force(nodes, loaded_face(nodes, u.data(), time));
  }


  template <unsigned int n_nodes>
  const Vector &
  Pressure<n_nodes>::force_at(const Configuration &configuration, const double time) const
  {
    if (follows || (pressure.depends_on_time() && time != force_time))
      set_force(configuration.surface_displacement(), time);
    force_time = time;
    return force;
  }


  /** Simpson's rule is exact here: the force is quadratic in the displacement. */
  template <unsigned int n_nodes>
  double
  Pressure<n_nodes>::work_along(const Configuration &configuration,
                                const double time,
                                const Vector &from) const
  {
    if (!follows)
      return 0.;
    const Vector &to = configuration.surface_displacement();
    Vector way = to, middle = from;
    way -= from;
    middle.add(0.5, way);
    double work = 0.;
    for (const auto &[place, weight] :
         {std::pair<const Vector *, double>{&from, 1.}, {&middle, 4.}, {&to, 1.}})
      {
        set_force(*place, time);
        work += weight / 6. * local_product(force, way);
      }
    return work;
  }


  template <unsigned int n_nodes>
  void
  Pressure<n_nodes>::connect(const SymmetricPattern &pattern)
  {
    places.clear();
    for (unsigned int f = 0; follows && f < faces.size(); ++f)
      {
        places.emplace_back();
        for (unsigned int w = 1, pair = 0; w < n_nodes; ++w)
          for (unsigned int v = 0; v < w; ++v, ++pair)
            {
              const auto &[column, row] = std::minmax(faces[f][v], faces[f][w]);
              places[f][pair]           = pattern.position(row, column);
            }
      }
  }


  template <unsigned int n_nodes>
  void
  Pressure<n_nodes>::update_tangent(const Tangent tangent,
                                    const Configuration &configuration,
                                    const double time,
                                    const double part)
  {
    stiffness.clear();
    if (!follows || tangent != Tangent::consistent)
      return;
    const GhostValues u(configuration.surface_displacement());
    for (const auto &nodes : faces)
      {
        const LoadedFace face             = loaded_face(nodes, u.data(), time);
        const FaceMatrices<n_nodes> whole = pressure_derivatives(face.x, face.p, body.mesh.section);
        stiffness.emplace_back();
        for (unsigned int v = 0; v < n_nodes; ++v)
          for (unsigned int w = 0; w < n_nodes; ++w)
            stiffness.back()[v][w] = 0.5 * part * (whole[v][w] + transpose(whole[w][v]));
      }
  }


  template <unsigned int n_nodes>
  void
  Pressure<n_nodes>::add_product(const Configuration &,
                                 const TangentFactors &factors,
                                 const double *w,
                                 double *y) const
  {
    for (unsigned int f = 0; f < stiffness.size(); ++f)
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int b = 0; b < n_nodes && faces[f][a] < body.n_owned; ++b)
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              y[3 * faces[f][a] + i] +=
                factors.displacement * stiffness[f][a][b][i][j] * w[3 * faces[f][b] + j];
  }


  template <unsigned int n_nodes>
  void
  Pressure<n_nodes>::add_tangent(const Configuration &,
                                 const TangentFactors &factors,
                                 SymmetricBlockMatrix &A) const
  {
    const auto add = [&factors](double *block, const Tensor<2, 3> &matrix) {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          block[3 * i + j] += factors.displacement * matrix[i][j];
    };
    for (unsigned int f = 0; f < stiffness.size(); ++f)
      for (unsigned int w = 0, pair = 0; w < n_nodes; ++w)
        {
          const unsigned int other = faces[f][w];
          if (other < body.n_owned)
            add(&A.diagonal[9 * other], stiffness[f][w][w]);
          for (unsigned int v = 0; v < w; ++v, ++pair)
            if (places[f][pair] < A.pattern.n_entries())
              add(&A.lower[9 * places[f][pair]],
                  faces[f][v] > other ? stiffness[f][v][w] : stiffness[f][w][v]);
        }
  }


  template class Pressure<3>;
  template class Pressure<6>;


  namespace
  {
    template <unsigned int n_nodes>
    std::unique_ptr<Force>
    make(const Body &body, const LoadParameters &parameters, const ParameterFile &scene)
    {
      auto load = std::make_unique<Pressure<n_nodes>>(body, parameters, scene);
      if (load->is_zero())
        return nullptr;
      return load;
    }
  } // namespace


  std::unique_ptr<Force>
  make_pressure(const Body &body, const LoadParameters &parameters, const ParameterFile &scene)
  {
    return body.is_quadratic() ? make<6>(body, parameters, scene)
                               : make<3>(body, parameters, scene);
  }
} // namespace Supple
