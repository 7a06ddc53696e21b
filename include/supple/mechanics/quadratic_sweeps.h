#ifndef supple_quadratic_sweeps_h
#define supple_quadratic_sweeps_h

#include <supple/mechanics/law_sweeps.h>
#include <supple/mechanics/quadratic_cells.h>

namespace Supple
{
  /**
   * The sweeps of a Law over quadratic cells: each of their four points is a linear cell to the
   * formulas (Cells::point()), with a rotation of its own. With one rotation a cell a body would be
   * too soft in bending, by an error of first order in the turn within a cell.
   *
   *   f_a = sum_q sum_k dN_a/dL_k f_k(q),   K_ab = sum_q sum_kl dN_a/dL_k dN_b/dL_l K_kl(q)
   *
   * Point q of batch b has the place 4 b + q in lists of rotations and stresses. Numbers of a cell
   * are means over its volume; extremes are those over points, and a cell is inverted where one of
   * its points is.
   */
  template <class Formulas>
  class QuadraticSweeps : public LawOf<Formulas, QuadraticSweeps<Formulas>>
  {
    using Base = LawOf<Formulas, QuadraticSweeps<Formulas>>;

  public:
    using Base::Base;

    void
    update_rotations(const double *displacement, CellRotations::List &rotations) const override
    {
      if (rotations.empty())
        resize_in_huge_pages(rotations, n_points * cells.n_batches());
      cells.for_batches([&](const std::size_t b) {
        const auto W = corner_values(b, displacement);
        for (unsigned int q = 0; q < n_points; ++q)
          rotations[n_points * b + q] =
            formulas.rotation(deformation_gradient(cells.point(b, q), W[q]));
      });
    }

    void
    subtract_force(const CellRotations &rotations,
                   const double *displacement,
                   double *force) const override
    {
      scatter_stresses<-1>(
        rotations,
        displacement,
        1.,
        [this](const Batch &point, const auto &R, const NodalPack &W) {
          return formulas.stress(point, R, deformation_gradient(point, W));
        },
        force);
    }

    Deformation
    deformation(const CellRotations &rotations, const double *displacement) const override;

    std::vector<CellState>
    states(const CellRotations &rotations, const double *displacement) const override;

    std::vector<Matrix3<Pack>>
    stresses(const CellRotations &rotations, const double *displacement) const override
    {
      std::vector<Matrix3<Pack>> P(n_points * cells.n_batches());
      cells.for_batches([&](const std::size_t b) {
        const auto W = corner_values(b, displacement);
        for (unsigned int q = 0; q < n_points; ++q)
          {
            const Batch point     = cells.point(b, q);
            const Matrix3<Pack> R = rotation_of(rotations.current, n_points * b + q);
            P[n_points * b + q] = R * formulas.stress(point, R, deformation_gradient(point, W[q]));
          }
      });
      return P;
    }

    double
    round_off_square() const override;

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
        scatter_stresses<1>(
          rotations,
          w,
          factor,
          [this](const Batch &point, const auto &R, const NodalPack &W) {
            return formulas.stress_change(point, R, Quadratic::gradient(point, W));
          },
          y);
    }

    void
    add_turning_product(const CellRotations &rotations,
                        double factor,
                        const double *w,
                        double *y) const override;

    void
    add_vertex_tangent(const CellRotations &rotations,
                       double mass,
                       double frozen,
                       double turning_factor,
                       const CellSlots &slots,
                       SymmetricBlockMatrix &A,
                       double added_bulk) const override;

  private:
    friend Base;
    using Base::cells;
    using Base::formulas;
    using Base::rotation_of;
    using Base::turning;
    using Base::volume_stiffness;
    using Batch     = Cells::Batch;
    using NodalPack = Cells::NodalPack;

    static constexpr unsigned int n_points = Quadratic::n_points;

