#include <supple/study/study_table.h>

#include <supple/base/text.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <regex>

namespace Supple
{
  namespace
  {
    /** A column of the table, in both forms; without any text it is left out of the Markdown. */
    struct Column
    {
      std::string csv_name, title;
      std::vector<std::string> csv, markdown;

      void
      add(const std::string &text)
      {
        csv.push_back(text);
        markdown.push_back(text);
      }

      void
      add(const double number, const std::string &shown)
      {
        csv.push_back(std::isfinite(number) ? digits(number, 10) : "");
        markdown.push_back(std::isfinite(number) ? shown : "");
      }

      bool
      empty() const
      {
        return std::all_of(markdown.begin(), markdown.end(), [](const std::string &text) {
          return text.empty();
        });
      }
    };


    std::string
    csv_field(const std::string &text)
    {
      if (text.find_first_of(",\"\n") == std::string::npos)
        return text;
      return "\"" + std::regex_replace(text, std::regex("\""), "\"\"") + "\"";
    }


    std::string
    markdown_field(const std::string &text)
    {
      return std::regex_replace(std::regex_replace(text, std::regex("\n"), " "),
                                std::regex("\\|"),
                                "\\|");
    }


    double
    or_nothing(const double number)
    {
      return number > 0. ? number : std::numeric_limits<double>::quiet_NaN();
    }


    void
    add_names(std::vector<Column> &columns, const StudyTable &table)
    {
      const bool methods = table.kind == StudyPlan::Kind::methods;
      const bool levels  = table.kind == StudyPlan::Kind::levels;
      Column series{methods ? "method" : "variant", methods ? "method" : "variant", {}, {}};
      Column level{"level", "level", {}, {}};
      Column name{methods  ? "run"
                  : levels ? "level"
                           : "case",
                  methods  ? "step or tolerance"
                  : levels ? "level"
                           : "case",
                  {},
                  {}};
      Column step{"step", "", {}, {}}, tolerance{"tolerance", "", {}, {}};
      Column cells{"cells", "cells", {}, {}}, size{methods ? "mean_step" : "cell_size", "", {}, {}};
      for (const StudyRow &row : table.rows)
        {
          level.add(row.run.level);
          series.add(row.run.series);
          name.add(row.run.name);
          step.add(or_nothing(row.run.step), "");
          tolerance.add(or_nothing(row.run.tolerance), "");
          cells.add(or_nothing(row.n_cells), std::to_string(row.n_cells));
          size.add(or_nothing(row.size), "");
        }
      if (table.on_levels())
        columns.push_back(level);
      if (methods || levels)
        columns.push_back(series);
      columns.push_back(name);
      if (methods)
        columns.insert(columns.end(), {step, tolerance});
      if (levels || table.on_levels())
        columns.push_back(cells);
      if (methods || levels)
        columns.push_back(size);
    }


    /** What of the whole error is of the mesh, and what of the steps. */
    void
    add_both_errors(std::vector<Column> &columns, const StudyTable &table)
    {
      Column space{"error_in_space", "in space", {}, {}}, time{"error_in_time", "in time", {}, {}};
      for (const StudyRow &row : table.rows)
        {
          space.add(row.error_in_space, percent(row.error_in_space));
          time.add(row.error_in_time, percent(row.error_in_time));
        }
      columns.insert(columns.end(), {space, time});
    }


