#include <supple/base/files.h>
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


  std::vector<std::string>
  study_files()
  {
    return {"study.csv",
            "study.md",
            "report.html",
            "work_precision.gp",
            "work_precision.svg",
            "work_precision.png",
            "convergence.gp",
            "convergence.svg",
            "convergence.png"};
  }


  void
  write_study(const std::string &folder, const StudyTable &table)
  {
    write_whole_file(folder + "/study.csv", table.csv());
    write_whole_file(folder + "/study.md", table.markdown());
    write_report(folder, table);
  }
} // namespace Supple
