#ifndef supple_tests_elastic_cells_h
#define supple_tests_elastic_cells_h

#include <supple/mechanics/laws.h>

#include <memory>
#include <vector>

namespace Supple
{
  /** Cells with corotational elasticity and rotations of their own, for tests of both together. */
  class ElasticCells
  {
  public:
    struct Sums : Deformation, MotionSums
    {
    };

    template <class... Arguments>
    explicit ElasticCells(Arguments &&...arguments)
      : cells(std::make_unique<const Cells>(std::forward<Arguments>(arguments)...))
    {
      set_method(RotationMethod::none);
    }

    void
    set_method(const RotationMethod method)
    {
      law = make_law(LawChoice(), method, *cells);
    }

    void
    update_rotations(const RotationMethod method, const double *u)
    {
      set_method(method);
      law->update_rotations(u, rotations.current);
    }

    void
    add_internal_force(const double *u, std::vector<double> &f) const
    {
      std::vector<double> force(f.size());
      law->subtract_force(rotations, u, force.data());
      for (std::size_t i = 0; i < f.size(); ++i)
        f[i] -= force[i];
    }

    Sums
    sums(const double *u, const double *v) const
    {
      Sums sums;
      static_cast<Deformation &>(sums) = law->deformation(rotations, u);
      if (v != nullptr)
        {
          std::vector<double> momentum(3 * cells->n_owned);
          cells->add_mass_product(v, momentum.data());
          static_cast<MotionSums &>(sums) = cells->motion(u, v, momentum.data());
        }
      return sums;
    }

    std::vector<CellState>
    states(const double *u) const
    {
      return law->states(rotations, u);
    }

    void
    update_tangent(const Tangent tangent, const double *u, const MeanStress *mean_stress = nullptr)
    {
      law->update_tangent(tangent, rotations, u, mean_stress);
    }

    void
    add_frozen_product(const double *w, double *y) const
    {
      law->add_frozen_product(rotations, 1., w, y);
    }

    void
    add_turning_product(const double *w, double *y) const
    {
      law->add_turning_product(rotations, 1., w, y);
    }

    void
    connect(const SymmetricPattern &pattern)
    {
      slots = std::make_unique<const CellSlots>(*cells, pattern);
    }

    void
    add_tangent(const double mass,
                const double frozen,
                const double turning,
                SymmetricBlockMatrix &A) const
    {
      law->add_tangent(rotations, mass, frozen, turning, *slots, A);
    }

    void
    add_mass(SymmetricScalarMatrix &M) const
    {
      cells->add_mass(*slots, M);
    }

    std::unique_ptr<const Cells> cells;
    std::unique_ptr<Law> law;
    CellRotations rotations;
    std::unique_ptr<const CellSlots> slots;
  };
} // namespace Supple

#endif
