#include <supple/forces/gravity.h>

#include <supple/base/error.h>

namespace Supple
{
  namespace
  {
    std::vector<double>
    nodal_mass(const Body &body)
    {
      std::vector<double> mass(body.n_local);
      body.cells->add_nodal_mass(mass.data());
      mass.resize(body.n_owned);
      return mass;
    }
  } // namespace


  std::unique_ptr<Force>
  Gravity::make(const Body &body, const LoadParameters &parameters, const ParameterFile &scene)
  {
    const std::string origin = scene.origin("Loads/Gravity");
    Expression acceleration(parameters.gravity_expressions(), 3, origin);
    if (acceleration.is_zero())
      return nullptr;
    return std::make_unique<Gravity>(body, std::move(acceleration), origin);
  }


  Gravity::Gravity(const Body &body, Expression acceleration, const std::string &origin)
    : body(body)
    , acceleration(std::move(acceleration))
    , mass(nodal_mass(body))
  {
    body.initialize(weight);
    set_weight(weight, 0.);
    if (!all_finite(weight))
      throw InputError(origin + ": it is not a finite number at every vertex at time 0.");
  }


  /** M g with the mass that the body has: of quadratic cells a consistent one has negative row sums
   * at the vertices, so that masses of nodes say little of an acceleration that varies. */
  void
  Gravity::set_quadratic_weight(Vector &to, const double time) const
  {
    Vector g;
    body.initialize(g);
    for (unsigned int node = 0; node < body.n_owned; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        g.local_element(3 * node + i) = acceleration.value(body.position(node), time, i);
    body.set_mass_product(to, g);
  }


  void
  Gravity::set_weight(Vector &to, const double time) const
  {
    if (body.is_quadratic())
      {
        set_quadratic_weight(to, time);
        return;
      }
    for (unsigned int node = 0; node < body.n_owned; ++node)
      for (unsigned int i = 0; i < 3; ++i)
        to.local_element(3 * node + i) =
          mass[node] * acceleration.value(body.position(node), time, i);
  }


  const Vector &
  Gravity::force_at(const Configuration &, const double time) const
  {
    if (acceleration.depends_on_time() && time != weight_time)
      {
        set_weight(weight, time);
        weight_time = time;
      }
    return weight;
  }


  double
  Gravity::work_of_time(const Configuration &configuration,
                        const double time_before,
                        const double time,
                        const double weight_of_start) const
  {
    if (!acceleration.depends_on_time())
      return 0.;
    Vector change = weight, before = weight;
    set_weight(change, time);
    set_weight(before, time_before);
    change -= before;
    return -weight_of_start * local_product(change, configuration.start_of_step().displacement) -
           (1. - weight_of_start) * local_product(change, configuration.displacement());
  }
} // namespace Supple
