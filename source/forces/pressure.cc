#include <supple/forces/pressure.h>

#include <supple/base/error.h>

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


  void
  Pressure::set_force(const Vector &surface_displacement, const double time) const
  {
    force = 0.;
    const GhostValues u(surface_displacement);
    for (const auto &face : faces)
      {
        std::array<Point<3>, 3> x;
        std::array<double, 3> p;
        for (unsigned int v = 0; v < 3; ++v)
          {
            x[v] = body.position(face[v]);
            p[v] = pressure.value(x[v], time);
            if (follows)
              for (unsigned int i = 0; i < 3; ++i)
                x[v][i] += u.data()[3 * face[v] + i];
          }
        const FaceIntegrals over_face(x, body.mesh.section);
        for (unsigned int v = 0; v < 3; ++v)
          if (face[v] < body.n_owned)
            for (unsigned int w = 0; w < 3; ++w)
              for (unsigned int i = 0; i < 3; ++i)
                force.local_element(3 * face[v] + i) -=
                  over_face.products[v][w] * p[w] * over_face.normal[i];
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
} // namespace Supple
