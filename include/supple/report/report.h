#ifndef supple_report_h
#define supple_report_h

#include <supple/contact/tool.h>
#include <supple/output/film.h>
#include <supple/scene/parameters.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace Supple
{
  /** The scene with the folder of its file: "bar/large". */
  std::string
  full_name(const Parameters &parameters);


  /** Against gravity at the end of the scene; null without it. */
  nlohmann::ordered_json
  upward(const Parameters &parameters);


  /** The surface of a tool in its frame, as pages draw it: name, points [m], triangles.
   * @param extent with which planes are drawn [m] */
  nlohmann::ordered_json
  surface_of(const Tool &tool, double extent);


  /**
   * Writes report.html, the page of a run that needs no network: from the tables in the folder, the
   * film, the summary and the parameters. Where there is more than a page can show, tables are
   * thinned to a few thousand rows, those with extremes among them, and frames to some megabytes;
   * the page says so.
   * @param summary as in summary.json
   * @param film    may be null
   * @param extent  with which planes are drawn [m]
   * @throws WriteError
   */
  void
  write_report(const std::string &folder,
               const Parameters &parameters,
               const nlohmann::ordered_json &summary,
               const Film *film,
               const std::vector<Tool> &tools,
               double extent);
} // namespace Supple

#endif
