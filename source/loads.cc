#include <supple/loads.h>

#include <supple/error.h>

#include <cmath>

namespace Supple
{
  using namespace dealii;

  Loads::Loads(const Body &body, const Parameters &parameters)
    : body(body)
    , expression(parameters.loads.body_force, 3, parameters.origin("Loads/Body force"))
  {
    std::vector<double> mass(body.n_local);
    body.tetrahedra->add_nodal_mass(mass.data());

    body.initialize(gravity);
    for (unsigned int node = 0; node < body.n_owned; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        gravity.local_element(3 * node + i) = mass[node] * parameters.loads.gravity[i];
    if (has_body_force())
      {
        body.initialize(applied);
        body.initialize(total);
        if (!std::isfinite(force(0.).l2_norm()))
          throw InputError(parameters.origin("Loads/Body force") +
                           ": it is not a finite number at every vertex at time 0.");
      }
  }


  /** Integrals of the force's linear interpolation times the shape functions. */
  void
  Loads::evaluate(const double time) const
  {
    if (evaluated && (!expression.depends_on_time() || time == evaluation_time))
      return;
    evaluated       = true;
    evaluation_time = time;

    std::vector<double> values(3 * body.n_local);
    for (unsigned int node = 0; node < body.n_local; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        values[3 * node + i] = expression.value(body.position(node), time, i);
    sum_into(applied, [&](double *force) { body.tetrahedra->add_load(values.data(), force); });
    total = gravity;
    total += applied;
  }


  const Vector &
  Loads::force(const double time) const
  {
    if (!has_body_force())
      return gravity;
    evaluate(time);
    return total;
  }


  const Vector &
  Loads::body_force(const double time) const
  {
    evaluate(time);
    return applied;
  }


  double
  Loads::potential(const Vector &displacement) const
  {
    return -(gravity * displacement);
  }
} // namespace Supple
