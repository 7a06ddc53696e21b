#include <supple/mechanics/quadratic_cells.h>
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


    /** H and h of a point. */
    struct Linearized
    {
      Matrix3<Pack> H;
      Pack h;

      Linearized(const CellRotations::List &rotations,
                 const VolumeMeasure measure,
                 const std::size_t place,
                 const Matrix3<Pack> &F)
        : H(volume_gradient(rotations, measure, place, F))
        , h(measure == VolumeMeasure::determinant ? 2. * determinant(F) + 1. : Pack(3.))
      {
      }
    };


    /** Writes what was found at a point of a batch. @param gradients H grad N_a [1/m] */
    template <std::size_t n_nodes>
    void
    write(VolumeChanges &changes,
          const Cells &cells,
          const std::size_t b,
          const unsigned int q,
          const Linearized &change,
          const Pack &volume,
          const std::array<std::array<Pack, 3>, n_nodes> &gradients)
    {
      const Pack constant = volume * (trace(change.H) - change.h);
      cells.for_lanes(b, [&](const unsigned int lane, const std::size_t cell) {
        const std::size_t point = cells.n_points() * cell + q;
        changes.volume[point]   = volume[lane];
        changes.constant[point] = constant[lane];
        for (unsigned int a = 0; a < n_nodes; ++a)
          for (unsigned int i = 0; i < 3; ++i)
            changes.gradients[n_nodes * point + a][i] = volume[lane] * gradients[a][i][lane];
      });
    }


    void
    find_quadratic_changes(const Cells &cells,
                           const CellRotations::List &rotations,
                           const VolumeMeasure measure,
                           const double *displacement,
                           VolumeChanges &changes)
    {
      for (std::size_t b = 0; b < cells.n_batches(); ++b)
        {
          std::array<Matrix3<Pack>, Quadratic::n_points> F;
          F.fill(Matrix3<Pack>::identity());
          if (measure == VolumeMeasure::determinant)
            F = Quadratic::deformation_gradients(cells, b, displacement);
          for (unsigned int q = 0; q < Quadratic::n_points; ++q)
            {
              const Linearized change(rotations, measure, Quadratic::n_points * b + q, F[q]);
              const Cells::Batch point = cells.point(b, q);
              write(changes,
                    cells,
                    b,
                    q,
                    change,
                    point.volume,
                    Quadratic::to_nodes(Quadratic::divergence(point, change.H, Pack(1.)), q));
            }
        }
    }
  } // namespace


  void
  find_volume_changes(const Cells &cells,
                      const CellRotations::List &rotations,
                      const VolumeMeasure measure,
                      const double *displacement,
                      VolumeChanges &changes)
  {
    const std::size_t n_points = cells.n_points() * cells.n_cells;
    changes.n_nodes            = cells.is_quadratic() ? Quadratic::n_nodes : 4;
    changes.volume.resize(n_points);
    changes.constant.resize(n_points);
    changes.gradients.resize(n_points * changes.n_nodes);
    if (cells.is_quadratic())
      return find_quadratic_changes(cells, rotations, measure, displacement, changes);
    for (std::size_t b = 0; b < cells.n_batches(); ++b)
      {
        const bool exact = measure == VolumeMeasure::determinant;
        const Matrix3<Pack> F =
          exact ? cells.deformation_gradient(b, displacement) : Matrix3<Pack>::identity();
        const Linearized change(rotations, measure, b, F);
        write(changes, cells, b, 0, change, cells.batch(b).volume, cells.divergence(b, change.H));
      }
  }


  void
  VolumeStiffness::update(const double *displacement, const std::vector<double> &mean_stress)
  {
    const unsigned int n_points = cells.n_points();
    VsF.resize(n_points * cells.n_batches());
    for (std::size_t b = 0; b < cells.n_batches(); ++b)
      {
        const std::vector<Matrix3<Pack>> F =
          deformation_gradients_at_points(cells, b, displacement);
        for (unsigned int q = 0; q < n_points; ++q)
          {
            const Pack volume =
              cells.is_quadratic() ? cells.point(b, q).volume : cells.batch(b).volume;
            Pack force(0.);
            cells.for_lanes(b, [&](const unsigned int lane, const std::size_t cell) {
              force[lane] = volume[lane] * mean_stress[n_points * cell + q];
            });
            Matrix3<Pack> &of_point = VsF[n_points * b + q];
            of_point                = F[q];
            for (Pack &entry : of_point.entries)
              entry *= force;
          }
      }
  }


  /** cof is quadratic in F, so that its derivative is linear in it: V s goes with F. */
  Matrix3<Pack>
  VolumeStiffness::stress(const std::size_t place, const Matrix3<Pack> &G) const
  {
    return cofactor_derivative(VsF[place], G);
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
