#include <supple/mechanics/quadratic_cells.h>

namespace Supple
{
  namespace Quadratic
  {
    std::array<Matrix3<Pack>, n_points>
    gradients(const Cells &cells, const std::size_t batch, const double *nodal)
    {
      const PointValues W = at_points(gather(cells.nodes_of(batch), nodal));
      std::array<Matrix3<Pack>, n_points> gradients;
      for (unsigned int q = 0; q < n_points; ++q)
        gradients[q] = gradient(cells.point(batch, q), W[q]);
      return gradients;
    }


    std::array<Matrix3<Pack>, n_points>
    deformation_gradients(const Cells &cells, const std::size_t batch, const double *displacement)
    {
      auto F = gradients(cells, batch, displacement);
      for (Matrix3<Pack> &of_point : F)
        for (unsigned int i = 0; i < 3; ++i)
          of_point(i, i) += 1.;
      return F;
    }


    NodalPack
    mass_product(const Pack &mass, const bool lumped, const NodalPack &values)
    {
      NodalPack products;
      for (unsigned int a = 0; a < n_nodes; ++a)
        for (unsigned int i = 0; i < 3; ++i)
          {
            Pack sum(0.);
            if (lumped)
              sum = share(a, true) * values[a][i];
            else
              for (unsigned int b = 0; b < n_nodes; ++b)
                sum += product(a, b) * values[b][i];
            products[a][i] = mass * sum;
          }
      return products;
    }
  } // namespace Quadratic


  std::vector<Matrix3<Pack>>
  gradients_at_points(const Cells &cells, const std::size_t batch, const double *nodal)
  {
    if (!cells.is_quadratic())
      return {cells.gradient(batch, Cells::gather(cells.batch(batch), nodal))};
    const auto of_points = Quadratic::gradients(cells, batch, nodal);
    return {of_points.begin(), of_points.end()};
  }


  std::vector<Matrix3<Pack>>
  deformation_gradients_at_points(const Cells &cells,
                                  const std::size_t batch,
                                  const double *displacement)
  {
    if (!cells.is_quadratic())
      return {cells.deformation_gradient(batch, displacement)};
    const auto of_points = Quadratic::deformation_gradients(cells, batch, displacement);
    return {of_points.begin(), of_points.end()};
  }
} // namespace Supple
