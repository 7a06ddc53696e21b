#ifndef supple_contact_surface_h
#define supple_contact_surface_h

#include <supple/contact/closest_points.h>
#include <supple/contact/surface_parts.h>
#include <supple/mechanics/body.h>

#include <vector>

namespace Supple
{
  /**
   * The surface of the body as it touches tools and itself, on this process: the parts that have
   * one of its nodes, by local numbers. It is made of triangles; a face of a quadratic cell counts
   * as the four between its six nodes, and the surface of a plane body is made of edges, with the
   * area of what they stand for. A vertex stands for its share of the areas around, and so does an
   * edge. Vertices are those that this process owns.
   */
  class ContactSurface : public SurfaceParts
  {
  public:
    explicit ContactSurface(const Body &body);

    /** @param u displacement of all local nodes [m] */
    Simplex
    simplex(const SurfacePart &part, const double *u) const;

    /** Values of the nodes of a part, such as ways [m]. @param values of all local nodes */
    static Corners
    values(const SurfacePart &part, const double *values);

    /** Where a node is. @param u as of simplex() */
    Arrow
    place(unsigned int node, const double *u) const;

    /** The shortest edge at rest [m]; collective. */
    double
    shortest_edge() const;

    /** The mean length of the edges at rest [m]; collective. */
    double
    mean_edge() const;

    std::vector<unsigned int> nodes; ///< of all parts

    const Body &body;

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
  };
} // namespace Supple

#endif
