#include <supple/linear_algebra/symmetric_eigen.h>
#include <supple/mechanics/cells.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  namespace stdx = std::experimental;

  namespace
  {
    using Vector3 = std::array<Pack, 3>;

    Vector3
    cross(const Vector3 &a, const Vector3 &b)
    {
      return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
    }


    Vector3
    operator*(const Matrix3<Pack> &A, const Vector3 &b)
    {
      Vector3 c;
      for (unsigned int i = 0; i < 3; ++i)
        c[i] = A(i, 0) * b[0] + A(i, 1) * b[1] + A(i, 2) * b[2];
      return c;
    }


    /** |R - R'|^2 of two rotations that differ by this angle. */
    double
    square_of_difference(const double angle)
    {
      const double sine = std::sin(0.5 * std::min(angle, M_PI));
      return 8. * sine * sine;
    }
  } // namespace


  void
  Cells::update_rotation_stiffness(const Tangent tangent, const double *displacement)
  {
    update_rotation_stiffness(tangent, displacement, VolumeMeasure::trace, {});
  }


  void
  Cells::update_rotation_stiffness(const Tangent tangent,
                                   const double *displacement,
                                   const VolumeMeasure measure,
                                   const std::vector<double> &mean_stress)
  {
    volume_stiffness.clear();
    if (tangent == Tangent::consistent && measure == VolumeMeasure::determinant)
      update_volume_stiffness(displacement, mean_stress);

    const auto mean_stress_of = [&](const std::size_t b) {
      Pack s(0.);
      for (unsigned int lane = 0; lane < n_lanes && measure == VolumeMeasure::trace; ++lane)
        if (b * n_lanes + lane < mean_stress.size())
          s[lane] = mean_stress[b * n_lanes + lane];
      return s;
    };
    if (tangent == Tangent::frozen || rotations.empty())
      {
        rotation_stiffness.clear();
        return;
      }
    rotation_stiffness.resize(batches.size());
    for (std::size_t b = 0; b < batches.size(); ++b)
      {
        const Batch &batch          = batches[b];
        const Matrix3<Pack> S       = rotated_back(b, deformation_gradient(b, displacement));
        const SymmetricEigen eigen  = symmetric_eigen(S);
        const Matrix3<Pack> rotated = rotations[b] * eigen.vectors;
        const Pack c = 2. * batch.mu - batch.lambda * (trace(S) - 3.) - mean_stress_of(b);

        Matrix3<Pack> &H = rotation_stiffness[b];
        H                = Matrix3<Pack>{};
        for (unsigned int k = 0; k < 3; ++k)
          {
            // Two stretches that add up to nothing: the rotation about the third axis is not
            // unique.
            Pack sum                     = eigen.values[(k + 1) % 3] + eigen.values[(k + 2) % 3];
            stdx::where(sum < 1e-3, sum) = Pack(1e-3);

            Pack value = batch.mu - c / sum;
            if (tangent == Tangent::definite)
              stdx::where(value < 0., value) = Pack(0.);
            value *= batch.volume;
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                H(i, j) += value * rotated(i, k) * rotated(j, k);
          }
      }
  }


  Cells::NodalPack
  Cells::rotated_gradients(const std::size_t b) const
  {
    const auto &R = kept_rotations.empty() ? rotations : kept_rotations;
    NodalPack h   = batches[b].gradients;
    if (!R.empty())
      for (unsigned int a = 0; a < 4; ++a)
        h[a] = R[b] * batches[b].gradients[a];
    return h;
  }


  std::array<std::array<Pack, 3>, 3>
  Cells::rotation_block(const std::size_t b,
                        const NodalPack &h,
                        unsigned int a,
                        unsigned int c) const
  {
    std::array<std::array<Pack, 3>, 3> columns;
    for (unsigned int j = 0; j < 3; ++j)
      {
        Vector3 unit{{Pack(0.), Pack(0.), Pack(0.)}};
        unit[j]    = Pack(1.);
        columns[j] = cross(rotation_stiffness[b] * cross(h[c], unit), h[a]);
      }
    return columns;
  }


  void
  Cells::add_rotation_product(const double *w, double *y) const
  {
    add_volume_product(w, y);
    for (std::size_t b = 0; b < rotation_stiffness.size(); ++b)
      {
        const NodalPack h      = rotated_gradients(b);
        const NodalPack values = gather(batches[b], w);
        Vector3 turn{{Pack(0.), Pack(0.), Pack(0.)}};
        for (unsigned int a = 0; a < 4; ++a)
          {
            const Vector3 part = cross(h[a], values[a]);
            for (unsigned int i = 0; i < 3; ++i)
              turn[i] += part[i];
          }
        const Vector3 moment = rotation_stiffness[b] * turn;
        NodalPack f;
        for (unsigned int a = 0; a < 4; ++a)
          f[a] = cross(moment, h[a]);
        scatter(batches[b], f, y);
      }
  }


  template <bool axisymmetric>
  void
  Cells::add_tangent_of(const std::size_t b,
                        const double mass_factor,
                        const double stiffness_factor,
                        const double rotation_factor,
                        const double added_bulk,
                        SymmetricBlockMatrix &A) const
  {
    const Batch &batch = batches[b];
    const Pack lambda  = stiffness_factor * batch.volume * (batch.lambda + added_bulk * batch.mu);
    const Pack mu      = stiffness_factor * batch.volume * batch.mu;
    const Pack same    = mass_factor * mass_entry(b, 0, 0);
    const Pack other   = mass_factor * mass_entry(b, 0, 1);

    const NodalPack h   = rotated_gradients(b);
    const bool turning  = !rotation_stiffness.empty();
    const bool swelling = !volume_stiffness.empty();
    NodalPack t         = h; // of the trace of the strain
    if constexpr (axisymmetric)
      for (unsigned int a = 0; a < 3; ++a)
        t[a][0] += hoops[b].gradient;

    const auto add_block =
      [&](const unsigned int a, const unsigned int c, const auto &slot, double *values) {
        Pack diagonal = mu * (h[a][0] * h[c][0] + h[a][1] * h[c][1] + h[a][2] * h[c][2]);
        if constexpr (axisymmetric)
          diagonal += mass_factor * mass_entry(b, a, c);
        else
          diagonal += a == c ? same : other;
        std::array<std::array<Pack, 3>, 3> turn, swell;
        if (turning)
          turn = rotation_block(b, h, a, c);
        if (swelling)
          swell = volume_block(b, a, c);
        alignas(64) double block[9][n_lanes];
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            {
              Pack entry = mu * h[c][i] * h[a][j];
              if constexpr (axisymmetric)
                entry += lambda * t[a][i] * t[c][j];
              else
                entry += lambda * h[a][i] * h[c][j];
              if (i == j)
                entry += diagonal;
              if (turning)
                entry += rotation_factor * turn[j][i];
              if (swelling)
                entry += rotation_factor * swell[j][i];
              if (axisymmetric && i == 0 && j == 0)
                entry += 2. * mu * hoops[b].gradient * hoops[b].gradient;
              entry.copy_to(block[3 * i + j], stdx::vector_aligned);
            }
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            double *target = values + 9 * static_cast<std::size_t>(slot[lane]);
            for (unsigned int k = 0; k < 9; ++k)
              target[k] += block[k][lane];
          }
      };

    for (unsigned int a = 0; a < 4; ++a)
      add_block(a, a, slots[b].diagonal[a], A.diagonal.data());
    for (unsigned int p = 0; p < 6; ++p)
      add_block(lower_pairs[p][0], lower_pairs[p][1], slots[b].lower[p], A.lower.data());
  }


  void
  Cells::add_tangent_of_batch(const std::size_t b,
                              const double mass_factor,
                              const double stiffness_factor,
                              const double rotation_factor,
                              const double added_bulk,
                              SymmetricBlockMatrix &A) const
  {
    if (section.axisymmetric())
      add_tangent_of<true>(b, mass_factor, stiffness_factor, rotation_factor, added_bulk, A);
    else
      add_tangent_of<false>(b, mass_factor, stiffness_factor, rotation_factor, added_bulk, A);
  }


  void
  Cells::add_tangent(const double mass_factor,
                     const double stiffness_factor,
                     const double rotation_factor,
                     SymmetricBlockMatrix &A,
                     const double added_bulk) const
  {
    for_batches_in_turn([&](const std::size_t b) {
      ask_for_next(slots, b);
      add_tangent_of_batch(b, mass_factor, stiffness_factor, rotation_factor, added_bulk, A);
    });
    if (vertex_mass > 0.)
      A.add_to_diagonal(mass_factor * vertex_mass);
  }


  void
  Cells::keep_rotations()
  {
    kept_rotations = rotations;
  }


  void
  Cells::release_rotations()
  {
    kept_rotations.clear();
  }


  bool
  Cells::tangent_is_frozen() const
  {
    return rotation_stiffness.empty() && volume_stiffness.empty();
  }


  Pack::mask_type
  Cells::has_turned(const std::size_t b, const double bound) const
  {
    Matrix3<Pack> difference = rotations[b];
    for (unsigned int k = 0; k < 9; ++k)
      difference.entries[k] -= kept_rotations[b].entries[k];
    return norm_square(difference) > bound;
  }


  std::size_t
  Cells::n_turned(const double angle) const
  {
    const double bound = square_of_difference(angle);
    std::size_t n      = 0;
    for (std::size_t b = 0; b < kept_rotations.size(); ++b)
      n += stdx::popcount(has_turned(b, bound) && batches[b].owned > 0.);
    return n;
  }


  void
  Cells::renew_tangent(const double angle, const double stiffness_factor, SymmetricBlockMatrix &A)
  {
    const double bound = square_of_difference(angle);
    for (std::size_t b = 0; b < kept_rotations.size(); ++b)
      {
        const Pack::mask_type turned = has_turned(b, bound);
        if (stdx::none_of(turned))
          continue;
        add_tangent_of_batch(b, 0., -stiffness_factor, 0., 0., A);
        for (unsigned int k = 0; k < 9; ++k)
          stdx::where(turned, kept_rotations[b].entries[k]) = rotations[b].entries[k];
        add_tangent_of_batch(b, 0., stiffness_factor, 0., 0., A);
      }
  }
} // namespace Supple
