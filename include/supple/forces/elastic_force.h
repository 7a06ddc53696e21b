#ifndef supple_elastic_force_h
#define supple_elastic_force_h

#include <supple/forces/force.h>

#include <memory>

namespace Supple
{
  /**
   * The force by which the body resists to its deformation and, with stiffness damping b, to its
   * speed: f = -f_int(u) - b K v, by the law of the cells and by patches of cells if there are any.
   *
   * K has the rotations of the configuration, or those that are kept for the tangent. The mass of
   * the cells goes into the operator in the same sweep.
   */
  class ElasticForce : public Force
  {
  public:
    /** @param stiffness_damping b [s] */
    ElasticForce(const Body &body, std::unique_ptr<Law> law, double stiffness_damping);

    std::string
    name() const override
    {
      return law->name();
    }

    EnergyAccount
    account() const override
    {
      return EnergyAccount::elastic;
    }

    bool
    is_load() const override
    {
      return false;
    }

    bool
    is_linear() const override
    {
      return law->is_linear();
    }

    bool
    has_tangent() const override
    {
      return true;
    }

    bool
    has_energy() const override
    {
      return law->has_energy();
    }

    void
    add_force(const Configuration &configuration, double time, double *f) const override;

    double
    energy(const Configuration &configuration, double /*time*/) const override
    {
      return deformation(configuration).elastic;
    }

    /** Energy and volume ratios in one sweep. */
    Deformation
    deformation(const Configuration &configuration) const;

    /** For each cell of the body, with the pressure of patches. */
    std::vector<CellState>
    states(const Configuration &configuration) const;

    void
    connect(const SymmetricPattern &pattern) override;

    /** The places of the cells in the operator. */
    const CellSlots &
    cell_slots() const
    {
      return *slots;
    }

    void
    update_tangent(Tangent tangent,
                   const Configuration &configuration,
                   double time,
                   double part) override;

    /** Whether the tangent is free of derivatives of the rotations. */
    bool
    tangent_is_frozen() const
    {
      return law->tangent_is_frozen();
    }

    void
    add_product(const Configuration &configuration,
                const TangentFactors &factors,
                const double *w,
                double *y) const override;

    /** Without patches, which are no part of the matrix: see ImplicitOperator. */
    void
    add_tangent(const Configuration &configuration,
                const TangentFactors &factors,
                SymmetricBlockMatrix &A) const override
    {
      add_bounded_tangent(configuration, factors, A, 0.);
    }

    /** The same with this many shear moduli added to the bulk modulus. */
    void
    add_bounded_tangent(const Configuration &configuration,
                        const TangentFactors &factors,
                        SymmetricBlockMatrix &A,
                        double added_bulk) const;

    /** As Law::add_vertex_tangent(). */
    void
    add_vertex_tangent(const Configuration &configuration,
                       const TangentFactors &factors,
                       const CellSlots &of_corners,
                       SymmetricBlockMatrix &A,
                       const double added_bulk) const
    {
      law->add_vertex_tangent(configuration.rotations,
                              factors.mass,
                              stiffness_factor(factors),
                              factors.displacement,
                              of_corners,
                              A,
                              added_bulk);
    }

    /** What the frozen K has in the operator: displacement + b velocity. */
    double
    stiffness_factor(const TangentFactors &factors) const
    {
      return factors.displacement + factors.velocity * stiffness_damping;
    }

    /** As Law::n_turned(). */
    std::size_t
    n_turned(const Configuration &configuration, const double angle) const
    {
      return law->n_turned(configuration.rotations, angle);
    }

    /** As Law::renew_tangent(). */
    void
    renew_tangent(Configuration &configuration,
                  const double angle,
                  const TangentFactors &factors,
                  SymmetricBlockMatrix &A) const
    {
      law->renew_tangent(configuration.rotations, angle, stiffness_factor(factors), *slots, A);
    }

    double
    round_off_square() const override
    {
      return law->round_off_square();
    }

    const Law &
    cell_law() const
    {
      return *law;
    }

  private:
    const Body &body;
    const std::unique_ptr<Law> law;
    const double stiffness_damping; ///< b [s]
    std::unique_ptr<const CellSlots> slots;
    mutable Vector damped; ///< u + b v, at hand; empty without b
  };
} // namespace Supple

#endif
