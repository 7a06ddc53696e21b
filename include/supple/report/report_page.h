#ifndef supple_report_page_h
#define supple_report_page_h

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace Supple
{
  using Json = nlohmann::ordered_json;

  /** The page without its data, as scripts/build-report.sh makes it of source/report. */
  extern const char report_page[];


  /** The name of a report in the folder of its results. */
  constexpr const char *page_file = "report.html";


  /** With the seven digits that a picture needs; null for what is no number. */
  Json
  brief_number(double value);


  /** The page with its data. @param surface as of write_page() */
  std::string
  page_text(const Json &data, const std::vector<unsigned char> &surface = {});


  /**
   * Writes report.html, the page with its data. Its "kind" tells source/report/main.js what is
   * shown.
   * @param surface of a body in its frames, as Film packs them; empty: none
   * @throws WriteError
   */
  void
  write_page(const std::string &folder,
             const Json &data,
             const std::vector<unsigned char> &surface = {});
} // namespace Supple

#endif
