#include <supple/mechanics/volume_change.h>

namespace Supple
{
  namespace
  {
    /** The derivative of cof F in the direction G. */
    Matrix3<Pack>
    cofactor_derivative(const Matrix3<Pack> &F, const Matrix3<Pack> &G)
    {
      Matrix3<Pack> C;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            const unsigned int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
            const unsigned int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
            C(i, j) = G(i1, j1) * F(i2, j2) + F(i1, j1) * G(i2, j2) - G(i1, j2) * F(i2, j1) -
                      F(i1, j2) * G(i2, j1);
          }
      return C;
    }
  } // namespace


  void
  find_volume_changes(const Cells &cells,
                      const CellRotations::List &rotations,
                      const VolumeMeasure measure,
                      const double *displacement,
                      std::vector<VolumeChange> &changes)
  {
    changes.resize(cells.n_cells);
    for (std::size_t b = 0; b < cells.n_batches(); ++b)
      {
        const bool exact = measure == VolumeMeasure::determinant;
        const Matrix3<Pack> F =
          exact ? cells.deformation_gradient(b, displacement) : Matrix3<Pack>::identity();
        const Matrix3<Pack> H            = volume_gradient(rotations, measure, b, F);
        const Pack h                     = exact ? 2. * determinant(F) + 1. : Pack(3.);
        const Pack volume                = cells.batch(b).volume;
        const Pack constant              = volume * (trace(H) - h);
        const Cells::NodalPack gradients = cells.divergence(b, H);
        cells.for_lanes(b, [&](const unsigned int lane, const std::size_t cell) {
          VolumeChange &change = changes[cell];
          change.volume        = volume[lane];
          change.constant      = constant[lane];
          for (unsigned int a = 0; a < 4; ++a)
            for (unsigned int i = 0; i < 3; ++i)
              change.gradients[a][i] = change.volume * gradients[a][i][lane];
        });
      }
  }


  void
  VolumeStiffness::update(const double *displacement, const std::vector<double> &mean_stress)
  {
    VsF.resize(cells.n_batches());
    for (std::size_t b = 0; b < VsF.size(); ++b)
      {
        Pack force(0.);
        cells.for_lanes(b, [&](const unsigned int lane, const std::size_t cell) {
          if (cell < mean_stress.size())
            force[lane] = cells.batch(b).volume[lane] * mean_stress[cell];
        });
        VsF[b] = cells.deformation_gradient(b, displacement);
        for (Pack &entry : VsF[b].entries)
          entry *= force;
      }
  }


  /** cof is quadratic in F, so that its derivative is linear in it: V s goes with F. */
  Matrix3<Pack>
  VolumeStiffness::stress(const std::size_t b, const Matrix3<Pack> &G) const
  {
    return cofactor_derivative(VsF[b], G);
  }


  std::array<std::array<Pack, 3>, 3>
  VolumeStiffness::block(const std::size_t b, const unsigned int a, const unsigned int c) const
  {
    std::array<std::array<Pack, 3>, 3> columns;
    for (unsigned int j = 0; j < 3; ++j)
      {
        Cells::NodalPack unit{};
        unit[c][j] = Pack(1.);
        columns[j] = cells.divergence(b, stress(b, cells.gradient(b, unit)))[a];
      }
    return columns;
  }


  void
  VolumeStiffness::add_product(const double factor, const double *w, double *y) const
  {
    for (std::size_t b = 0; b < VsF.size(); ++b)
      {
        Matrix3<Pack> P = stress(b, cells.gradient(b, Cells::gather(cells.batch(b), w)));
        for (Pack &entry : P.entries)
          entry *= factor;
        Cells::scatter(cells.batch(b), cells.divergence(b, P), y);
      }
  }
} // namespace Supple
