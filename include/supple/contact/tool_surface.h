#ifndef supple_tool_surface_h
#define supple_tool_surface_h

#include <supple/contact/tool.h>
#include <supple/mechanics/body.h>

namespace Supple
{
  /** How much of a plane is drawn: the edge of a square [m]. */
  double
  extent_of_planes(const Body &body);


  /** The surface of a tool for pictures, in the tool's frame [m]. Round ones are polyhedra, and of
   * a plane it is a square about its reference point. @param extent edge of that square [m] */
  TriangleMesh
  drawn_surface(const Tool &tool, double extent);
} // namespace Supple

#endif
