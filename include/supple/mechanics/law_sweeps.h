#ifndef supple_law_sweeps_h
#define supple_law_sweeps_h

#include <supple/mechanics/volume_change.h>

#include <cmath>
#include <limits>

namespace Supple
{
  /** What a Law made of formulas is, whatever its cells are like. @p Sweeps is what is derived of
   * it, and adds the tangent of a batch by add_tangent_of_batch(). */
  template <class Formulas, class Sweeps>
  class LawOf : public Law
  {
  public:
    LawOf(const Formulas &formulas, const Cells &cells)
      : formulas(formulas)
      , cells(cells)
      , volume_stiffness(cells)
    {
      if constexpr (Formulas::tangent_is_whole)
        set_tangent_at_rest();
    }

    std::string
    name() const override
    {
      return formulas.name();
    }

    bool
    is_linear() const override
    {
      return formulas.is_linear();
    }

    bool
    has_energy() const override
    {
      return formulas.has_energy();
    }

    bool
    has_rotations() const override
    {
      return formulas.has_rotations();
    }

    bool
    tangent_is_frozen() const override
    {
      return turning.empty() && volume_stiffness.empty();
    }

    void
    add_tangent(const CellRotations &rotations,
                const double mass,
                const double frozen,
                const double turning_factor,
                const CellSlots &slots,
                SymmetricBlockMatrix &A,
                const double added_bulk) const override
    {
      cells.for_batches_in_turn([&](const std::size_t b) {
        ask_for_next(rotations.of_tangent(), b);
        slots.ask_for_next_after(b);
        sweeps().add_tangent_of_batch(
          rotations, b, mass, frozen, turning_factor, slots, A, added_bulk);
      });
      if (cells.vertex_mass > 0.)
        A.add_to_diagonal(mass * cells.vertex_mass);
    }

    std::size_t
    n_turned(const CellRotations &rotations, const double angle) const override
    {
      const double bound = square_of_difference(angle);
      std::size_t n      = 0;
      for (std::size_t b = 0; b < rotations.kept.size() / cells.n_points(); ++b)
        n +=
          std::experimental::popcount(has_turned(rotations, b, bound) && cells.batch(b).owned > 0.);
      return n;
    }

    void
    renew_tangent(CellRotations &rotations,
                  const double angle,
                  const double frozen,
                  const CellSlots &slots,
                  SymmetricBlockMatrix &A) const override
    {
      const double bound          = square_of_difference(angle);
      const unsigned int n_points = cells.n_points();
      for (std::size_t b = 0; b < rotations.kept.size() / n_points; ++b)
        {
          const Pack::mask_type turned = has_turned(rotations, b, bound);
          if (std::experimental::none_of(turned))
            continue;
          sweeps().add_tangent_of_batch(rotations, b, 0., -frozen, 0., slots, A, 0.);
          for (std::size_t place = n_points * b; place < n_points * (b + 1); ++place)
            for (unsigned int k = 0; k < 9; ++k)
              std::experimental::where(turned, rotations.kept[place].entries[k]) =
                rotations.current[place].entries[k];
          sweeps().add_tangent_of_batch(rotations, b, 0., frozen, 0., slots, A, 0.);
        }
    }

  protected:
    static Matrix3<Pack>
    rotation_of(const CellRotations::List &rotations, const std::size_t place)
    {
      return rotations.empty() ? Matrix3<Pack>::identity() : rotations[place];
    }

    /** |R - R'|^2 of two rotations that differ by this angle. */
    static double
    square_of_difference(const double angle)
    {
      const double sine = std::sin(0.5 * std::min(angle, M_PI));
      return 8. * sine * sine;
    }

    /** Whether a point of a cell has turned by more than an angle with this 8 sin(angle/2)^2. */
    Pack::mask_type
    has_turned(const CellRotations &rotations, const std::size_t b, const double bound) const
    {
      const unsigned int n_points = cells.n_points();
      Pack::mask_type turned(false);
      for (std::size_t place = n_points * b; place < n_points * (b + 1); ++place)
        {
          Matrix3<Pack> difference = rotations.current[place];
          for (unsigned int k = 0; k < 9; ++k)
            difference.entries[k] -= rotations.kept[place].entries[k];
          turned = turned || norm_square(difference) > bound;
        }
      return turned;
    }

