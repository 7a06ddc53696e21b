#include <supple/report/report_page.h>
#include <supple/study/study_table.h>

namespace Supple
{
  void
  write_report(const std::string &folder, const StudyTable &table)
  {
    Json rows = Json::array();
    for (const StudyRow &row : table.rows)
      rows.push_back({{"label", row.run.label()},
                      {"curve", row.run.curve},
                      {"seconds", brief_number(row.seconds)},
                      {"size", brief_number(row.size)},
                      {"error", brief_number(row.error())},
                      {"front", row.on_front},
                      {"done", row.status == StudyRecord::Status::done}});
    write_page(folder,
               {{"kind", "study"},
                {"name", table.name},
                {"by_step", table.kind == StudyPlan::Kind::methods},
                {"cases", table.kind == StudyPlan::Kind::cases},
                {"facts", table.facts},
                {"sentences", table.sentences()},
                {"rows", rows},
                {"csv", table.csv()},
                {"version", SUPPLE_VERSION}});
  }
} // namespace Supple
