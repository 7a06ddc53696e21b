#ifndef supple_tool_polygons_h
#define supple_tool_polygons_h

#include <supple/contact/tool.h>

#include <string>
#include <vector>

namespace Supple
{
  /** All tools at an instant as a file of VTK's polygons (.vtp), with their numbers.
   * @param extent edge of the squares that stand for planes [m] */
  std::string
  draw_tools(const std::vector<Tool> &tools, const std::vector<Pose> &poses, double extent);
} // namespace Supple

#endif
