#include <supple/forces/elastic_force.h>

#include <supple/mechanics/law_choice.h>

namespace Supple
{
  ElasticForce::ElasticForce(const Body &body,
                             std::unique_ptr<Law> law,
                             const double stiffness_damping)
    : body(body)
    , law(std::move(law))
    , stiffness_damping(stiffness_damping)
  {
    if (stiffness_damping > 0.)
      body.initialize(damped);
  }


  /** For the rotations of the moment the force is linear: f_int(u) + b K v = f_int(u + b v). */
  void
  ElasticForce::add_force(const Configuration &configuration, double, double *f) const
  {
    const bool damps = stiffness_damping > 0. && configuration.state.has_velocity();
    if (damps)
      {
        damped = configuration.displacement();
        damped.add(stiffness_damping, configuration.velocity());
      }
    const GhostValues values(damps ? damped : configuration.displacement());
    law->subtract_force(configuration.rotations, values.data(), f);
    if (configuration.patches)
      configuration.patches->subtract_force(values.data(), f);
  }


  Deformation
  ElasticForce::deformation(const Configuration &configuration) const
  {
    const GhostValues values(configuration.displacement());
    Deformation result = law->deformation(configuration.rotations, values.data());
    if (configuration.patches)
      result.elastic += configuration.patches->energy(values.data());
    return result;
  }


  std::vector<CellState>
  ElasticForce::states(const Configuration &configuration) const
  {
    const GhostValues values(configuration.displacement());
    std::vector<CellState> states = law->states(configuration.rotations, values.data());
    if (configuration.patches)
      {
        // Quadratic cells keep a part of the resistance, and a shear stress by energy has a mean.
        const bool adds = body.is_quadratic() || LawChoice{law->name()}.is_hyperelastic();
        const std::vector<double> mean_stress =
          configuration.patches->mean_stress_of_cells(values.data());
        for (std::size_t c = 0; c < states.size(); ++c)
          states[c].pressure = (adds ? states[c].pressure : 0.) - mean_stress[c];
      }
    return states;
  }


  void
  ElasticForce::connect(const SymmetricPattern &pattern)
  {
    slots = std::make_unique<const CellSlots>(*body.cells, pattern);
  }


  void
  ElasticForce::update_tangent(const Tangent tangent,
                               const Configuration &configuration,
                               double,
                               double)
  {
    const GhostValues values(configuration.displacement());
    if (!configuration.patches)
      {
        law->update_tangent(tangent, configuration.rotations, values.data());
        return;
      }
    const MeanStress mean_stress{configuration.patches->measure,
                                 configuration.patches->mean_stress(values.data())};
    law->update_tangent(tangent, configuration.rotations, values.data(), &mean_stress);
  }


  void
  ElasticForce::add_product(const Configuration &configuration,
                            const TangentFactors &factors,
                            const double *w,
                            double *y) const
  {
    const double frozen = stiffness_factor(factors);
    law->add_frozen_product(configuration.rotations, frozen, w, y);
    if (configuration.patches)
      configuration.patches->add_product(frozen, w, y);
    if (factors.displacement != 0.)
      law->add_turning_product(configuration.rotations, factors.displacement, w, y);
  }


  void
  ElasticForce::add_bounded_tangent(const Configuration &configuration,
                                    const TangentFactors &factors,
                                    SymmetricBlockMatrix &A,
                                    const double added_bulk) const
  {
    law->add_tangent(configuration.rotations,
                     factors.mass,
                     stiffness_factor(factors),
                     factors.displacement,
                     *slots,
                     A,
                     added_bulk);
  }
} // namespace Supple
