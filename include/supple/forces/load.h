#ifndef supple_load_h
#define supple_load_h

#include <supple/forces/force.h>

namespace Supple
{
  /** A load that is kept as a vector. What it does is counted as work, unless it has a potential.
   */
  class Load : public Force
  {
  public:
    bool
    is_load() const override
    {
      return true;
    }

    EnergyAccount
    account() const override
    {
      return EnergyAccount::work;
    }

    bool
    is_linear() const override
    {
      return true;
    }

    void
    add_force(const Configuration &configuration, const double time, double *f) const override
    {
      const Vector &force = force_at(configuration, time);
      for (unsigned int dof = 0; dof < force.locally_owned_size(); ++dof)
        f[dof] += force.local_element(dof);
    }

    /** -f.u */
    double
    energy(const Configuration &configuration, const double time) const override
    {
      return -local_product(force_at(configuration, time), configuration.displacement());
    }

  private:
    /** The force [N]. Valid until the next call. */
    virtual const Vector &
    force_at(const Configuration &configuration, double time) const = 0;
  };
} // namespace Supple

#endif
