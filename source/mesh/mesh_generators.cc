#include <supple/mesh/mesh_generators.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    /** Appends a cell, reoriented if its orientation is negative. */
    void
    add_cell(SerialMesh &mesh,
             const std::array<unsigned int, 4> &vertices,
             const unsigned int material = 0)
    {
      mesh.cells.push_back(vertices);
      mesh.materials.push_back(material);
      if (mesh.volume(mesh.cells.size() - 1) < 0.)
        std::swap(mesh.cells.back()[1], mesh.cells.back()[2]);
    }
  } // namespace


  SerialMesh
  box_mesh(const MeshParameters &parameters)
  {
    SerialMesh mesh;
    const std::array<unsigned int, 3> &n     = parameters.cubes;
    const std::array<unsigned int, 3> stride = {{1, n[0] + 1, (n[0] + 1) * (n[1] + 1)}};
    const std::vector<double> ends           = parameters.ends_of_rows(parameters.size[1], n[1]);
    const std::vector<unsigned int> material = parameters.material_of_rows(ends);

    for (unsigned int k = 0; k <= n[2]; ++k)
      for (unsigned int j = 0; j <= n[1]; ++j)
        for (unsigned int i = 0; i <= n[0]; ++i)
          mesh.vertices.emplace_back(parameters.origin[0] + parameters.size[0] * i / n[0],
                                     parameters.origin[1] + ends[j],
                                     parameters.origin[2] + parameters.size[2] * k / n[2]);

    // Corner c of a cube lies at its 0/1-coordinates (c & 1, c & 2, c & 4).
    const std::array<std::array<unsigned int, 2>, 6> paths = {
      {{{1, 3}}, {{1, 5}}, {{2, 3}}, {{2, 6}}, {{4, 5}}, {{4, 6}}}};

    std::array<unsigned int, 3> cube;
    const auto vertex = [&](const unsigned int corner) {
      unsigned int index = 0;
      for (unsigned int d = 0; d < 3; ++d)
        index += (cube[d] + ((corner >> d) & 1)) * stride[d];
      return index;
    };
    for (cube[2] = 0; cube[2] < n[2]; ++cube[2])
      for (cube[1] = 0; cube[1] < n[1]; ++cube[1])
        for (cube[0] = 0; cube[0] < n[0]; ++cube[0])
          for (const auto &path : paths)
            {
              add_cell(mesh,
                       {{vertex(0), vertex(path[0]), vertex(path[1]), vertex(7)}},
                       material[cube[1]]);

              // Two of its faces lie in a side of the cube: those opposite to corners 0 and 7.
              for (const std::array<unsigned int, 3> &corners :
                   {std::array<unsigned int, 3>{{path[0], path[1], 7}},
                    std::array<unsigned int, 3>{{0, path[0], path[1]}}})
                for (unsigned int d = 0; d < 3; ++d)
                  {
                    const unsigned int side = corners[2] == 7 ? 1 : 0;
                    if (cube[d] == (side == 0 ? 0 : n[d] - 1) &&
                        std::all_of(corners.begin(), corners.end(), [&](const unsigned int c) {
                          return ((c >> d) & 1) == side;
                        }))
                      mesh.boundary.push_back(
                        {{{vertex(corners[0]), vertex(corners[1]), vertex(corners[2])}},
                         2 * d + side});
                  }
            }
    return mesh;
  }


  SerialMesh
  rectangle_mesh(const MeshParameters &parameters)
  {
    using Split = MeshParameters::Split;

    SerialMesh mesh;
    mesh.dimension                       = 2;
    const std::array<unsigned int, 2> &n = parameters.squares;
    const std::vector<double> ends = parameters.ends_of_rows(parameters.rectangle_size[1], n[1]);
    const std::vector<unsigned int> material = parameters.material_of_rows(ends);

    for (unsigned int j = 0; j <= n[1]; ++j)
      for (unsigned int i = 0; i <= n[0]; ++i)
        mesh.vertices.emplace_back(parameters.rectangle_origin[0] +
                                     parameters.rectangle_size[0] * i / n[0],
                                   parameters.rectangle_origin[1] + ends[j],
                                   0.);

    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;
    for (unsigned int j = 0; j < n[1]; ++j)
      for (unsigned int i = 0; i < n[0]; ++i)
        {
          const unsigned int low_left = i + (n[0] + 1) * j, low_right = low_left + 1;
          const unsigned int high_left = low_left + n[0] + 1, high_right = high_left + 1;

          const bool rising = parameters.split == Split::rising ||
                              (parameters.split == Split::alternating && (i + j) % 2 == 1);
          const unsigned int first = rising ? high_right : high_left;
          const unsigned int third = rising ? low_left : low_right;
          add_cell(mesh, {{low_left, low_right, first, none}}, material[j]);
          add_cell(mesh, {{third, high_right, high_left, none}}, material[j]);

          if (i == 0)
            mesh.boundary.push_back({{{high_left, low_left, none}}, 0});
          if (i + 1 == n[0])
            mesh.boundary.push_back({{{low_right, high_right, none}}, 1});
          if (j == 0)
            mesh.boundary.push_back({{{low_left, low_right, none}}, 2});
          if (j + 1 == n[1])
            mesh.boundary.push_back({{{high_right, high_left, none}}, 3});
        }
    return mesh;
  }


  namespace
  {
    using Triangle = std::array<unsigned int, 3>;

    void
    add_cylinder_vertices(SerialMesh &mesh, const MeshParameters &parameters)
    {
      for (unsigned int ring = 0; ring < parameters.rings; ++ring)
        for (unsigned int circle = 0; circle <= parameters.layers; ++circle)
          for (unsigned int i = 0; i < parameters.sectors; ++i)
            {
              const double radius =
                parameters.inner_radius +
                (parameters.outer_radius - parameters.inner_radius) * circle / parameters.layers;
              const double angle = 2. * M_PI * (i + 0.5 * (circle % 2)) / parameters.sectors;
              mesh.vertices.emplace_back(radius * std::cos(angle),
                                         radius * std::sin(angle),
                                         parameters.height *
                                           (double(ring) / (parameters.rings - 1) - 0.5));
            }
    }


    /**
     * Three cells between a triangle and the one above it. That of the inner circle has two corners
     * there and the third outside; that of the outer circle the other way round.
     */
    void
    add_wedge(SerialMesh &mesh, const Triangle &low, const Triangle &high, const bool outer)
    {
      if (!outer)
        {
          add_cell(mesh, {{low[0], high[0], low[1], low[2]}});
          add_cell(mesh, {{high[0], high[1], low[1], low[2]}});
          add_cell(mesh, {{high[0], high[1], low[2], high[2]}});
        }
      else
        {
          add_cell(mesh, {{low[0], low[1], high[2], low[2]}});
          add_cell(mesh, {{low[0], low[1], high[1], high[2]}});
          add_cell(mesh, {{low[0], high[1], high[0], high[2]}});
        }
    }


    /** The faces of a wedge that lie on the surface. */
    void
    add_wedge_boundary(SerialMesh &mesh,
                       const MeshParameters &parameters,
                       const Triangle &low,
                       const Triangle &high,
                       const bool outer,
                       const unsigned int ring,
                       const unsigned int layer)
    {
      if (ring == 0)
        mesh.boundary.push_back({low, 2});
      if (ring + 2 == parameters.rings)
        mesh.boundary.push_back({high, 3});
      if (!outer && layer == 0)
        {
          mesh.boundary.push_back({{{low[0], high[0], low[1]}}, 0});
          mesh.boundary.push_back({{{high[0], high[1], low[1]}}, 0});
        }
      if (outer && layer + 1 == parameters.layers)
        {
          mesh.boundary.push_back({{{low[0], low[1], high[1]}}, 1});
          mesh.boundary.push_back({{{low[0], high[1], high[0]}}, 1});
        }
    }
  } // namespace


  SerialMesh
  hollow_cylinder_mesh(const MeshParameters &parameters)
  {
    SerialMesh mesh;
    add_cylinder_vertices(mesh, parameters);

    const unsigned int n = parameters.sectors;
    const auto vertex =
      [&](const unsigned int ring, const unsigned int circle, const unsigned int i) {
        return (ring * (parameters.layers + 1) + circle) * n + i % n;
      };
    for (unsigned int ring = 0; ring + 1 < parameters.rings; ++ring)
      for (unsigned int layer = 0; layer < parameters.layers; ++layer)
        for (unsigned int i = 0; i < n; ++i)
          {
            // Layers turn alternately ahead and back, so that their cuts fit to each other.
            const unsigned int next = layer % 2 == 0 ? i + 1 : i + n - 1;
            const auto corners = [&](const unsigned int section, const bool outer) -> Triangle {
              const unsigned int inner_next = vertex(section, layer, next);
              const unsigned int outer_here = vertex(section, layer + 1, i);
              if (outer)
                return {{vertex(section, layer + 1, next), outer_here, inner_next}};
              return {{inner_next, vertex(section, layer, i), outer_here}};
            };
            for (const bool outer : {false, true})
              {
                const Triangle low = corners(ring, outer), high = corners(ring + 1, outer);
                add_wedge(mesh, low, high, outer);
                add_wedge_boundary(mesh, parameters, low, high, outer, ring, layer);
              }
          }
    return mesh;
  }
} // namespace Supple