    /** The tangent of a point: a block of nine entries, by rows, for each pair of corners. */
    using CornerBlocks = std::array<std::array<std::array<Pack, 9>, 4>, 4>;

    Quadratic::PointValues
    corner_values(const std::size_t b, const double *nodal) const
    {
      return Quadratic::at_points(Quadratic::gather(cells.nodes_of(b), nodal));
    }

    static Matrix3<Pack>
    deformation_gradient(const Batch &point, const NodalPack &W)
    {
      Matrix3<Pack> F = Quadratic::gradient(point, W);
      for (unsigned int i = 0; i < 3; ++i)
        F(i, i) += 1.;
      return F;
    }

    NodalPack
    rotated_gradients(const CellRotations &rotations,
                      const std::size_t place,
                      const Batch &point) const
    {
      const CellRotations::List &R = rotations.of_tangent();
      return R.empty() ? point.gradients : formulas.rotated_gradients(point, R[place]);
    }

    /** Adds factor times the forces of a stress at all points to the nodes, or subtracts them.
     * @param stress (point, R, corner values) in the rotated frame */
    template <int sign, class Stress>
    void
    scatter_stresses(const CellRotations &rotations,
                     const double *nodal,
                     const double factor,
                     const Stress &stress,
                     double *to) const
    {
      cells.for_batches_in_turn([&](const std::size_t b) {
        const auto W = corner_values(b, nodal);
        Quadratic::PointValues f;
        for (unsigned int q = 0; q < n_points; ++q)
          {
            const Batch point     = cells.point(b, q);
            const Matrix3<Pack> R = rotation_of(rotations.current, n_points * b + q);
            f[q] = Quadratic::divergence(point, R * stress(point, R, W[q]), factor * point.volume);
          }
        Quadratic::scatter<sign>(cells.nodes_of(b), Quadratic::to_nodes(f), to);
      });
    }

    /** The columns of the part of corners k, l in the second derivative of det F at a point. */
    std::array<std::array<Pack, 3>, 3>
    swelling_block(const std::size_t place,
                   const Batch &point,
                   const unsigned int k,
                   const unsigned int l) const
    {
      std::array<std::array<Pack, 3>, 3> columns;
      for (unsigned int j = 0; j < 3; ++j)
        {
          NodalPack unit{};
          unit[l][j]            = Pack(1.);
          const Matrix3<Pack> P = volume_stiffness.stress(place, Quadratic::gradient(point, unit));
          columns[j]            = Quadratic::divergence(point, P, Pack(1.))[k];
        }
      return columns;
    }

    void
    set_corner_blocks(const CellRotations &rotations,
                      std::size_t place,
                      const Batch &point,
                      double frozen,
                      double turning_factor,
                      double added_bulk,
                      CornerBlocks &K) const;

    void
    add_tangent_of_batch(const CellRotations &rotations,
                         std::size_t b,
                         double mass,
                         double frozen,
                         double turning_factor,
                         const CellSlots &slots,
                         SymmetricBlockMatrix &A,
                         double added_bulk) const;

    /** The block of nodes a, c, summed over the points. */
    static std::array<Pack, 9>
    block_of(const std::array<CornerBlocks, n_points> &K, unsigned int a, unsigned int c);