    void
    add_errors_and_values(std::vector<Column> &columns, const StudyTable &table)
    {
      const auto at = [](const std::vector<double> &numbers, const std::size_t i) {
        return i < numbers.size() ? numbers[i] : std::numeric_limits<double>::quiet_NaN();
      };
      for (std::size_t i = 0; i < table.value_names.size(); ++i)
        {
          Column column{table.value_names[i], table.value_names[i], {}, {}};
          for (const StudyRow &row : table.rows)
            {
              column.add(at(row.values, i), digits(at(row.values, i), 6));
            }
          columns.push_back(column);
        }
      for (std::size_t i = 0; i < table.error_names.size(); ++i)
        {
          const std::string name =
            std::regex_replace("error_" + table.error_names[i], std::regex(" "), "_");
          Column column{name, "error of " + table.error_names[i], {}, {}};
          for (const StudyRow &row : table.rows)
            {
              const double error = at(row.errors, i);
              const bool unclear = i == 0 && error < 3. * table.reference_error;
              column.add(error, percent(error) + (unclear ? " (?)" : ""));
            }
          columns.push_back(column);
          if (table.on_levels())
            {
              if (i == 0)
                add_both_errors(columns, table);
              continue;
            }
          if (table.kind == StudyPlan::Kind::cases ||
              (i > 0 && table.kind == StudyPlan::Kind::methods))
            continue;
          Column order{i == 0 ? "order" : "order_" + table.error_names[i], "order", {}, {}};
          for (const StudyRow &row : table.rows)
            {
              char shown[32];
              std::snprintf(shown, sizeof(shown), "%.2f", at(row.orders, i));
              order.add(at(row.orders, i), shown);
            }
          columns.push_back(order);
        }
    }


    void
    add_costs(std::vector<Column> &columns, const StudyTable &table)
    {
      Column seconds{"seconds", "seconds", {}, {}}, steps{"steps", "steps", {}, {}};
      Column rejected{"rejected_steps", "rejected", {}, {}};
      Column failed{"failed_steps", "failures", {}, {}};
      Column front{"front", "front", {}, {}}, verdict{"verdict", "verdict", {}, {}};
      Column status{"status", "note", {}, {}};
      for (const StudyRow &row : table.rows)
        {
          const bool ran = row.status != StudyRecord::Status::refused;
          seconds.add(ran ? row.seconds : std::numeric_limits<double>::quiet_NaN(),
                      digits(row.seconds, 3));
          steps.add(row.steps, ran ? std::to_string(row.steps) : "");
          rejected.add(row.rejected, ran ? std::to_string(row.rejected) : "");
          failed.add(row.failed, ran ? std::to_string(row.failed) : "");
          front.add(row.on_front ? 1. : 0., row.on_front ? "*" : "");
          verdict.add(row.verdict);
          status.csv.push_back(row.status_text());
          status.markdown.push_back(row.note());
        }
      columns.insert(columns.end(), {seconds, steps, rejected, failed});
      if (table.kind != StudyPlan::Kind::cases)
        columns.push_back(front);
      if (table.judged)
        columns.push_back(verdict);
      columns.push_back(status);
    }


    std::vector<Column>
    columns_of(const StudyTable &table)
    {
      std::vector<Column> columns;
      add_names(columns, table);
      add_errors_and_values(columns, table);
      add_costs(columns, table);
      return columns;
    }
  } // namespace


  std::string
  percent(const double part)
  {
    return std::isfinite(part) ? digits(100. * part, 3) + " %" : "unknown";
  }


  void
  StudyRow::take(const StudyRecord &record)
  {
    status   = record.status;
    reason   = record.reason;
    steps    = record.steps;
    rejected = record.rejected;
    failed   = record.failed;
    seconds  = record.seconds;
    n_cells  = record.n_cells;
    warnings = record.warnings;
  }


  double
  StudyRow::error() const
  {
    return status != StudyRecord::Status::done || errors.empty()
             ? std::numeric_limits<double>::quiet_NaN()
             : errors.front();
  }


  std::string
  StudyRow::status_text() const
  {
    switch (status)
      {
        case StudyRecord::Status::done:
          return "done";
        case StudyRecord::Status::failed:
          return "failed: " + reason;
        case StudyRecord::Status::refused:
          return "refused: " + reason;
      }
    return "";
  }


  std::string
  StudyRow::note() const
  {
    if (status != StudyRecord::Status::done)
      return status_text();
    std::string text;
    for (const std::string &warning : warnings)
      text += (text.empty() ? "" : " ") + warning;
    return text;
  }


  bool
  StudyTable::on_levels() const
  {
    return std::any_of(rows.begin(), rows.end(), [](const StudyRow &row) {
      return !row.run.level.empty();
    });
  }


  void
  StudyTable::add(const StudyRow &row)
  {
    rows.push_back(row);
    find_orders();
    find_front();
  }


