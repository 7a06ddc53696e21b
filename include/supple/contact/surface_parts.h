#ifndef supple_surface_parts_h
#define supple_surface_parts_h

#include <supple/contact/closest_points.h>

#include <array>
#include <vector>

namespace Supple
{
  /** A vertex, an edge or a triangle of a surface, by the numbers of its nodes. */
  struct SurfacePart
  {
    unsigned int n; ///< nodes: 1, 2 or 3
    std::array<unsigned int, 3> nodes;
    double measure; ///< the area at rest that it stands for [m^2]
    bool owned;     ///< true on exactly one process

    /** With nodes at these places. */
    Simplex
    at(const std::vector<Arrow> &places) const;

    bool
    has_node(unsigned int node) const;

    bool
    shares_node_with(const SurfacePart &other) const;
  };


  /**
   * A surface: triangles, their edges and their vertices. That of a plane body has edges alone, a
   * capsule's core is one edge, and that of a sphere one point, which counts as an edge too.
   *
   * Each vertex and each edge is represented by one of the faces that it belongs to: where faces
   * are near each other, so are the edges and vertices that they represent, and none is met twice
   * (Curtis, Tamstorf and Manocha, I3D 2008, 61).
   */
  struct SurfaceParts
  {
    std::vector<SurfacePart> vertices, edges, triangles;

    /** Of each face the numbers of the vertices and edges that it represents. */
    std::vector<std::vector<unsigned int>> represented_vertices, represented_edges;

    /** Triangles, or the edges if there are none. */
    const std::vector<SurfacePart> &
    faces() const
    {
      return triangles.empty() ? edges : triangles;
    }

    /** Finds which face represents what. */
    void
    represent();
  };
} // namespace Supple

#endif
