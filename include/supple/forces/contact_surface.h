#ifndef supple_contact_surface_h
#define supple_contact_surface_h

#include <supple/forces/tool.h>
#include <supple/linear_algebra/block_matrix.h>
#include <supple/mechanics/body.h>

#include <array>
#include <vector>

namespace Supple
{
  /** A vertex, an edge or a triangle of the surface. */
  struct SurfacePart
  {
    unsigned int n;                    ///< nodes: 1, 2 or 3
    std::array<unsigned int, 3> nodes; ///< local numbers
    double measure;                    ///< the area at rest that it stands for [m^2]
    bool owned;                        ///< true on exactly one process

    /** Of the pairs of nodes 10, 20, 21 in matrices. */
    std::array<std::size_t, 3> places;
  };


  /** Places of the nodes of a part [m]. */
  using Corners = std::array<Arrow, 3>;


  /**
   * The surface of the body as tools meet it, on this process: the parts that touch one of its
   * nodes. It is made of triangles; a face of a quadratic cell counts as the four between its six
   * nodes, and the surface of a plane body is made of edges, with the area of what they stand for.
   * A vertex stands for its share of the areas around, and so does an edge.
   */
  class ContactSurface
  {
  public:
    explicit ContactSurface(const Body &body);

    /** Finds the places of all pairs of nodes. */
    void
    connect(const SymmetricPattern &pattern);

    /** @param u displacement of all local nodes [m] */
    Corners
    corners(const SurfacePart &part, const double *u) const;

    /** Triangles, or the edges of a plane body. */
    const std::vector<SurfacePart> &
    faces() const
    {
      return triangles.empty() ? edges : triangles;
    }

    /** The shortest edge at rest [m]; collective. */
    double
    shortest_edge() const;

    /** The mean length of the edges at rest [m]; collective. */
    double
    mean_edge() const;

    std::vector<SurfacePart> vertices; ///< owned ones
    std::vector<SurfacePart> edges;
    std::vector<SurfacePart> triangles; ///< none of a plane body

  private:
    void
    collect_edges_of_plane_body();

    void
    collect_triangles();

    /** Vertices, and the edges of triangles. */
    void
    collect_rest();

    double
    length(const SurfacePart &edge) const;

    const Body &body;
  };
} // namespace Supple

#endif