  void
  StudyTable::find_orders()
  {
    for (std::size_t i = 0; i < rows.size(); ++i)
      {
        rows[i].orders.assign(rows[i].errors.size(), std::numeric_limits<double>::quiet_NaN());
        for (std::size_t j = i; j-- > 0;)
          if (rows[j].run.curve == rows[i].run.curve && std::isfinite(rows[j].error()))
            {
              if (rows[i].size != rows[j].size)
                for (std::size_t e = 0; e < rows[i].errors.size(); ++e)
                  if (rows[i].errors[e] > 0. && rows[j].errors[e] > 0.)
                    rows[i].orders[e] = std::log(rows[j].errors[e] / rows[i].errors[e]) /
                                        std::log(rows[j].size / rows[i].size);
              break;
            }
      }
  }


  void
  StudyTable::find_front()
  {
    for (StudyRow &row : rows)
      row.on_front = std::isfinite(row.error()) &&
                     std::none_of(rows.begin(), rows.end(), [&](const auto &other) {
                       return other.error() <= row.error() && other.seconds <= row.seconds &&
                              (other.error() < row.error() || other.seconds < row.seconds);
                     });
  }


  std::vector<std::string>
  StudyTable::sentences() const
  {
    std::vector<std::string> list;
    for (const double target : targets)
      {
        const StudyRow *best = nullptr;
        for (const StudyRow &row : rows)
          if (row.error() <= target && (!best || row.seconds < best->seconds))
            best = &row;
        std::string text = percent(target) + " : ";
        if (target < reference_error)
          text += "the reference is not known that well";
        else if (best)
          text += best->run.label() + ", " + digits(best->seconds, 3) + " s";
        else
          text += "none of these runs";
        list.push_back(text);
      }
    return list;
  }


  std::string
  StudyTable::csv() const
  {
    const std::vector<Column> columns = columns_of(*this);
    std::string text;
    for (const Column &column : columns)
      text += (&column == &columns.front() ? "" : ",") + csv_field(column.csv_name);
    text += "\n";
    for (std::size_t i = 0; i < rows.size(); ++i)
      {
        for (const Column &column : columns)
          text += (&column == &columns.front() ? "" : ",") + csv_field(column.csv[i]);
        text += "\n";
      }
    return text;
  }


  std::string
  StudyTable::markdown() const
  {
    std::string text = "# Study " + name + "\n\n";
    for (const std::string &fact : facts)
      text += "- " + fact + "\n";
    text += "\n";

    std::vector<Column> columns = columns_of(*this);
    columns.erase(std::remove_if(columns.begin(),
                                 columns.end(),
                                 [](const Column &column) { return column.empty(); }),
                  columns.end());
    std::string titles = "|", rule = "|";
    for (const Column &column : columns)
      {
        titles += " " + column.title + " |";
        rule += "---|";
      }
    text += titles + "\n" + rule + "\n";
    for (std::size_t i = 0; i < rows.size(); ++i)
      {
        text += "|";
        for (const Column &column : columns)
          text += " " + markdown_field(column.markdown[i]) + " |";
        text += "\n";
      }
    if (kind == StudyPlan::Kind::cases)
      return text;

    text += "\n`*`: no other run is both better and quicker.";
    text += on_levels() ? " In space: of the level's own reference. In time: against that."
                        : " Order: observed, from the row above.";
    if (reference_error > 0.)
      text += " (?): less than three times the reference's own error.";
    text += "\n\nSoonest at an error of\n\n";
    for (const std::string &sentence : sentences())
      text += "- " + sentence + "\n";
    return text;
  }


  std::string
  StudyTable::line(const StudyRow &row) const
  {
    std::string results;
    if (row.status != StudyRecord::Status::done)
      results = row.status_text();
    else
      {
        if (!row.errors.empty())
          results += percent(row.error()) + ", ";
        results += digits(row.seconds, 3) + " s, " + std::to_string(row.steps) + " steps";
        if (!row.verdict.empty())
          results += ", " + row.verdict;
      }
    const std::string label = row.run.label();
    return "  " + label + std::string(label.size() < 40 ? 40 - label.size() : 1, ' ') + results;
  }
} // namespace Supple
