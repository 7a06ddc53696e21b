#include <supple/report/report.h>

#include <supple/base/expression.h>
#include <supple/contact/tool_surface.h>
#include <supple/report/report_page.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

namespace Supple
{
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
              const double value = std::strtod(at, &end);
              column.push_back(end == at ? std::numeric_limits<double>::quiet_NaN() : value);
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
      std::set<fs::path> files;
      for (const auto &entry : fs::directory_iterator(folder))
        if (entry.path().extension() == ".csv")
          files.insert(entry.path());
      for (const fs::path &file : files)
        {
          const std::string name = file.stem().string();
          const bool profile     = name.rfind("profile_", 0) == 0;
          if (!profile && name.rfind("tool_", 0) != 0)
            continue;
          const Table table = read_table(file);
          tables[name] =
            to_json(table, profile ? rows_of_telling_steps(table) : telling_rows(table));
        }
      return tables;
    }


    /** Surfaces of the tools in their frames, and their poses at some times. */
    Json
    drawn(const std::vector<Tool> &tools, const double extent, const Json &times)
    {
      Json list = Json::array();
      for (const Tool &tool : tools)
        {
          Json poses = Json::array();
          for (const Json &time : times)
            {
              const Pose pose = tool.pose(time.get<double>());
              for (const Arrow &vector : {pose.place, pose.turn})
                for (unsigned int i = 0; i < 3; ++i)
                  poses.push_back(brief_number(vector[i]));
            }
          list.push_back(surface_of(tool, extent));
          list.back()["poses"] = poses;
        }
      return list;
    }
  } // namespace


  Json
  surface_of(const Tool &tool, const double extent)
  {
    const TriangleMesh surface = drawn_surface(tool, extent);
    Json points = Json::array(), corners = Json::array();
    for (const auto &place : surface.points)
      for (const double x : place)
        points.push_back(brief_number(x));
    for (const auto &triangle : surface.triangles)
      for (const unsigned int corner : triangle)
        corners.push_back(corner);
    return {{"name", tool.parameters.name}, {"points", points}, {"triangles", corners}};
  }


  std::string
  full_name(const Parameters &parameters)
  {
    const std::string folder = std::filesystem::path(parameters.file.folder()).filename().string();
    return (folder.empty() || folder[0] == '.' ? "" : folder + "/") + parameters.scene_name;
  }


  Json
  upward(const Parameters &parameters)
  {
    const Expression gravity(parameters.loads.gravity_expressions(),
                             3,
                             parameters.origin("Loads/Gravity"));
    const double end = parameters.time.end();
    dealii::Tensor<1, 3> g;
    for (unsigned int i = 0; i < 3; ++i)
      g[i] = gravity.value({0., 0., 0.}, end, i);
    return g.norm() > 0. ? Json{-g[0], -g[1], -g[2]} : Json();
  }


  void
  write_report(const std::string &folder,
               const Parameters &parameters,
               const Json &summary,
               const Film *film,
               const std::vector<Tool> &tools,
               const double extent)
  {
    Json data = {
      {"kind", "run"},
      {"name", full_name(parameters)},
      {"static", parameters.time.problem == TimeParameters::Problem::stationary},
      {"up", upward(parameters)},
      {"summary", summary},
      {"tables", tables_of(folder)},
      {"parameters", parameters.as_used},
    };
    std::vector<unsigned char> surface;
    if (film)
      {
        const PackedFilm packed = film->pack(most_surface_bytes);
        data["surface"]         = packed.description();
        data["tools"]           = drawn(tools, extent, data["surface"]["times"]);
        surface                 = packed.bytes;
      }
    write_page(folder, data, surface);
  }
} // namespace Supple
