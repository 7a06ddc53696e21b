#ifndef supple_gravity_h
#define supple_gravity_h

#include <supple/base/expression.h>
#include <supple/forces/load.h>
#include <supple/forces/load_parameters.h>
#include <supple/input/parameter_file.h>

namespace Supple
{
  /** The weight m g(X, t) of each node, with the potential energy -sum m g.u, which is zero at rest
   * position. */
  class Gravity : public Load
  {
  public:
    /** Null without gravity. @throws InputError */
    static std::unique_ptr<Force>
    make(const Body &body, const LoadParameters &parameters, const ParameterFile &scene);

    /** @param acceleration g [m/s^2]
     * @param origin where it is written @throws InputError if it is not finite */
    Gravity(const Body &body, Expression acceleration, const std::string &origin);

    std::string
    name() const override
    {
      return "gravity";
    }

    EnergyAccount
    account() const override
    {
      return EnergyAccount::potential;
    }

    /** -(G(t1) - G(t0)).u, with the weight G: by which the potential grows while nothing moves. */
    double
    work_of_time(const Configuration &configuration,
                 double time_before,
                 double time,
                 double weight_of_start) const override;

  private:
    const Vector &
    force_at(const Configuration &configuration, double time) const override;

    void
    set_weight(Vector &to, double time) const;

    void
    set_quadratic_weight(Vector &to, double time) const;

    const Body &body;
    const Expression acceleration;
    const std::vector<double> mass; ///< of owned nodes [kg]
    mutable Vector weight;
    mutable double weight_time = 0.; ///< of the weight that is kept
  };
} // namespace Supple

#endif
