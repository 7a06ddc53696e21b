#include <supple/contact/tool_shape.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Supple
{
  using dealii::cross_product_3d;

  namespace
  {
    // Cosine of the angle between two faces that lie on both sides of their edge in one plane.
    constexpr double straight = -1. + 1e-12;

    constexpr double endless = std::numeric_limits<double>::infinity();
  } // namespace


  ToolShape
  ToolShape::point()
  {
    ToolShape shape;
    shape.points         = {Arrow()};
    shape.parts.vertices = {{1, {{0, 0, 0}}, endless, true}};
    shape.parts.edges    = shape.parts.vertices;
    shape.finish();
    return shape;
  }


  ToolShape
  ToolShape::segment(const Arrow &end)
  {
    ToolShape shape;
    shape.points         = {Arrow(), end};
    shape.parts.vertices = {{1, {{0, 0, 0}}, endless, true}, {1, {{1, 1, 1}}, endless, true}};
    shape.parts.edges    = {{2, {{0, 1, 1}}, endless, true}};
    shape.finish();
    return shape;
  }


  ToolShape
  ToolShape::box(const Arrow &size)
  {
    ToolShape shape;
    for (unsigned int k = 0; k < 8; ++k)
      shape.points.push_back(Arrow({(k & 1 ? 0.5 : -0.5) * size[0],
                                    (k & 2 ? 0.5 : -0.5) * size[1],
                                    (k & 4 ? 0.5 : -0.5) * size[2]}));
    shape.set_triangles({{{0, 2, 1}},
                         {{1, 2, 3}},
                         {{4, 5, 6}},
                         {{5, 7, 6}},
                         {{0, 1, 4}},
                         {{1, 5, 4}},
                         {{2, 6, 3}},
                         {{3, 6, 7}},
                         {{0, 4, 2}},
                         {{2, 4, 6}},
                         {{1, 3, 5}},
                         {{3, 7, 5}}});
    return shape;
  }


  ToolShape
  ToolShape::triangles(const TriangleMesh &mesh, const double scale)
  {
    ToolShape shape;
    for (const std::array<double, 3> &place : mesh.points)
      shape.points.push_back(scale * Arrow({place[0], place[1], place[2]}));
    shape.set_triangles(mesh.triangles);
    return shape;
  }


  void
  ToolShape::set_triangles(const std::vector<std::array<unsigned int, 3>> &triangles)
  {
    struct Edge
    {
      double measure         = 0.;
      unsigned int n         = 0; ///< faces
      bool bends             = false;
      Arrow across           = Arrow(); ///< into the last face, of length 1
      unsigned int from_less = 0;       ///< faces that go from the smaller number to the larger
    };
    std::map<std::array<unsigned int, 2>, Edge> edges;
    std::vector<double> of_point(points.size(), 0.);
    for (const std::array<unsigned int, 3> &nodes : triangles)
      {
        const Arrow normal = cross_product_3d(points[nodes[1]] - points[nodes[0]],
                                              points[nodes[2]] - points[nodes[0]]);
        const double area  = 0.5 * normal.norm();
        if (!(area > 0.))
          continue;
        parts.triangles.push_back({3, nodes, area, true});
        for (unsigned int v = 0; v < 3; ++v)
          {
            const unsigned int one = nodes[v], other = nodes[(v + 1) % 3];
            of_point[one] += area / 3.;
            Edge &edge   = edges[{{std::min(one, other), std::max(one, other)}}];
            Arrow across = cross_product_3d(normal, points[other] - points[one]);
            across /= across.norm();
            edge.bends = edge.n > 0 && !(across * edge.across < straight);
            edge.measure += area / 3.;
            edge.across = across;
            edge.from_less += one < other;
            ++edge.n;
          }
      }
    closed = true;
    for (const auto &[nodes, edge] : edges)
      {
        closed = closed && edge.n == 2 && edge.from_less == 1;
        if (edge.bends || edge.n != 2) // what is flat, faces and vertices of the body meet first
          parts.edges.push_back({2, {{nodes[0], nodes[1], nodes[1]}}, edge.measure, true});
      }
    for (unsigned int node = 0; node < points.size(); ++node)
      if (of_point[node] > 0.)
        parts.vertices.push_back({1, {{node, node, node}}, of_point[node], true});
    finish();
  }


  void
  ToolShape::finish()
  {
    parts.represent();
    std::vector<Box> boxes;
    for (const SurfacePart &face : parts.faces())
      boxes.emplace_back().take(face.at(points));
    tree = std::make_shared<BoxTree>(boxes);
    for (const Arrow &place : points)
      {
        bounds.take(place);
        lever = std::max(lever, place.norm());
      }
  }


  void
  ToolShape::find_faces(const Box &box, std::vector<unsigned int> &numbers) const
  {
    if (parts.faces().size() == 1)
      numbers.assign(1, 0);
    else
      tree->find(box, numbers);
  }


  /** By how often a ray leaves more than it enters, so that shells may overlap; it is slanted so
   * that it meets no edge of a box. */
  bool
  ToolShape::contains(const Arrow &place) const
  {
    Box here;
    here.take(place);
    if (!closed || !bounds.overlaps(here))
      return false;
    const double far = 3. * (bounds.high - bounds.low).norm();
    const Arrow end  = place + far * Arrow({0.8291, 0.4157, 0.3739});
    here.take(end);
    std::vector<unsigned int> numbers;
    find_faces(here, numbers);
    int n_left = 0;
    for (const unsigned int face : numbers)
      if (const Corners x = parts.triangles[face].at(points).x; goes_through(x, place, end))
        n_left += cross_product_3d(x[1] - x[0], x[2] - x[0]) * (end - place) > 0. ? 1 : -1;
    return n_left != 0;
  }


  double
  ToolShape::distance(const Simplex &other, double least) const
  {
    Box box;
    box.take(other);
    if (!(box.distance(bounds) < least))
      return least;
    if (least < std::numeric_limits<double>::max())
      box.grow(least);
    else
      for (const Arrow &place : points)
        box.take(place);
    std::vector<unsigned int> numbers;
    find_faces(box, numbers);
    for (const unsigned int face : numbers)
      least = std::min(least, Supple::distance(other, parts.faces()[face].at(points)));
    return least;
  }
} // namespace Supple
