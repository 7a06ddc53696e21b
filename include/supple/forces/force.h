#ifndef supple_force_h
#define supple_force_h

#include <supple/mechanics/configuration.h>

#include <string>
#include <vector>

namespace Supple
{
  /** Where the energy of a force, or what it does, appears in the balance of energies. */
  enum class EnergyAccount
  {
    elastic,   ///< its energy is part of the column elastic
    potential, ///< its energy is part of the column potential
    contact,   ///< its energy is the column contact
    work,      ///< what it does is part of the column work
    dissipated ///< it has no energy: what it takes is part of the column dissipated
  };


  /** Pairs of local nodes whose blocks a force needs in the operator beside those of the cells. */
  using Couplings = std::vector<std::array<unsigned int, 2>>;


  /**
   * A force on the nodes of the body, f(u, v, t) [N], in arrays of 3 n_local doubles, node by node.
   * Residual, balance of energies, operator and its product are sums over a list of forces
   * (Forces).
   *
   * In a static scene the body's own forces balance a growing part of the loads.
   */
  class Force
  {
  public:
    virtual ~Force() = default;

    virtual std::string
    name() const = 0;

    virtual EnergyAccount
    account() const = 0;

    /** Whether it is a load, which grows to its size in the course of a static scene. */
    virtual bool
    is_load() const = 0;

    /** Whether f is linear in the displacement up to a constant. */
    virtual bool
    is_linear() const = 0;

    /** Whether its derivatives are part of the frozen and the definite operator too. */
    virtual bool
    has_tangent() const
    {
      return false;
    }

    /** Whether f is minus the gradient of energy(). */
    virtual bool
    has_energy() const
    {
      return true;
    }

    /** f += the force, on owned nodes; entries of ghosts may be written and mean nothing. */
    virtual void
    add_force(const Configuration &configuration, double time, double *f) const = 0;

    /** f += a part of what a load that is linear, and has a tangent, is without any displacement.
     */
    virtual void
    add_constant_part(double /*time*/, double /*part*/, double * /*f*/) const
    {
    }

    /** This process's part of the energy [J]; zero for a load without energy. */
    virtual double
    energy(const Configuration &configuration, double time) const = 0;

    /** The work that a load without energy does on the straight way from a displacement [m] to that
     * of the configuration [J]; this process's part. */
    virtual double
    work_along(const Configuration &, double /*time*/, const Vector & /*from*/) const
    {
      return 0.;
    }

    /** The work that a change of its potential in time does on the body from @p time_before on,
     * with the state at the start of the step taken by @p weight and that at the end by the rest
     * [J]; this process's part. */
    virtual double
    work_of_time(const Configuration &,
                 double /*time_before*/,
                 double /*time*/,
                 double /*weight*/) const
    {
      return 0.;
    }

    /** What it has dissipated since the start of the step [J]; this process's part. Asked in static
     * scenes: in motion the balance of energies tells it. */
    virtual double
    dissipated(const Configuration &, double /*time*/) const
    {
      return 0.;
    }

    /** The largest part, up to 1, of a correction [m] that it allows Newton's method of a static
     * scene. The same on all processes. */
    virtual double
    largest_step(const Configuration &, const Vector &) const
    {
      return 1.;
    }

    /** Adds the nodes that the pattern of the operator must couple for this force. Each process
     * that owns one of a pair must have the other as a ghost. */
    virtual void
    add_couplings(Couplings &) const
    {
    }

    /** Whether its couplings change during a run. */
    virtual bool
    couplings_come_and_go() const
    {
      return false;
    }

    /** Whether add_couplings() would add others than when connect() was called. */
    virtual bool
    couplings_have_changed() const
    {
      return false;
    }

    /** Finds its places in matrices of this pattern, which must outlive it. */
    virtual void
    connect(const SymmetricPattern &)
    {
    }

    /** Takes the derivatives at a configuration, with the part of the force that acts (in static
     * scenes loads grow); kept until called again. Those of a force without has_tangent() are part
     * of the consistent operator alone. */
    virtual void
    update_tangent(Tangent, const Configuration &, double /*time*/, double /*part*/)
    {
    }

    /** y -= (velocity df/dv + displacement df/du) w, with w at all local nodes. */
    virtual void
    add_product(const Configuration &,
                const TangentFactors &,
                const double * /*w*/,
                double * /*y*/) const
    {
    }

    /** A -= velocity df/dv + displacement df/du. The force of the cells also adds mass M. */
    virtual void
    add_tangent(const Configuration &, const TangentFactors &, SymmetricBlockMatrix &) const
    {
    }

    /** This process's sum over its nodes of (round-off in the force)^2 [N^2]. */
    virtual double
    round_off_square() const
    {
      return 0.;
    }
  };
} // namespace Supple

#endif
