#include <supple/cells.h>
#include <supple/symmetric_eigen.h>

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
    NodalPack h = batches[b].gradients;
    if (!rotations.empty())
      for (unsigned int a = 0; a < 4; ++a)
        h[a] = rotations[b] * batches[b].gradients[a];
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
} // namespace Supple
