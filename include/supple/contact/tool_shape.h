#ifndef supple_tool_shape_h
#define supple_tool_shape_h

#include <supple/contact/box_tree.h>
#include <supple/contact/surface_parts.h>
#include <supple/contact/tool_file.h>

#include <memory>
#include <vector>

namespace Supple
{
  /**
   * The core of a rigid tool in its own frame, with its reference point as the origin: one point, a
   * segment, or triangles. The tool is all that is no farther from it than a distance, which the
   * core does not know.
   */
  class ToolShape
  {
  public:
    /** The origin. */
    static ToolShape
    point();

    /** From the origin to a point. */
    static ToolShape
    segment(const Arrow &end);

    /** With the origin as its center. @param size lengths of its edges [m] */
    static ToolShape
    box(const Arrow &size);

    /** @param mesh places in units of @p scale [m] */
    static ToolShape
    triangles(const TriangleMesh &mesh, double scale);

    /** Whether triangles have an inside: each edge is that of two, which run along it in opposite
     * directions. */
    bool
    is_closed() const
    {
      return closed;
    }

    /** Whether a place is within, of triangles that are closed; never for others. */
    bool
    contains(const Arrow &place) const;

    /** Between a simplex and the core, or @p least if that is less [m]. */
    double
    distance(const Simplex &simplex, double least) const;

    /** Numbers of the faces near a box, in ascending order. */
    void
    find_faces(const Box &box, std::vector<unsigned int> &numbers) const;

    SurfaceParts parts; ///< with areas; those of a point and a segment are infinite
    std::vector<Arrow> points;
    double lever = 0.; ///< the farthest point from the origin [m]
    Box bounds;

  private:
    ToolShape() = default;

    /** Takes the triangles of these points, and their edges but for those in a plane. */
    void
    set_triangles(const std::vector<std::array<unsigned int, 3>> &triangles);

    void
    finish();

    bool closed = false;
    std::shared_ptr<const BoxTree> tree; ///< of the faces
  };
} // namespace Supple

#endif
