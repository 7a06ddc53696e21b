#ifndef supple_forces_h
#define supple_forces_h

#include <supple/contact/contact_parameters.h>
#include <supple/forces/elastic_force.h>
#include <supple/forces/load_parameters.h>

#include <functional>
#include <memory>
#include <vector>

namespace Supple
{
  class Contact;

  /** Energies of the forces on all processes [J]. */
  struct Energies
  {
    double elastic   = 0.;
    double potential = 0.;
    double contact   = 0.;
  };


  /**
   * All forces on the nodes of the body: those by which it resists to its deformation, and loads. A
   * new load is a Force and a line in forces.cc.
   */
  class Forces
  {
  public:
    /** @throws InputError */
    Forces(const Body &body,
           const MaterialParameters &material,
           const CorotationParameters &corotation,
           const DampingParameters &damping,
           const LoadParameters &loads,
           const ContactParameters &contact,
           const std::vector<ToolParameters> &tools,
           const ParameterFile &scene);

    ~Forces();

    /** That of tools and of bodies with each other; null in a scene without. */
    Contact *
    contact() const
    {
      return of_contact;
    }

    /** Adds a force; before the operator is made. */
    void
    add(std::unique_ptr<Force> force);

    /** The force of the cells, which every body has. */
    const ElasticForce &
    elastic() const
    {
      return *of_cells;
    }

    /** Whether all forces are linear in the displacement. */
    bool
    are_linear() const;

    /** Whether all forces but those of tools are linear in the displacement. */
    bool
    others_than_contact_are_linear() const;

    /** Whether the operator changes with the displacement. */
    bool
    change_operator() const;

    /** The same without the force of the cells. */
    bool
    others_change_operator() const;

    /** Whether forces other than that of the cells are part of the operator. */
    bool
    others_have_tangent() const;

    /** Whether a load depends on the displacement. */
    bool
    loads_follow() const;

    /** Whether all forces but loads have an energy. */
    bool
    have_energy() const;

    /** Whether what some force does is counted as work. */
    bool
    do_work() const;

    /** f = all forces at a time, of loads a part [N]; held entries are not set to zero. */
    void
    set_force(Vector &f,
              const Configuration &configuration,
              double time,
              Effort &effort,
              double load_factor = 1.) const;

    /** f = the sum of the loads [N]. */
    void
    set_loads(Vector &f, const Configuration &configuration, double time) const;

    /** Whether there are loads that do not depend on the displacement. */
    bool
    have_dead_loads() const;

    /** f = the sum of the loads that do not depend on the displacement, and of the parts of springs
     * that do not [N]. */
    void
    set_dead_loads(Vector &f, const Configuration &configuration, double time) const;

    /** f = the sum of all forces but those [N]. */
    void
    set_other_forces(Vector &f,
                     const Configuration &configuration,
                     double time,
                     Effort &effort) const;

    /** f = the sum of the forces that are counted as work [N]. */
    void
    set_working(Vector &f, const Configuration &configuration, double time) const;

    /** Energies, with a part of the loads, and volume ratios; collective.
     * @param deformation of this process's cells */
    Energies
    energies(const Configuration &configuration,
             double time,
             double load_factor,
             Deformation &deformation) const;

    /** The energy that equilibrium makes least, with this part of those loads that have one [J];
     * collective. */
    double
    energy(const Configuration &configuration, double time, double load_factor) const;

    /** The work of loads without energy on the straight way from a displacement [m] to that of the
     * configuration [J]; collective. */
    double
    work_along(const Configuration &configuration, double time, const Vector &from) const;

    /** As Force::work_of_time(), on all processes [J]; collective. */
    double
    work_of_time(const Configuration &configuration,
                 double time_before,
                 double time,
                 double weight) const;

    /** What has been dissipated since the start of the step [J]; collective. */
    double
    dissipated(const Configuration &configuration, double time) const;

    /** The largest part, up to 1, of a correction [m] that all allow. */
    double
    largest_step(const Configuration &configuration, const Vector &correction) const;

    /** Nodes that the pattern of the operator must couple beside those of cells. */
    Couplings
    couplings() const;

    /** Whether the couplings of some force change during a run. */
    bool
    couplings_come_and_go() const;

    /** Whether these are others than when connect() was called. */
    bool
    couplings_have_changed() const;

    /** Finds all places in matrices of this pattern, which must outlive the forces. */
    void
    connect(const SymmetricPattern &pattern);

    /** Takes the derivatives of all forces at a configuration, of loads a part. */
    void
    update_tangent(Tangent tangent,
                   const Configuration &configuration,
                   double time,
                   Effort &effort,
                   double load_factor = 1.);

    /** y -= (velocity df/dv + displacement df/du) w */
    void
    add_product(const Configuration &configuration,
                const TangentFactors &factors,
                const double *w,
                double *y) const;

    /** A += mass M - velocity df/dv - displacement df/du, but for patches.
     * @param added_bulk this many shear moduli are added to the bulk modulus of the cells */
    void
    add_tangent(const Configuration &configuration,
                const TangentFactors &factors,
                SymmetricBlockMatrix &A,
                double added_bulk) const;

    /** What round-off leaves of forces in balance [N]; collective. */
    double
    round_off(const Configuration &configuration) const;

  private:
    using Condition = std::function<bool(const Force &)>;

    bool
    any(const Condition &condition) const;

    /** f = the sum of those forces that a condition holds for. */
    void
    sum(Vector &f,
        const Configuration &configuration,
        double time,
        const Condition &condition) const;

    const Body &body;
    std::vector<std::unique_ptr<Force>> list; ///< that of the cells first
    ElasticForce *of_cells;
    Contact *of_contact = nullptr;
    mutable Vector loads; ///< at hand
  };
} // namespace Supple

#endif