    /** What the patches add to a tangent, and places for what the rotations add; false if these add
     * nothing. @param mean_stress as for update_tangent() */
    bool
    prepare_turning(const Tangent tangent,
                    const double *displacement,
                    const MeanStress *mean_stress)
    {
      if constexpr (Formulas::tangent_is_whole)
        return true;
      volume_stiffness.clear();
      if (tangent == Tangent::consistent && mean_stress &&
          mean_stress->measure == VolumeMeasure::determinant)
        volume_stiffness.update(displacement, mean_stress->of_points);

      const bool turns = tangent != Tangent::frozen && !is_linear();
      turning.resize(turns ? cells.n_points() * cells.n_batches() : 0);
      return turns;
    }

    /** Whether the second derivative is clamped; where nothing of it is left with rotations held,
     * that is what a frozen one is. */
    static bool
    is_definite(const Tangent tangent)
    {
      return tangent == Tangent::definite ||
             (Formulas::tangent_is_whole && tangent == Tangent::frozen);
    }

    /** What is not the own stress of the cells of a batch at a point, as far as the formulas take
     * it into the tangent: in the measure `trace`, or `determinant` where they are all of it. */
    Pack
    foreign_mean_stress(const MeanStress *mean_stress,
                        const std::size_t b,
                        const unsigned int q) const
    {
      constexpr VolumeMeasure taken =
        Formulas::tangent_is_whole ? VolumeMeasure::determinant : VolumeMeasure::trace;
      Pack s(0.);
      if (mean_stress && mean_stress->measure == taken)
        cells.for_lanes(b, [&](const unsigned int lane, const std::size_t cell) {
          s[lane] = mean_stress->of_points[cells.n_points() * cell + q];
        });
      return s;
    }

    /** Energy and extremes of some batches, before they are those of all. */
    struct DeformationSum
    {
      Pack elastic, inverted, smallest, largest;

      /** @param counted the lanes that this process owns */
      void
      include(const Pack &volume_ratio, const Pack::mask_type &counted)
      {
        using std::experimental::where;
        where(counted && volume_ratio < smallest, smallest) = volume_ratio;
        where(counted && volume_ratio > largest, largest)   = volume_ratio;
      }
    };

    /** @param add called with each batch and the sum it goes to */
    template <class Add>
    Deformation
    sum_of_deformations(const Add &add) const
    {
      namespace stdx = std::experimental;

      Deformation result;
      const DeformationSum zero{0., 0., result.min_volume_ratio, result.max_volume_ratio};
      for (const DeformationSum &sum : cells.sums_of_chunks(zero, add))
        {
          result.elastic += stdx::reduce(sum.elastic);
          result.min_volume_ratio = std::min(result.min_volume_ratio, stdx::hmin(sum.smallest));
          result.max_volume_ratio = std::max(result.max_volume_ratio, stdx::hmax(sum.largest));
          result.inverted += static_cast<unsigned int>(stdx::reduce(sum.inverted));
        }
      return result;
    }

    /** Calls action(cell, lane, state) for the cells of a batch with what is drawn of them at a
     * point. */
    template <class Action>
    void
    for_states(const std::size_t b,
               const Pack &volume_ratio,
               const Matrix3<Pack> &R,
               const Matrix3<Pack> &stress,
               const Action &action) const
    {
      Matrix3<Pack> deviator = stress;
      const Pack mean        = trace(stress) / 3.;
      for (unsigned int i = 0; i < 3; ++i)
        deviator(i, i) -= mean;
      const Pack von_mises = std::experimental::sqrt(1.5 * norm_square(deviator));
      const Pack cosine    = 0.5 * (trace(R) - 1.);
      cells.for_lanes(b, [&](const unsigned int lane, const std::size_t cell) {
        const double c = std::min(1., std::max(-1., double(cosine[lane])));
        action(
          cell,
          lane,
          CellState{volume_ratio[lane], von_mises[lane], std::acos(c) * 180. / M_PI, -mean[lane]});
      });
    }

