#include <supple/report/report_page.h>

#include <supple/base/error.h>
#include <supple/base/files.h>

#include <deal.II/base/utilities.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace Supple
{
  namespace
  {
    void
    replace(std::string &text, const std::string &mark, const std::string &content)
    {
      const std::size_t place = text.find(mark);
      if (place == std::string::npos)
        throw WriteError("The report page has no place for " + mark + ".");
      text.replace(place, mark.size(), content);
    }
  } // namespace


  Json
  brief_number(const double value)
  {
    if (!std::isfinite(value))
      return nullptr;
    if (value == std::round(value) && std::abs(value) < 1e7)
      return static_cast<long>(value);
    char text[32];
    std::snprintf(text, sizeof(text), "%.7g", value);
    return std::strtod(text, nullptr);
  }


  // In a script, "</" would end it.
  std::string
  page_text(const Json &data, const std::vector<unsigned char> &surface)
  {
    std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace), safe;
    safe.reserve(text.size());
    for (const char c : text)
      safe += c == '<' ? "\\u003c" : std::string(1, c);
    std::string page = report_page;
    replace(page, "SUPPLE_SURFACE", dealii::Utilities::encode_base64(surface));
    replace(page, "SUPPLE_DATA", safe);
    return page;
  }


  void
  write_page(const std::string &folder, const Json &data, const std::vector<unsigned char> &surface)
  {
    write_durable_file(folder + "/" + page_file, page_text(data, surface));
  }
} // namespace Supple
