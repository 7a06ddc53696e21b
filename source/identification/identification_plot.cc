#include <supple/base/files.h>
#include <supple/base/text.h>
#include <supple/identification/identification_table.h>
#include <supple/output/gnuplot.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace Supple
{
  using Total = IdentificationParameters::Total;

  namespace
  {
    /** What both kinds of plots begin with. */
    std::string
    head(const std::string &plot, const std::string &title)
    {
      return "# gnuplot " + plot + ".gp draws " + plot + ".svg and .png anew.\n" +
             "folder = ARGC > 0 ? ARG1.\"/\" : \"\"\n" + "set title " + quoted(title) +
             " noenhanced\n" + "set tics nomirror\n";
    }


    /** @param commands that draw, in both terminals */
    std::string
    foot(const std::string &plot, const std::string &commands)
    {
      return "set terminal svg size 880,560 font \"Helvetica,14\" background \"white\"\n"
             "set output folder.\"" +
             plot + ".svg\"\n" + commands +
             "set terminal pngcairo size 1100,700 font \"Helvetica,13\"\n"
             "set output folder.\"" +
             plot + ".png\"\n" + commands;
    }


    /** Tics at numbers 0, 1, ... with other names. */
    std::string
    tics(const std::string &axis, const std::vector<std::string> &names)
    {
      std::string text =
        "set " + axis + "tics " + (names.size() > 15 ? "font \"Helvetica,10\" (" : "(");
      for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : ", ") + quoted(names[i]) + " " + std::to_string(i);
      return text + ")\n";
    }


    /** Errors are small beside the lengths: in thousandths of their unit. */
    std::string
    meaning_of_errors(const IdentificationTable &table)
    {
      return "error [" + std::string(table.unit == "mm" ? "um" : "1e-3 " + table.unit) + "]";
    }


    /** An error in thousandths, so short that it fits into its box. */
    std::string
    short_text(const double number)
    {
      return digits(number >= 9.95 ? std::round(number) : number, number >= 9.95 ? 6 : 2);
    }


    std::vector<std::string>
    names_of(const std::vector<double> &numbers, const double unit)
    {
      std::vector<std::string> names;
      for (const double number : numbers)
        names.push_back(digits(number / unit, number / unit < 1e4 ? 4 : all_digits));
      return names;
    }


    /** Boxes with their errors: column, row, error in thousandths, that as text; and the best one.
     */
    template <class Number>
    std::string
    heat_data(const IdentificationTable &table, const Number &error)
    {
      const std::size_t n_columns = table.ratios.size();
      std::ostringstream text, best;
      text << "$errors << EOD\n";
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < table.pairs.size(); ++k)
        {
          const double value  = error(table.pairs[k]) / table.unit_length;
          const auto position = std::to_string(k % n_columns) + " " + std::to_string(k / n_columns);
          text << position << " " << 1e3 * value << " " << short_text(1e3 * value) << "\n";
          if (value < least)
            best.str(position);
          least = std::min(least, value);
        }
      return text.str() + "EOD\n$best << EOD\n" + best.str() + "\nEOD\n";
    }


    /** 1, 2, 5, 10, ... as far as errors reach, in thousandths. */
    template <class Number>
    std::string
    tics_between(const IdentificationTable &table, const Number &error)
    {
      double lowest = error(table.pairs.front()), highest = lowest;
      for (const PairErrors &pair : table.pairs)
        {
          lowest  = std::min(lowest, error(pair));
          highest = std::max(highest, error(pair));
        }
      lowest *= 1e3 / table.unit_length;
      highest *= 1e3 / table.unit_length;
      std::string text;
      if (lowest > 0.)
        for (double power = std::pow(10., std::floor(std::log10(lowest))); power <= highest;
             power *= 10.)
          for (const double digit : {1., 2., 5.})
            if (digit * power >= lowest && digit * power <= highest)
              text += (text.empty() ? "" : ", ") + digits(digit * power, 4);
      return text;
    }


    template <class Number>
    std::string
    heat_map(const IdentificationTable &table,
             const std::string &plot,
             const std::string &title,
             const Number &error)
    {
      const std::size_t n_rows = table.thicknesses.size(), n_columns = table.ratios.size();
      const bool unfinished = table.pairs.size() < n_rows * n_columns;
      std::ostringstream text;
      text << head(plot, title + (unfinished ? " (not complete)" : "")) << heat_data(table, error)
           << tics("x", names_of(table.ratios, 1.))
           << tics("y", names_of(table.thicknesses, table.unit_length))
           << "set xlabel \"Young modulus of the upper layer over that of the lower one\"\n"
           << "set ylabel " << quoted("thickness of the upper layer [" + table.unit + "]")
           << "\nset cblabel " << quoted(meaning_of_errors(table))
           << "\nset logscale cb\nset cbtics (" << tics_between(table, error) << ")\nunset key\n"
           << "set palette defined (0 \"#78c679\", 1 \"#c2e699\", 2 \"#fafaf0\", 3 \"#fdd9b0\", "
              "4 \"#f4ad6e\")\n"
           << "set xrange [-0.5:" << n_columns - 0.5 << "]\nset yrange [" << n_rows - 0.5
           << ":-0.5]\n";
      const std::string size = n_rows * n_columns > 200 ? "11" : "14";
      return text.str() + foot(plot,
                               "plot $errors using 1:2:(0.5):(0.5):3 with boxxyerror fs solid "
                               "noborder fc palette, \\\n"
                               "  $errors using 1:2:4 with labels font \"Helvetica," +
                                 size +
                                 "\", \\\n"
                                 "  $best using 1:2:(0.47):(0.47) with boxxyerror fs empty lw 3 lc "
                                 "rgb \"black\"\n");
    }


    std::string
    profile_plot(const IdentificationTable &table, const std::string &plot)
    {
      const std::vector<std::string> colors = {"#1f77b4", "#d62728", "#2ca02c", "#9467bd"};
      std::ostringstream text, commands;
      text << head(plot, table.name + ": the best pair of each set") << "set xlabel "
           << quoted("distance from the needle [" + table.unit + "]") << "\nset ylabel "
           << quoted("depth [" + table.unit + "]")
           << "\nset yrange [*:*] reverse\nset border 3\n"
              "set grid xtics ytics lt 1 lc rgb \"#dddddd\"\n"
              "set key bottom right noenhanced Left reverse\n";
      for (std::size_t s = 0; s < table.best_profiles.size(); ++s)
        {
          const std::string set   = std::to_string(table.set_numbers[s]);
          const std::string color = "lc rgb \"" + colors[s % colors.size()] + "\"";
          text << "$set" << s << " << EOD\n";
          for (const ComparedPoint &point : table.best_profiles[s])
            {
              text << point.distance / table.unit_length << " "
                   << point.measured / table.unit_length;
              for (const double depth : point.computed)
                text << " " << depth / table.unit_length;
              text << "\n";
            }
          text << "EOD\n";
          commands << (s == 0 ? "plot " : ", \\\n  ") << "$set" << s
                   << " using 1:2 with points pt 7 ps 1 " << color << " title "
                   << quoted("set " + set + ", measured");
          const LayerPair &best = table.best_of_set(s).pair;
          const std::string computed =
            "set " + set + ", computed: " + digits(best.thickness / table.unit_length, 4) + " " +
            table.unit + ", ratio " + digits(best.ratio, 4);
          for (std::size_t side = 0; side < table.side_names.size(); ++side)
            commands << ", \\\n  $set" << s << " using 1:" << side + 3 << " with lines lw 2 dt "
                     << side + 1 << " " << color
                     << (side == 0 ? " title " + quoted(computed + (table.side_names.size() > 1
                                                                      ? " (left; dashed: right)"
                                                                      : ""))
                                   : std::string(" notitle"));
        }
      return text.str() + foot(plot, commands.str() + "\n");
    }
  } // namespace


  std::string
  plot_identification(const IdentificationTable &table, const std::string &folder)
  {
    std::vector<std::pair<std::string, std::string>> plots;
    if (table.pairs.empty())
      return "";
    const std::string meaning = meaning_of_errors(table);
    for (std::size_t s = 0; s < table.set_numbers.size(); ++s)
      {
        const std::string set = std::to_string(table.set_numbers[s]);
        plots.emplace_back("errors_set_" + set,
                           heat_map(table,
                                    "errors_set_" + set,
                                    table.name + ": set " + set + ", " + meaning,
                                    [s](const PairErrors &pair) { return pair.errors[s]; }));
      }
    if (table.set_numbers.size() > 1)
      plots.emplace_back("errors_root_of_squares",
                         heat_map(table,
                                  "errors_root_of_squares",
                                  table.name + ": root of squares of all sets, " + meaning,
                                  [](const PairErrors &pair) {
                                    return pair.total(Total::root_of_squares);
                                  }));
    plots.emplace_back("profiles", profile_plot(table, "profiles"));
    for (const auto &[plot, script] : plots)
      write_whole_file(folder + "/" + plot + ".gp", script);
    for (const auto &[plot, script] : plots)
      {
        const std::string problem = draw(folder, plot);
        if (!problem.empty())
          return problem;
      }
    return "";
  }
} // namespace Supple