    /** Of the cells of a batch at a point: how they have turned, and the stress that is drawn. */
    struct Drawn
    {
      Matrix3<Pack> R, stress;
    };

    Drawn
    drawn(const Cells::Batch &batch, const Matrix3<Pack> &R, const Matrix3<Pack> &F) const
    {
      if constexpr (Formulas::tangent_is_whole)
        return {formulas.turn(F), formulas.cauchy_stress(batch, F)};
      else
        return {R, formulas.stress(batch, R, F)};
    }

    const Formulas formulas;
    const Cells &cells;
    std::vector<typename Formulas::Turning> turning; ///< of the points; empty for frozen rotations
    VolumeStiffness volume_stiffness;                ///< empty but for determinants

  private:
    const Sweeps &
    sweeps() const
    {
      return static_cast<const Sweeps &>(*this);
    }

    /** For those who ask before there is a deformation. */
    void
    set_tangent_at_rest()
    {
      const unsigned int n_points = cells.n_points();
      const Matrix3<Pack> I       = Matrix3<Pack>::identity();
      turning.resize(n_points * cells.n_batches());
      for (std::size_t place = 0; place < turning.size(); ++place)
        turning[place] =
          formulas.turning(cells.is_quadratic() ? cells.point(place / n_points, place % n_points)
                                                : cells.batch(place),
                           I,
                           I,
                           I,
                           Pack(0.),
                           false);
    }
  };


  /**
   * The sweeps of a Law over all cells, made of its formulas for the cells of a batch, which are
   * compiled into them. @p Formulas is a struct with the members of Corotational:
   *
   *   name(), is_linear(), has_energy(), has_rotations()
   *
   *   rotation(F), rotation_in_plane(F): R of each cell, I for a law without
   *
   *   stress(batch, R, F): first Piola-Kirchhoff stress over R: R^T P [Pa]
   *
   *   energy_density(batch, R, F) [J/m^3]
   *
   *   stress_change(batch, R, dF), Blocks: the part of the tangent with R held; Blocks has h,
   *   shear(), entry() and hoop_stiffness
   *
   *   rotated_gradients(batch, R): h_a = R g_a
   *
   *   Turning, turning(batch, R, R of the strain, F, mean_stress, definite), turning_product(),
   *   turning_block(): the rest of it, which can be projected
   *
   *   tangent_is_whole: whether all of the tangent is in Turning, exact or definite, and nothing of
   * it holds a rotation. Then it is a matrix of nine rows (ElasticTangent) with the mean stress of
   * patches, Blocks is made of it, a frozen tangent is the definite one, and cauchy_stress() and
   * turn() are for drawing. Hyperelastic is of that kind.
   *
   * Stiffness damping counts on a stress that is linear in F with R held, up to a constant.
   */
  template <class Formulas>
  class LawSweeps : public LawOf<Formulas, LawSweeps<Formulas>>
  {
    using Base = LawOf<Formulas, LawSweeps<Formulas>>;

  public:
    using Base::Base;

    void
    update_rotations(const double *displacement, CellRotations::List &rotations) const override
    {
      if (rotations.empty())
        resize_in_huge_pages(rotations, cells.n_batches());
      if (cells.section.plane())
        cells.for_batches([&](const std::size_t b) {
          rotations[b] = formulas.rotation_in_plane(cells.deformation_gradient(b, displacement));
        });
      else
        cells.for_batches([&](const std::size_t b) {
          rotations[b] = formulas.rotation(cells.deformation_gradient(b, displacement));
        });
    }

    void
    subtract_force(const CellRotations &rotations,
                   const double *displacement,
                   double *force) const override
    {
      cells.for_batches_in_turn([&](const std::size_t b) {
        ask_for_next(rotations.current, b);
        const Matrix3<Pack> F = cells.deformation_gradient(b, displacement);
        scatter_stress<-1>(b,
                           rotations,
                           formulas.stress(cells.batch(b), rotation_of(rotations.current, b), F),
                           cells.batch(b).volume,
                           force);
      });
    }

