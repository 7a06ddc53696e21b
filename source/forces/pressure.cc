#include <supple/forces/pressure.h>

#include <supple/base/error.h>

#include <algorithm>
#include <utility>

namespace Supple
{
  using namespace dealii;

  std::unique_ptr<Force>
  Pressure::make(const Body &body, const LoadParameters &parameters, const ParameterFile &scene)
  {
    auto load = std::make_unique<Pressure>(body, parameters, scene);
    if (load->pressure.is_zero())
      return nullptr;
    return load;
  }


  Pressure::Pressure(const Body &body, const LoadParameters &parameters, const ParameterFile &scene)
    : body(body)
    , pressure(parameters.pressure, 1, scene.origin("Loads/Pressure"))
    , follows(parameters.pressure_follows)
    , faces(loaded_faces(body, !pressure.is_zero(), parameters.pressure_on, "Pressure", scene))
  {
    Vector rest;
    body.initialize(rest);
    body.initialize(force);
    set_force(rest, 0.);
    if (!all_finite(force))
      throw InputError(scene.origin("Loads/Pressure") +
                       ": the loads are not finite numbers at every vertex at time 0.");
  }


  Pressure::LoadedFace
  Pressure::loaded_face(const std::array<unsigned int, 3> &nodes,
                        const double *u,
                        const double time) const
  {
    LoadedFace face;
    for (unsigned int v = 0; v < 3; ++v)
      {
        face.x[v] = body.position(nodes[v]);
        face.p[v] = pressure.value(face.x[v], time);
        if (follows)
          for (unsigned int i = 0; i < 3; ++i)
            face.x[v][i] += u[3 * nodes[v] + i];
      }
    return face;
  }


  void
  Pressure::set_force(const Vector &surface_displacement, const double time) const
  {
    force = 0.;
    const GhostValues u(surface_displacement);
    for (const auto &nodes : faces)
      {
        const LoadedFace face = loaded_face(nodes, u.data(), time);
        const FaceIntegrals over_face(face.x, body.mesh.section);
        for (unsigned int v = 0; v < 3; ++v)
          if (nodes[v] < body.n_owned)
            for (unsigned int w = 0; w < 3; ++w)
              for (unsigned int i = 0; i < 3; ++i)
                force.local_element(3 * nodes[v] + i) -=
                  over_face.products[v][w] * face.p[w] * over_face.normal[i];
      }
  }


  const Vector &
  Pressure::force_at(const Configuration &configuration, const double time) const
  {
    if (follows || (pressure.depends_on_time() && time != force_time))
      set_force(configuration.surface_displacement(), time);
    force_time = time;
    return force;
  }


  /** Simpson's rule is exact here: the force is quadratic in the displacement. */
  double
  Pressure::work_along(const Configuration &configuration,
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


  void
  Pressure::connect(const SymmetricPattern &pattern)
  {
    places.clear();
    for (unsigned int f = 0; follows && f < faces.size(); ++f)
      {
        places.emplace_back();
        for (unsigned int v = 0; v < 3; ++v)
          {
            const auto &[column, row] = std::minmax(faces[f][v], faces[f][(v + 1) % 3]);
            places[f][v]              = pattern.position(row, column);
          }
      }
  }


  void
  Pressure::update_tangent(const Tangent tangent,
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
        const LoadedFace face    = loaded_face(nodes, u.data(), time);
        const FaceMatrices whole = pressure_derivatives(face.x, face.p, body.mesh.section);
        stiffness.emplace_back();
        for (unsigned int v = 0; v < 3; ++v)
          for (unsigned int w = 0; w < 3; ++w)
            stiffness.back()[v][w] = 0.5 * part * (whole[v][w] + transpose(whole[w][v]));
      }
  }


  void
  Pressure::add_product(const Configuration &,
                        const TangentFactors &factors,
                        const double *w,
                        double *y) const
  {
    for (unsigned int f = 0; f < stiffness.size(); ++f)
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3 && faces[f][a] < body.n_owned; ++b)
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              y[3 * faces[f][a] + i] +=
                factors.displacement * stiffness[f][a][b][i][j] * w[3 * faces[f][b] + j];
  }


  void
  Pressure::add_tangent(const Configuration &,
                        const TangentFactors &factors,
                        SymmetricBlockMatrix &A) const
  {
    const auto add = [&factors](double *block, const Tensor<2, 3> &matrix) {
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          block[3 * i + j] += factors.displacement * matrix[i][j];
    };
    for (unsigned int f = 0; f < stiffness.size(); ++f)
      for (unsigned int v = 0; v < 3; ++v)
        {
          const unsigned int w = (v + 1) % 3, one = faces[f][v], other = faces[f][w];
          if (one < body.n_owned)
            add(&A.diagonal[9 * one], stiffness[f][v][v]);
          if (places[f][v] < A.pattern.n_entries())
            add(&A.lower[9 * places[f][v]], one > other ? stiffness[f][v][w] : stiffness[f][w][v]);
        }
  }
} // namespace Supple