    /** @param transposed a bit for each lane that keeps the transposed block */
    static void
    add_block(const std::array<Pack, 9> &block,
              const CellSlots::Slot &slot,
              unsigned int transposed,
              double *values);
  };


  template <class Formulas>
  double
  QuadraticSweeps<Formulas>::round_off_square() const
  {
    constexpr double epsilon = 8. * std::numeric_limits<double>::epsilon();
    Pack sum(0.);
    for (std::size_t b = 0; b < cells.n_batches(); ++b)
      for (unsigned int q = 0; q < n_points; ++q)
        {
          const Batch point = cells.point(b, q);
          const Pack stress = epsilon * point.owned * point.volume * (point.lambda + 2. * point.mu);
          for (unsigned int a = 0; a < Quadratic::n_nodes; ++a)
            for (unsigned int i = 0; i < 3; ++i)
              {
                Pack G(0.);
                for (unsigned int k = 0; k < 4; ++k)
                  G += Quadratic::slope(a, k, q) * point.gradients[k][i];
                sum += stress * stress * G * G;
              }
        }
    return std::experimental::reduce(sum);
  }


  template <class Formulas>
  void
  QuadraticSweeps<Formulas>::update_tangent(const Tangent tangent,
                                            const CellRotations &rotations,
                                            const double *displacement,
                                            const MeanStress *const mean_stress)
  {
    if (!this->prepare_turning(tangent, displacement, mean_stress))
      return;
    cells.for_batches([&](const std::size_t b) {
      const auto W = corner_values(b, displacement);
      for (unsigned int q = 0; q < n_points; ++q)
        {
          const Batch point = cells.point(b, q);
          turning[n_points * b + q] =
            formulas.turning(point,
                             rotation_of(rotations.current, n_points * b + q),
                             rotation_of(rotations.of_strain(), n_points * b + q),
                             deformation_gradient(point, W[q]),
                             this->foreign_mean_stress(mean_stress, b, q),
                             this->is_definite(tangent));
        }
    });
  }


  template <class Formulas>
  void
  QuadraticSweeps<Formulas>::add_turning_product(const CellRotations &rotations,
                                                 const double factor,
                                                 const double *w,
                                                 double *y) const
  {
    if (this->tangent_is_frozen())
      return;
    cells.for_batches_in_turn([&](const std::size_t b) {
      const auto W = corner_values(b, w);
      Quadratic::PointValues f{};
      for (unsigned int q = 0; q < n_points; ++q)
        {
          const std::size_t place = n_points * b + q;
          const Batch point       = cells.point(b, q);
          if constexpr (Formulas::tangent_is_whole)
            f[q] =
              Quadratic::divergence(point,
                                    turning[place].stress_change(Quadratic::gradient(point, W[q])),
                                    Pack(1.));
          else if (!turning.empty())
            f[q] = formulas.turning_product(turning[place],
                                            rotated_gradients(rotations, place, point),
                                            W[q]);
          if (!volume_stiffness.empty())
            {
              const Matrix3<Pack> P =
                volume_stiffness.stress(place, Quadratic::gradient(point, W[q]));
              const NodalPack swell = Quadratic::divergence(point, P, Pack(1.));
              for (unsigned int k = 0; k < 4; ++k)
                for (unsigned int i = 0; i < 3; ++i)
                  f[q][k][i] += swell[k][i];
            }
          for (auto &of_corner : f[q])
            for (Pack &component : of_corner)
              component *= factor;
        }
      Quadratic::scatter(cells.nodes_of(b), Quadratic::to_nodes(f), y);
    });
  }


  template <class Formulas>
  void
  QuadraticSweeps<Formulas>::set_corner_blocks(const CellRotations &rotations,
                                               const std::size_t place,
                                               const Batch &point,
                                               const double frozen,
                                               const double turning_factor,
                                               const double added_bulk,
                                               CornerBlocks &K) const
  {
    using Blocks      = typename Formulas::template Blocks<false>;
    const auto blocks = [&] {
      if constexpr (Formulas::tangent_is_whole)
        return Blocks(turning[place], point, nullptr, turning_factor, added_bulk);
      else
        return Blocks(
          point, nullptr, rotated_gradients(rotations, place, point), frozen, added_bulk);
    }();
    const bool turns  = !Formulas::tangent_is_whole && !turning.empty();
    const bool swells = !volume_stiffness.empty();
    for (unsigned int k = 0; k < 4; ++k)
      for (unsigned int l = 0; l <= k; ++l)
        {
          const Pack diagonal = blocks.shear(k, l);
          std::array<std::array<Pack, 3>, 3> turn, swell;
          if constexpr (!Formulas::tangent_is_whole)
            if (turns)
              turn = formulas.turning_block(turning[place], blocks.h[k], blocks.h[l]);
          if (swells)
            swell = swelling_block(place, point, k, l);
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              {
                Pack entry = blocks.entry(k, l, i, j, diagonal);
                if (turns)
                  entry += turning_factor * turn[j][i];
                if (swells)
                  entry += turning_factor * swell[j][i];
                K[k][l][3 * i + j] = entry;
                if (k != l)
                  K[l][k][3 * j + i] = entry;
              }
        }
  }


  template <class Formulas>
  std::array<Pack, 9>
  QuadraticSweeps<Formulas>::block_of(const std::array<CornerBlocks, n_points> &K,
                                      const unsigned int a,
                                      const unsigned int c)
  {
    std::array<Pack, 9> block;
    for (Pack &entry : block)
      entry = 0.;
    for (unsigned int m = 0; m < (Quadratic::is_corner(a) ? 1 : 2); ++m)
      for (unsigned int n = 0; n < (Quadratic::is_corner(c) ? 1 : 2); ++n)
        {
          const unsigned int k = Quadratic::corners[a][m], l = Quadratic::corners[c][n];
          for (unsigned int q = 0; q < n_points; ++q)
            {
              const Pack factor(Quadratic::slope(a, k, q) * Quadratic::slope(c, l, q));
              for (unsigned int e = 0; e < 9; ++e)
                block[e] += factor * K[q][k][l][e];
            }
        }
    return block;
  }


  template <class Formulas>
  void
  QuadraticSweeps<Formulas>::add_block(const std::array<Pack, 9> &block,
                                       const CellSlots::Slot &slot,
                                       const unsigned int transposed,
                                       double *const values)
  {
    alignas(64) double entries[9][n_lanes];
    for (unsigned int e = 0; e < 9; ++e)
      block[e].copy_to(entries[e], std::experimental::vector_aligned);
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      {
        double *const target = values + 9 * static_cast<std::size_t>(slot[lane]);
        if (transposed >> lane & 1u)
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              target[3 * i + j] += entries[3 * j + i][lane];
        else
          for (unsigned int e = 0; e < 9; ++e)
            target[e] += entries[e][lane];
      }
  }


  template <class Formulas>
  void
  QuadraticSweeps<Formulas>::add_tangent_of_batch(const CellRotations &rotations,
                                                  const std::size_t b,
                                                  const double mass,
                                                  const double frozen,
                                                  const double turning_factor,
                                                  const CellSlots &slots,
                                                  SymmetricBlockMatrix &A,
                                                  const double added_bulk) const
  {
    std::array<CornerBlocks, n_points> K;
    for (unsigned int q = 0; q < n_points; ++q)
      set_corner_blocks(
        rotations, n_points * b + q, cells.point(b, q), frozen, turning_factor, added_bulk, K[q]);
    const CellSlots::QuadraticPlaces &places = slots.quadratic(b);
    const auto block                         = [&](const unsigned int a, const unsigned int c) {
      std::array<Pack, 9> sum = block_of(K, a, c);
      if (mass != 0.)
        {
          const Pack entry = mass * cells.mass_entry(b, a, c);
          for (unsigned int i = 0; i < 3; ++i)
            sum[4 * i] += entry;
        }
      return sum;
    };
    for (unsigned int a = 0, p = 0; a < Quadratic::n_nodes; ++a)
      {
        for (unsigned int c = 0; c < a; ++c, ++p)
          add_block(block(a, c), places.lower[p], places.transposed[p], A.lower.data());
        add_block(block(a, a), places.diagonal[a], 0, A.diagonal.data());
      }
  }


  template <class Formulas>
  void
  QuadraticSweeps<Formulas>::add_vertex_tangent(const CellRotations &rotations,
                                                const double mass,
                                                const double frozen,
                                                const double turning_factor,
                                                const CellSlots &slots,
                                                SymmetricBlockMatrix &A,
                                                const double added_bulk) const
  {
    // A function that is linear in a cell has the same corner values at all points: itself.
    cells.for_batches_in_turn([&](const std::size_t b) {
      ask_for_next(rotations.of_tangent(), b);
      CornerBlocks sum, K;
      for (unsigned int q = 0; q < n_points; ++q)
        {
          set_corner_blocks(rotations,
                            n_points * b + q,
                            cells.point(b, q),
                            frozen,
                            turning_factor,
                            added_bulk,
                            q == 0 ? sum : K);
          for (unsigned int k = 0; k < 4 && q > 0; ++k)
            for (unsigned int l = 0; l <= k; ++l)
              for (unsigned int e = 0; e < 9; ++e)
                sum[k][l][e] += K[k][l][e];
        }
      for (unsigned int k = 0; k < 4; ++k)
        for (unsigned int l = 0; l <= k; ++l)
          for (unsigned int i = 0; i < 3; ++i)
            sum[k][l][4 * i] += mass * cells.vertex_mass_entry(b, k == l);
      for (unsigned int k = 0; k < 4; ++k)
        add_block(sum[k][k], slots.diagonal(b)[k], 0, A.diagonal.data());
      for (unsigned int p = 0; p < 6; ++p)
        {
          const auto &[row, column] = CellSlots::lower_pairs[p];
          add_block(sum[row][column], slots.lower(b)[p], 0, A.lower.data());
        }
    });
  }


  template <class Formulas>
  Deformation
  QuadraticSweeps<Formulas>::deformation(const CellRotations &rotations,
                                         const double *displacement) const
  {
    return this->sum_of_deformations([&](const std::size_t b, auto &sum) {
      const auto W       = corner_values(b, displacement);
      const auto counted = cells.batch(b).owned > 0.;
      Pack::mask_type inverted(false);
      for (unsigned int q = 0; q < n_points; ++q)
        {
          const Batch point     = cells.point(b, q);
          const Matrix3<Pack> F = deformation_gradient(point, W[q]);
          const Matrix3<Pack> R = rotation_of(rotations.current, n_points * b + q);
          sum.elastic += point.owned * point.volume * formulas.energy_density(point, R, F);
          const Pack ratio = determinant(F);
          inverted         = inverted || !(ratio > 0.);
          sum.include(ratio, counted);
        }
      std::experimental::where(counted && inverted, sum.inverted) += 1.;
    });
  }


  template <class Formulas>
  std::vector<CellState>
  QuadraticSweeps<Formulas>::states(const CellRotations &rotations,
                                    const double *displacement) const
  {
    std::vector<CellState> states(cells.n_cells, CellState{0., 0., 0., 0.});
    cells.for_batches([&](const std::size_t b) {
      const auto W = corner_values(b, displacement);
      for (unsigned int q = 0; q < n_points; ++q)
        {
          const Batch point     = cells.point(b, q);
          const Pack part       = point.volume / cells.batch(b).volume;
          const Matrix3<Pack> F = deformation_gradient(point, W[q]);
          const Matrix3<Pack> R = rotation_of(rotations.current, n_points * b + q);
          const auto drawn      = this->drawn(point, R, F);
          this->for_states(b,
                           determinant(F),
                           drawn.R,
                           drawn.stress,
                           [&](const std::size_t cell,
                               const unsigned int lane,
                               const CellState &state) {
                             const double weight = part[lane];
                             states[cell].volume_ratio += weight * state.volume_ratio;
                             states[cell].von_mises_stress += weight * state.von_mises_stress;
                             states[cell].rotation_angle += weight * state.rotation_angle;
                             states[cell].pressure += weight * state.pressure;
                           });
        }
    });
    return states;
  }
} // namespace Supple

#endif
