#include <supple/contact/tool_surface.h>

#include <deal.II/base/numbers.h>

#include <array>
#include <cmath>
#include <utility>

namespace Supple
{
  using dealii::cross_product_3d;
  namespace numbers = dealii::numbers;
  using Shape       = ToolParameters::Shape;

  namespace
  {
    /** Two directions across a third one; all have the length 1. */
    std::array<Arrow, 3>
    axes_along(const Arrow &direction)
    {
      const Arrow third = direction / direction.norm();
      Arrow other; // along the axis that it is most across
      other[std::abs(third[0]) < 0.6 ? 0 : 1] = 1.;
      Arrow first                             = cross_product_3d(other, third);
      first /= first.norm();
      return {{first, cross_product_3d(third, first), third}};
    }


    void
    add(TriangleMesh &mesh, const Arrow &point)
    {
      mesh.points.push_back({{point[0], point[1], point[2]}});
    }


    TriangleMesh
    square(const Arrow &normal, const double extent)
    {
      const auto [u, v, w] = axes_along(normal);
      TriangleMesh mesh;
      for (const auto &[a, b] : {std::make_pair(-1., -1.), {1., -1.}, {1., 1.}, {-1., 1.}})
        add(mesh, 0.5 * extent * (a * u + b * v));
      mesh.triangles = {{{0, 1, 2}}, {{0, 2, 3}}};
      return mesh;
    }


    /** All points that are no farther from the segment from the origin to @p end than a radius; a
     * sphere has none. */
    TriangleMesh
    capsule(const Arrow &end, const double radius)
    {
      constexpr unsigned int sectors = 24, rings = 12;

      const auto [u, v, w] = axes_along(end.norm() > 0. ? end : Arrow({0., 0., 1.}));
      TriangleMesh mesh;
      const auto add_ring = [&, &u = u, &v = v, &w = w](const Arrow &center, const unsigned int r) {
        const double latitude = numbers::PI * (double(r) / rings - 0.5);
        for (unsigned int s = 0; s < sectors; ++s)
          {
            const double longitude = 2. * numbers::PI * s / sectors;
            const Arrow outward    = std::cos(longitude) * u + std::sin(longitude) * v;
            add(mesh, center + radius * (std::cos(latitude) * outward + std::sin(latitude) * w));
          }
      };
      for (unsigned int r = 0; r <= rings / 2; ++r)
        add_ring(Arrow(), r);
      for (unsigned int r = rings / 2; r <= rings; ++r)
        add_ring(end, r);
      const unsigned int n_rows = mesh.points.size() / sectors;
      for (unsigned int r = 0; r + 1 < n_rows; ++r)
        for (unsigned int s = 0; s < sectors; ++s)
          {
            const unsigned int a = r * sectors + s, b = r * sectors + (s + 1) % sectors;
            mesh.triangles.push_back({{a, b, b + sectors}});
            mesh.triangles.push_back({{a, b + sectors, a + sectors}});
          }
      return mesh;
    }


    TriangleMesh
    of_core(const ToolShape &shape)
    {
      TriangleMesh mesh;
      for (const Arrow &point : shape.points)
        add(mesh, point);
      for (const SurfacePart &triangle : shape.parts.triangles)
        mesh.triangles.push_back(triangle.nodes);
      return mesh;
    }
  } // namespace


  double
  extent_of_planes(const Body &body)
  {
    return 1.5 * body.mesh.diameter();
  }


  TriangleMesh
  drawn_surface(const Tool &tool, const double extent)
  {
    switch (tool.parameters.shape)
      {
        case Shape::plane:
          return square(tool.parameters.normal, extent);
        case Shape::sphere:
          return capsule(Arrow(), tool.parameters.radius);
        case Shape::capsule:
          return capsule(tool.parameters.axis, tool.parameters.radius);
        case Shape::box:
          return of_core(ToolShape::box(tool.parameters.size));
        default:
          return of_core(*tool.shape);
      }
  }
} // namespace Supple
