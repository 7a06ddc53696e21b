#include <supple/forces/loads.h>

#include <supple/base/error.h>

#include <cmath>

namespace Supple
{
  using namespace dealii;

  Loads::Loads(const Body &body, const LoadParameters &parameters, const ParameterFile &scene)
    : body(body)
    , body_force(parameters.body_force, 3, scene.origin("Loads/Body force"))
    , nodal_force(parameters.nodal_force, 3, scene.origin("Loads/Nodal force"))
    , traction(parameters.traction, 3, scene.origin("Loads/Traction"))
    , pressure(parameters.pressure, 1, scene.origin("Loads/Pressure"))
    , pressure_follows(parameters.pressure_follows)
  {
    std::vector<double> mass(body.n_local);
    body.cells->add_nodal_mass(mass.data());
    body.initialize(gravity);
    for (unsigned int node = 0; node < body.n_owned; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        gravity.local_element(3 * node + i) = mass[node] * parameters.gravity[i];

    if (!nodal_force.is_zero())
      {
        const auto nodes = body.selected_nodes(Utilities::trim(parameters.nodal_force_on),
                                               scene.origin("Loads/Nodal force on"));
        for (unsigned int node = 0; node < body.n_owned; ++node)
          if (nodes[node])
            forced_nodes.push_back(node);
      }
    const auto faces = [&](const Expression &expression,
                           const std::vector<unsigned int> &ids,
                           const std::string &name) {
      if (!expression.is_zero() && ids.empty())
        throw InputError(scene.origin("Loads/" + name) + ": it acts nowhere; set \"" + name +
                         " on\" to boundary ids.");
      return body.boundary_faces(ids, scene.origin("Loads/" + name + " on"));
    };
    traction_faces = faces(traction, parameters.traction_on, "Traction");
    pressure_faces = faces(pressure, parameters.pressure_on, "Pressure");

    applied =
      !body_force.is_zero() || !nodal_force.is_zero() || !traction.is_zero() || !pressure.is_zero();
    time_dependent = body_force.depends_on_time() || nodal_force.depends_on_time() ||
                     traction.depends_on_time() ||
                     (!pressure_follows && pressure.depends_on_time());
    if (applied)
      {
        for (Vector *vector : {&dead, &live, &total})
          body.initialize(*vector);
        Vector rest;
        body.initialize(rest);
        if (!all_finite(force(0., rest)))
          throw InputError(scene.origin("Loads/Body force") +
                           ": the loads are not finite numbers at every vertex at time 0.");
      }
  }


  std::vector<double>
  Loads::nodal_values(const Expression &expression, const double time) const
  {
    std::vector<double> values(3 * body.n_local);
    for (unsigned int node = 0; node < body.n_local; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        values[3 * node + i] = expression.value(body.position(node), time, i);
    return values;
  }


  /**
   * For a triangle, (1 + delta_vw) / 12 of its area. An edge of a plane body stands for a strip as
   * wide as the section is thick, (1 + delta_vw) / 6 of its area, or for a ring about the axis, as
   * wide as its distance from there, which is linear along the edge, makes it.
   */
  Loads::FaceIntegrals
  Loads::integrals(const std::array<Point<3>, 3> &x) const
  {
    const Section &section = body.mesh.section;
    FaceIntegrals result{};
    if (!section.plane())
      {
        result.normal = 0.5 * cross_product_3d(x[1] - x[0], x[2] - x[0]);
        for (unsigned int v = 0; v < 3; ++v)
          for (unsigned int w = 0; w < 3; ++w)
            result.products[v][w] = (v == w ? 2. : 1.) / 12.;
        return result;
      }
    result.normal = cross_product_3d(x[1] - x[0], Point<3>(0., 0., 1.));
    const std::array<double, 2> width{
      {section.thickness_at(x[0][0]), section.thickness_at(x[1][0])}};
    result.products[0][0] = width[0] / 4. + width[1] / 12.;
    result.products[1][1] = width[0] / 12. + width[1] / 4.;
    result.products[0][1] = result.products[1][0] = (width[0] + width[1]) / 12.;
    return result;
  }


  /** Integrals of the force's linear interpolation times the shape functions. */
  void
  Loads::add_body_force(const double time, Vector &force) const
  {
    const std::vector<double> values = nodal_values(body_force, time);
    sum_into(live, [&](double *sum) { body.cells->add_load(values.data(), sum); });
    force += live;
  }


  void
  Loads::add_nodal_force(const double time, Vector &force) const
  {
    for (const unsigned int node : forced_nodes)
      for (unsigned int i = 0; i < 3; ++i)
        force.local_element(3 * node + i) += nodal_force.value(body.position(node), time, i);
  }


  void
  Loads::add_traction(const double time, Vector &force) const
  {
    for (const auto &face : traction_faces)
      {
        std::array<Point<3>, 3> x;
        std::array<Tensor<1, 3>, 3> values;
        for (unsigned int v = 0; v < 3; ++v)
          {
            x[v] = body.position(face[v]);
            for (unsigned int i = 0; i < 3; ++i)
              values[v][i] = traction.value(x[v], time, i);
          }
        const FaceIntegrals over_face = integrals(x);
        const double size             = over_face.normal.norm();
        for (unsigned int v = 0; v < 3; ++v)
          if (face[v] < body.n_owned)
            for (unsigned int w = 0; w < 3; ++w)
              for (unsigned int i = 0; i < 3; ++i)
                force.local_element(3 * face[v] + i) +=
                  size * over_face.products[v][w] * values[w][i];
      }
  }


  /** -p n dA, with the pressure interpolated on each face and the face where the displacement takes
   * it. */
  void
  Loads::add_pressure(const double time, const Vector &displacement, Vector &force) const
  {
    const GhostValues u(displacement);
    for (const auto &face : pressure_faces)
      {
        std::array<Point<3>, 3> x;
        std::array<double, 3> p;
        for (unsigned int v = 0; v < 3; ++v)
          {
            p[v] = pressure.value(body.position(face[v]), time);
            x[v] = body.position(face[v]);
            if (pressure_follows)
              for (unsigned int i = 0; i < 3; ++i)
                x[v][i] += u.data()[3 * face[v] + i];
          }
        const FaceIntegrals over_face = integrals(x);
        for (unsigned int v = 0; v < 3; ++v)
          if (face[v] < body.n_owned)
            for (unsigned int w = 0; w < 3; ++w)
              for (unsigned int i = 0; i < 3; ++i)
                force.local_element(3 * face[v] + i) -=
                  over_face.products[v][w] * p[w] * over_face.normal[i];
      }
  }


  const Vector &
  Loads::applied_force(const double time, const Vector &displacement) const
  {
    if (!evaluated || (time_dependent && time != evaluation_time))
      {
        evaluated       = true;
        evaluation_time = time;
        dead            = 0.;
        if (!body_force.is_zero())
          add_body_force(time, dead);
        add_nodal_force(time, dead);
        add_traction(time, dead);
        if (!pressure_follows)
          add_pressure(time, displacement, dead);
      }
    if (!follow())
      return dead;
    live = dead;
    add_pressure(time, displacement, live);
    return live;
  }


  const Vector &
  Loads::force(const double time, const Vector &displacement) const
  {
    if (!applied)
      return gravity;
    total = applied_force(time, displacement);
    total += gravity;
    return total;
  }


  double
  Loads::potential(const Vector &displacement) const
  {
    return -(gravity * displacement);
  }
} // namespace Supple