    Deformation
    deformation(const CellRotations &rotations, const double *displacement) const override;

    std::vector<CellState>
    states(const CellRotations &rotations, const double *displacement) const override;

    std::vector<Matrix3<Pack>>
    stresses(const CellRotations &rotations, const double *displacement) const override
    {
      std::vector<Matrix3<Pack>> P(cells.n_batches());
      cells.for_batches([&](const std::size_t b) {
        ask_for_next(rotations.current, b);
        const Matrix3<Pack> R = rotation_of(rotations.current, b);
        P[b] = R * stress_in_section(b, R, cells.deformation_gradient(b, displacement));
      });
      return P;
    }

    double
    round_off_square() const override
    {
      constexpr double epsilon = 8. * std::numeric_limits<double>::epsilon();
      Pack sum(0.);
      for (std::size_t b = 0; b < cells.n_batches(); ++b)
        {
          const Cells::Batch &batch = cells.batch(b);
          const Pack stress = epsilon * batch.owned * batch.volume * (batch.lambda + 2. * batch.mu);
          for (const auto &g : batch.gradients)
            sum += stress * stress * (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
        }
      return std::experimental::reduce(sum);
    }

    void
    update_tangent(Tangent tangent,
                   const CellRotations &rotations,
                   const double *displacement,
                   const MeanStress *mean_stress) override;

    void
    add_frozen_product(const CellRotations &rotations,
                       const double factor,
                       const double *w,
                       double *y) const override
    {
      if constexpr (!Formulas::tangent_is_whole)
        cells.for_batches_in_turn([&](const std::size_t b) {
          ask_for_next(rotations.current, b);
          const Matrix3<Pack> dF = cells.gradient(b, Cells::gather(cells.batch(b), w));
          scatter_stress<1>(b,
                            rotations,
                            formulas.stress_change(cells.batch(b),
                                                   rotation_of(rotations.current, b),
                                                   dF),
                            factor * cells.batch(b).volume,
                            y);
        });
    }

    void
    add_turning_product(const CellRotations &rotations,
                        const double factor,
                        const double *w,
                        double *y) const override
    {
      if constexpr (Formulas::tangent_is_whole)
        {
          cells.for_batches_in_turn([&](const std::size_t b) {
            Matrix3<Pack> P =
              turning[b].stress_change(cells.gradient(b, Cells::gather(cells.batch(b), w)));
            for (Pack &entry : P.entries)
              entry *= factor;
            Cells::scatter(cells.batch(b), cells.divergence(b, P), y);
          });
          return;
        }
      else
        {
          volume_stiffness.add_product(factor, w, y);
          for (std::size_t b = 0; b < turning.size(); ++b)
            {
              const Cells::Batch &batch = cells.batch(b);
              Cells::NodalPack f        = formulas.turning_product(turning[b],
                                                            rotated_gradients(rotations, b),
                                                            Cells::gather(batch, w));
              for (auto &of_node : f)
                for (Pack &component : of_node)
                  component *= factor;
              Cells::scatter(batch, f, y);
            }
        }
    }

    void
    add_vertex_tangent(const CellRotations &rotations,
                       const double mass,
                       const double frozen,
                       const double turning_factor,
                       const CellSlots &slots,
                       SymmetricBlockMatrix &A,
                       const double added_bulk) const override
    {
      this->add_tangent(rotations, mass, frozen, turning_factor, slots, A, added_bulk);
    }

  private:
    friend Base;
    using Base::cells;
    using Base::formulas;
    using Base::rotation_of;
    using Base::turning;
    using Base::volume_stiffness;

    /** In the rotated frame, without what formulas in space have along z in plane stress. */
    Matrix3<Pack>
    stress_in_section(const std::size_t b, const Matrix3<Pack> &R, const Matrix3<Pack> &F) const
    {
      Matrix3<Pack> P = formulas.stress(cells.batch(b), R, F);
      if (cells.section.geometry == Geometry::plane_stress)
        P(2, 2) = 0.;
      return P;
    }

    /** Of the cells of a batch, with the thinning of a body in plane stress. */
    Pack
    volume_ratio(std::size_t b, const Matrix3<Pack> &R, const Matrix3<Pack> &F) const;

    Cells::NodalPack
    rotated_gradients(const CellRotations &rotations, const std::size_t b) const
    {
      const CellRotations::List &R = rotations.of_tangent();
      return R.empty() ? cells.batch(b).gradients
                       : formulas.rotated_gradients(cells.batch(b), R[b]);
    }

    /** Adds the forces of a stress in the rotated frame to the nodes, or subtracts them. */
    template <int sign>
    void
    scatter_stress(const std::size_t b,
                   const CellRotations &rotations,
                   Matrix3<Pack> P,
                   const Pack &volume,
                   double *force) const
    {
      if (!rotations.current.empty())
        P = rotations.current[b] * P;
      for (Pack &entry : P.entries)
        entry *= volume;
      Cells::scatter<sign>(cells.batch(b), cells.divergence(b, P), force);
    }

    void
    add_tangent_of_batch(const CellRotations &rotations,
                         const std::size_t b,
                         const double mass,
                         const double frozen,
                         const double turning_factor,
                         const CellSlots &slots,
                         SymmetricBlockMatrix &A,
                         const double added_bulk) const
    {
      if (cells.section.axisymmetric())
        add_tangent_of<true>(rotations, b, mass, frozen, turning_factor, slots, A, added_bulk);
      else
        add_tangent_of<false>(rotations, b, mass, frozen, turning_factor, slots, A, added_bulk);
    }

    template <bool axisymmetric>
    void
    add_tangent_of(const CellRotations &rotations,
                   std::size_t b,
                   double mass,
                   double frozen,
                   double turning_factor,
                   const CellSlots &slots,
                   SymmetricBlockMatrix &A,
                   double added_bulk) const;
  };


