#include <supple/contact/friction.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using dealii::outer_product;
  using dealii::Tensor;
  using dealii::unit_symmetric_tensor;

  Friction::Friction(const std::vector<double> &coefficients, const double slip_resolution)
    : slip_resolution(slip_resolution)
    , coefficients(coefficients)
  {
  }


  bool
  Friction::any() const
  {
    return std::any_of(coefficients.begin(), coefficients.end(), [](const double mu) {
      return mu > 0.;
    });
  }


  void
  Friction::begin_step(const Touches &list, const std::vector<Arrow> &surface_places)
  {
    touches.clear();
    for (std::size_t k = 0; k < list.size(); ++k)
      {
        const auto &[pair, force] = list[k];
        const double limit =
          coefficients[std::min<std::size_t>(pair.tool, coefficients.size() - 1)] * force;
        if (limit > 0.)
          touches.push_back({pair, limit, surface_places[k]});
      }
  }


  std::vector<Friction::Slip>
  Friction::slips(const Places &places, const double duration) const
  {
    std::vector<Slip> slips;
    for (const Touch &touch : touches)
      {
        const auto &[now, other] = places(touch.pair, touch.place);
        const Arrow way          = now - other;
        const Arrow &n           = touch.pair.normal;
        slips.push_back(
          {&touch.pair, touch.limit, touch.place, way - (n * way) * n, slip_resolution * duration});
      }
    return slips;
  }


  double
  Friction::Slip::secant() const
  {
    const double y = way.norm(), h = resolution;
    return limit * (y < h ? (2. - y / h) / h : 1. / y);
  }


  double
  Friction::Slip::potential() const
  {
    const double y = way.norm(), h = resolution;
    return limit * (y < h ? y * y / h * (1. - y / (3. * h)) + h / 3. : y);
  }


  Arrow
  Friction::Slip::force() const
  {
    return -secant() * way;
  }


  Tensor<2, 3>
  Friction::Slip::stiffness() const
  {
    const double y = way.norm(), h = resolution;
    const Arrow &n = pair->normal;
    Tensor<2, 3> result =
      secant() * (Tensor<2, 3>(unit_symmetric_tensor<3>()) - outer_product(n, n));
    if (y > 0.)
      result -= limit / (y * (y < h ? h * h : y * y)) * outer_product(way, way);
    return result;
  }


  double
  Friction::Slip::heat() const
  {
    return secant() * way.norm_square();
  }
} // namespace Supple
