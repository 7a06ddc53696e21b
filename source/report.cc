#include <supple/error.h>
#include <supple/identification_table.h>
#include <supple/report.h>
#include <supple/study_table.h>
#include <supple/tables.h>

#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace Supple
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    const std::size_t most_surface_bytes = 6'000'000; // a third more in the page
    const std::size_t most_rows          = 2000;
    const std::size_t most_profile_rows  = 20000;


    struct Table
    {
      std::vector<std::string> names;
      std::vector<std::vector<double>> columns;

      std::size_t
      n_rows() const
      {
        return columns.empty() ? 0 : columns.front().size();
      }
    };


    Table
    read_table(const std::string &file)
    {
      Table table;
      std::ifstream stream(file);
      std::string line;
      std::getline(stream, line);
      std::istringstream names(line);
      for (std::string name; std::getline(names, name, ',');)
        table.names.push_back(name);
      table.columns.resize(table.names.size());
      while (std::getline(stream, line))
        {
          const char *at = line.c_str();
          for (std::vector<double> &column : table.columns)
            {
              char *end;
              column.push_back(std::strtod(at, &end));
              at = *end == ',' ? end + 1 : end;
            }
        }
      return table;
    }


    /** Every so many rows, and those where a column is largest or smallest. */
    std::set<std::size_t>
    telling_rows(const Table &table)
    {
      std::set<std::size_t> rows;
      const std::size_t n = table.n_rows(), every = n / most_rows + 1;
      for (std::size_t row = 0; row < n; row += every)
        rows.insert(row);
      if (n == 0 || every == 1)
        return rows;
      rows.insert(n - 1);
      for (const std::vector<double> &column : table.columns)
        {
          const auto [low, high] = std::minmax_element(column.begin(), column.end());
          rows.insert(low - column.begin());
          rows.insert(high - column.begin());
        }
      return rows;
    }


    /** A profile has many rows for each of its steps: all rows of some of them. */
    std::set<std::size_t>
    rows_of_telling_steps(const Table &table)
    {
      const std::vector<double> &steps = table.columns.front();
      const std::size_t n_steps        = std::set<double>(steps.begin(), steps.end()).size();
      const std::size_t every          = table.n_rows() / most_profile_rows + 1;
      std::set<std::size_t> rows;
      std::size_t number = 0; // of the step
      for (std::size_t row = 0; row < steps.size(); ++row)
        {
          if (row > 0 && steps[row] != steps[row - 1])
            ++number;
          if (number % every == 0 || number + 1 == n_steps)
            rows.insert(row);
        }
      return rows;
    }


    /** With the seven digits that a picture needs; null for what is no number. */
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


    Json
    to_json(const Table &table, const std::set<std::size_t> &rows)
    {
      Json json     = {{"rows", table.n_rows()}, {"shown", rows.size()}};
      Json &columns = json["columns"];
      columns       = Json::object();
      for (std::size_t c = 0; c < table.names.size(); ++c)
        {
          Json column = Json::array();
          for (const std::size_t row : rows)
            column.push_back(brief_number(table.columns[c][row]));
          columns[table.names[c]] = std::move(column);
        }
      return json;
    }


    Json
    tables_of(const std::string &folder)
    {
      namespace fs = std::filesystem;
      Json tables  = Json::object();
      for (const char *name : {"history", "probes", "error"})
        if (const auto file = fs::path(folder) / (std::string(name) + ".csv"); fs::exists(file))
          {
            const Table table = read_table(file);
            tables[name]      = to_json(table, telling_rows(table));
          }
      std::set<fs::path> profiles;
      for (const auto &entry : fs::directory_iterator(folder))
        if (entry.path().filename().string().rfind("profile_", 0) == 0 &&
            entry.path().extension() == ".csv")
          profiles.insert(entry.path());
      for (const fs::path &file : profiles)
        {
          const Table table            = read_table(file);
          tables[file.stem().string()] = to_json(table, rows_of_telling_steps(table));
        }
      return tables;
    }


    void
    replace(std::string &text, const std::string &mark, const std::string &content)
    {
      const std::size_t place = text.find(mark);
      if (place == std::string::npos)
        throw WriteError("The report page has no place for " + mark + ".");
      text.replace(place, mark.size(), content);
    }


    /** The page with its data; in a script, "</" would end it. */
    void
    write_page(const std::string &folder,
               const Json &data,
               const std::vector<unsigned char> &surface)
    {
      std::string text = data.dump(-1, ' ', false, Json::error_handler_t::replace), safe;
      safe.reserve(text.size());
      for (const char c : text)
        safe += c == '<' ? "\\u003c" : std::string(1, c);
      std::string page = report_page;
      replace(page, "SUPPLE_SURFACE", dealii::Utilities::encode_base64(surface));
      replace(page, "SUPPLE_DATA", safe);
      write_whole_file(folder + "/report.html", page);
    }


    /** The scene with the folder of its file: "bar/large". */
    std::string
    full_name(const Parameters &parameters)
    {
      const std::string folder = std::filesystem::path(parameters.scene_folder).filename().string();
      return (folder.empty() || folder[0] == '.' ? "" : folder + "/") + parameters.scene_name;
    }


    /** Against gravity; null without it. */
    Json
    upward(const Parameters &parameters)
    {
      const auto &g = parameters.loads.gravity;
      return g.norm() > 0. ? Json{-g[0], -g[1], -g[2]} : Json();
    }
  } // namespace


  void
  write_report(const std::string &folder,
               const Parameters &parameters,
               const std::string &summary,
               const Film *film)
  {
    std::ostringstream used;
    parameters.print(used);
    Json data = {
      {"kind", "run"},
      {"name", full_name(parameters)},
      {"static", parameters.time.problem == TimeParameters::Problem::stationary},
      {"up", upward(parameters)},
      {"summary", Json::parse(summary)},
      {"tables", tables_of(folder)},
      {"parameters", used.str()},
    };
    std::vector<unsigned char> surface;
    if (film)
      {
        const Film::Packed packed = film->pack(most_surface_bytes);
        data["surface"]           = packed.description();
        surface                   = packed.bytes;
      }
    write_page(folder, data, surface);
  }


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
                {"version", SUPPLE_VERSION}},
               {});
  }


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
                {"sentences", table.sentences()},
                {"csv", table.csv()},
                {"profiles", profiles},
                {"version", SUPPLE_VERSION}},
               {});
  }
} // namespace Supple