  template <class Formulas>
  template <bool axisymmetric>
  inline void
  LawSweeps<Formulas>::add_tangent_of(const CellRotations &rotations,
                                      const std::size_t b,
                                      const double mass,
                                      const double frozen,
                                      const double turning_factor,
                                      const CellSlots &slots,
                                      SymmetricBlockMatrix &A,
                                      const double added_bulk) const
  {
    using Blocks                  = typename Formulas::template Blocks<axisymmetric>;
    const Cells::Hoop *const hoop = axisymmetric ? &cells.hoop(b) : nullptr;
    const auto blocks             = [&] {
      if constexpr (Formulas::tangent_is_whole)
        return Blocks(turning[b], cells.batch(b), hoop, turning_factor, added_bulk);
      else
        return Blocks(cells.batch(b), hoop, rotated_gradients(rotations, b), frozen, added_bulk);
    }();
    const Pack same     = mass * cells.mass_entry(b, 0, 0);
    const Pack other    = mass * cells.mass_entry(b, 0, 1);
    const bool turns    = !Formulas::tangent_is_whole && !turning.empty();
    const bool swelling = !volume_stiffness.empty();

    const auto add_block =
      [&](const unsigned int a, const unsigned int c, const auto &slot, double *values) {
        Pack diagonal = blocks.shear(a, c);
        if constexpr (axisymmetric)
          diagonal += mass * cells.mass_entry(b, a, c);
        else
          diagonal += a == c ? same : other;
        std::array<std::array<Pack, 3>, 3> turn, swell;
        if constexpr (!Formulas::tangent_is_whole)
          if (turns)
            turn = formulas.turning_block(turning[b], blocks.h[a], blocks.h[c]);
        if (swelling)
          swell = volume_stiffness.block(b, a, c);
        alignas(64) double block[9][n_lanes];
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            {
              Pack entry = blocks.entry(a, c, i, j, diagonal);
              if (turns)
                entry += turning_factor * turn[j][i];
              if (swelling)
                entry += turning_factor * swell[j][i];
              if (axisymmetric && i == 0 && j == 0)
                entry += blocks.hoop_stiffness;
              entry.copy_to(block[3 * i + j], std::experimental::vector_aligned);
            }
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            double *target = values + 9 * static_cast<std::size_t>(slot[lane]);
            for (unsigned int k = 0; k < 9; ++k)
              target[k] += block[k][lane];
          }
      };

