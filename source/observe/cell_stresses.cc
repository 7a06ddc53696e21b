#include <supple/observe/cell_stresses.h>

#include <supple/mechanics/quadratic_cells.h>
#include <supple/mechanics/rotation.h>

namespace Supple
{
  namespace
  {
    /** The lanes of CellStresses::turned, of a batch. */
    std::array<Pack, 7>
    lanes_of_stress(const Matrix3<Pack> &T)
    {
      const double root = std::sqrt(0.5); // of half a sum of two entries, times sqrt(2)
      const Pack mean   = trace(T) / 3.;
      return {{T(0, 0) - mean,
               T(1, 1) - mean,
               T(2, 2) - mean,
               root * (T(0, 1) + T(1, 0)),
               root * (T(1, 2) + T(2, 1)),
               root * (T(2, 0) + T(0, 2)),
               mean}};
    }


    Matrix3<Pack>
    product_with_transposed(const Matrix3<Pack> &A, const Matrix3<Pack> &B)
    {
      Matrix3<Pack> C;
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          C(i, j) = A(i, 0) * B(j, 0) + A(i, 1) * B(j, 1) + A(i, 2) * B(j, 2);
      return C;
    }
  } // namespace


  CellStresses::CellStresses(const Configuration &configuration, const Law &law)
  {
    const Cells &cells                   = *configuration.body.cells;
    const CellRotations::List &rotations = configuration.rotations.current;
    const VolumetricPatches *patches     = configuration.patches.get();
    const GhostValues u(configuration.displacement());
    piola                   = law.stresses(configuration.rotations, u.data());
    const bool turns_unkept = !law.is_linear() && !law.has_rotations();
    std::vector<double> mean;
    if (patches)
      mean = patches->mean_stress(u.data());
    const unsigned int n_points = cells.n_points();
    turned.resize(n_points * cells.n_cells);
    cells.for_batches([&](const std::size_t b) {
      std::vector<Matrix3<Pack>> F;
      if (patches || turns_unkept)
        F = deformation_gradients_at_points(cells, b, u.data());
      for (unsigned int q = 0; q < n_points; ++q)
        {
          const std::size_t place = n_points * b + q;
          Matrix3<Pack> T         = piola[place];
          if (!rotations.empty())
            T = product_with_transposed(piola[place], rotations[place]);
          else if (turns_unkept)
            T = product_with_transposed(piola[place], rotation(RotationMethod::polar, F[q]));
          if (patches)
            {
              Pack s(0.);
              cells.for_lanes(b, [&](const unsigned int lane, const std::size_t cell) {
                s[lane] = mean[n_points * cell + q];
              });
              const Matrix3<Pack> H = volume_gradient(rotations, patches->measure, place, F[q]);
              for (unsigned int k = 0; k < 9; ++k)
                piola[place].entries[k] += s * H.entries[k];
              for (unsigned int i = 0; i < 3; ++i)
                T(i, i) += s;
            }
          const std::array<Pack, 7> lanes = lanes_of_stress(T);
          cells.for_lanes(b, [&](const unsigned int lane, const std::size_t cell) {
            for (unsigned int k = 0; k < lanes.size(); ++k)
              turned[n_points * cell + q].lanes[k] = lanes[k][lane];
          });
        }
    });
  }
} // namespace Supple
