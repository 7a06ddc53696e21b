#include <supple/mechanics/cells.h>

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
  Cells::volume_changes(const VolumeMeasure measure,
                        const double *displacement,
                        std::vector<VolumeChange> &changes) const
  {
    changes.resize(n_cells);
    for (std::size_t b = 0; b < batches.size(); ++b)
      {
        Matrix3<Pack> H = rotation_of(b);
        Pack h(3.);
        if (measure == VolumeMeasure::determinant)
          {
            const Matrix3<Pack> F = deformation_gradient(b, displacement);
            H                     = cofactor(F);
            h                     = 2. * determinant(F) + 1.;
          }
        const Pack constant       = batches[b].volume * (trace(H) - h);
        const NodalPack gradients = divergence(b, H);
        for (unsigned int lane = 0; lane < n_lanes && b * n_lanes + lane < n_cells; ++lane)
          {
            VolumeChange &change = changes[b * n_lanes + lane];
            change.volume        = batches[b].volume[lane];
            change.constant      = constant[lane];
            for (unsigned int a = 0; a < 4; ++a)
              for (unsigned int i = 0; i < 3; ++i)
                change.gradients[a][i] = change.volume * gradients[a][i][lane];
          }
      }
  }


  void
  Cells::update_volume_stiffness(const double *displacement, const std::vector<double> &mean_stress)
  {
    volume_stiffness.resize(batches.size());
    for (std::size_t b = 0; b < batches.size(); ++b)
      {
        Pack force(0.);
        for (unsigned int lane = 0; lane < n_lanes && b * n_lanes + lane < mean_stress.size();
             ++lane)
          force[lane] = batches[b].volume[lane] * mean_stress[b * n_lanes + lane];
        volume_stiffness[b] = deformation_gradient(b, displacement);
        for (Pack &entry : volume_stiffness[b].entries)
          entry *= force;
      }
  }


  /** cof is quadratic in F, so that its derivative is linear in it: V s goes with F. */
  Matrix3<Pack>
  Cells::volume_stress(const std::size_t b, const Matrix3<Pack> &G) const
  {
    return cofactor_derivative(volume_stiffness[b], G);
  }


  std::array<std::array<Pack, 3>, 3>
  Cells::volume_block(const std::size_t b, const unsigned int a, const unsigned int c) const
  {
    std::array<std::array<Pack, 3>, 3> columns;
    for (unsigned int j = 0; j < 3; ++j)
      {
        NodalPack unit{};
        unit[c][j] = Pack(1.);
        columns[j] = divergence(b, volume_stress(b, gradient(b, unit)))[a];
      }
    return columns;
  }


  void
  Cells::add_volume_product(const double *w, double *y) const
  {
    for (std::size_t b = 0; b < volume_stiffness.size(); ++b)
      scatter(batches[b], divergence(b, volume_stress(b, gradient(b, gather(batches[b], w)))), y);
  }
} // namespace Supple