    for (unsigned int a = 0; a < 4; ++a)
      add_block(a, a, slots.diagonal(b)[a], A.diagonal.data());
    for (unsigned int p = 0; p < 6; ++p)
      add_block(CellSlots::lower_pairs[p][0],
                CellSlots::lower_pairs[p][1],
                slots.lower(b)[p],
                A.lower.data());
  }


  template <class Formulas>
  void
  LawSweeps<Formulas>::update_tangent(const Tangent tangent,
                                      const CellRotations &rotations,
                                      const double *displacement,
                                      const MeanStress *mean_stress)
  {
    if (!this->prepare_turning(tangent, displacement, mean_stress))
      return;
    const auto update = [&](const std::size_t b) {
      turning[b] = formulas.turning(cells.batch(b),
                                    rotation_of(rotations.current, b),
                                    rotation_of(rotations.of_strain(), b),
                                    cells.deformation_gradient(b, displacement),
                                    this->foreign_mean_stress(mean_stress, b, 0),
                                    this->is_definite(tangent));
    };
    if constexpr (Formulas::tangent_is_whole)
      cells.for_batches(update);
    else
      for (std::size_t b = 0; b < turning.size(); ++b)
        update(b);
  }


  /** In plane stress 2 mu e33 + lambda (e11 + e22 + e33) = 0 says how thin the body has become.
   * With the lambda of effective() e33 is the stress that plane strain would have along z, over -2
   * mu. */
  template <class Formulas>
  Pack
  LawSweeps<Formulas>::volume_ratio(const std::size_t b,
                                    const Matrix3<Pack> &R,
                                    const Matrix3<Pack> &F) const
  {
    const Pack ratio = determinant(F);
    if (cells.section.geometry != Geometry::plane_stress)
      return ratio;
    const Cells::Batch &batch = cells.batch(b);
    return ratio * (1. - formulas.stress(batch, R, F)(2, 2) / (2. * batch.mu));
  }


  template <class Formulas>
  Deformation
  LawSweeps<Formulas>::deformation(const CellRotations &rotations, const double *displacement) const
  {
    return this->sum_of_deformations([&](const std::size_t b, auto &sum) {
      ask_for_next(rotations.current, b);
      const Cells::Batch &batch = cells.batch(b);
      const Matrix3<Pack> F     = cells.deformation_gradient(b, displacement);
      sum.elastic += batch.owned * batch.volume *
                     formulas.energy_density(batch, rotation_of(rotations.current, b), F);

      const auto counted = batch.owned > 0.;
      sum.include(volume_ratio(b, rotation_of(rotations.current, b), F), counted);
      std::experimental::where(counted && !(determinant(F) > 0.), sum.inverted) += 1.;
    });
  }


  template <class Formulas>
  std::vector<CellState>
  LawSweeps<Formulas>::states(const CellRotations &rotations, const double *displacement) const
  {
    std::vector<CellState> states(cells.n_cells);
    cells.for_batches([&](const std::size_t b) {
      ask_for_next(rotations.current, b);
      const Matrix3<Pack> F = cells.deformation_gradient(b, displacement);
      const Matrix3<Pack> R = rotation_of(rotations.current, b);
      auto [turn, stress]   = this->drawn(cells.batch(b), R, F);
      if (cells.section.geometry == Geometry::plane_stress)
        stress(2, 2) = 0.;
      this->for_states(b,
                       volume_ratio(b, R, F),
                       turn,
                       stress,
                       [&](const std::size_t cell, unsigned int, const CellState &state) {
                         states[cell] = state;
                       });
    });
    return states;
  }
} // namespace Supple

#endif
