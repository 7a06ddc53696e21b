#include <supple/identification/identification_table.h>
#include <supple/report/report_page.h>

namespace Supple
{
  void
  write_report(const std::string &folder, const IdentificationTable &table)
  {
    Json profiles = Json::array();
    for (std::size_t set = 0; set < table.best_profiles.size(); ++set)
      {
        Json profile = {{"set", table.set_numbers[set]},
                        {"pair", table.words(table.best_of_set(set).pair)},
                        {"distances", Json::array()},
                        {"measured", Json::array()},
                        {"computed", Json::object()}};
        for (const ComparedPoint &point : table.best_profiles[set])
          {
            profile["distances"].push_back(brief_number(point.distance / table.unit_length));
            profile["measured"].push_back(brief_number(point.measured / table.unit_length));
            for (std::size_t side = 0; side < table.side_names.size(); ++side)
              profile["computed"][table.side_names[side]].push_back(
                brief_number(point.computed[side] / table.unit_length));
          }
        profiles.push_back(profile);
      }
    write_page(folder,
               {{"kind", "identification"},
                {"name", table.name},
                {"unit", table.unit},
                {"sets", table.set_numbers},
                {"facts", table.facts},
                {"note", table.note},
                {"sentences", table.sentences()},
                {"csv", table.csv()},
                {"profiles", profiles},
                {"version", SUPPLE_VERSION}});
  }
} // namespace Supple
