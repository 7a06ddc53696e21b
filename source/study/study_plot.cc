#include <supple/base/files.h>
#include <supple/output/gnuplot.h>
#include <supple/study/study_table.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Supple
{
  namespace
  {
    /** Points of one line. */
    struct Curve
    {
      std::string name;
      std::vector<std::pair<double, double>> points;
    };


    struct Plot
    {
      std::string file; ///< without ending
      std::string x_title;
      std::vector<Curve> curves;
      std::vector<std::pair<double, double>> front; ///< may be empty
    };


    /** @param x what stands on the horizontal axis */
    template <class Abscissa>
    std::vector<Curve>
    curves_of(const StudyTable &table, const Abscissa &x)
    {
      std::vector<Curve> curves;
      for (const StudyRow &row : table.rows)
        {
          if (!(row.error() > 0.) || !(x(row) > 0.))
            continue;
          if (curves.empty() || curves.back().name != row.run.curve)
            curves.push_back({row.run.curve, {}});
          curves.back().points.emplace_back(x(row), row.error());
        }
      return curves;
    }


    void
    write_data(std::ostream &script,
               const std::string &name,
               const std::vector<std::pair<double, double>> &points)
    {
      script << "$" << name << " << EOD\n";
      for (const auto &[x, y] : points)
        script << x << " " << 100. * y << "\n";
      script << "EOD\n";
    }


    /** What encloses all points, with some room; the numbers along both axes without exponent, or
     * all with one. */
    std::string
    ranges_of(const Plot &plot)
    {
      auto lowest  = plot.curves.front().points.front();
      auto highest = lowest;
      for (const Curve &curve : plot.curves)
        for (const auto &[x, y] : curve.points)
          {
            lowest  = {std::min(lowest.first, x), std::min(lowest.second, y)};
            highest = {std::max(highest.first, x), std::max(highest.second, y)};
          }
      std::ostringstream text;
      lowest  = {0.7 * lowest.first, 70. * lowest.second};
      highest = {1.4 * highest.first, 140. * highest.second};
      text << "set xrange [" << lowest.first << ":" << highest.first << "]\n"
           << "set yrange [" << lowest.second << ":" << highest.second << "]\n"
           << "set format "
           << quoted(std::min(lowest.first, lowest.second) < 1e-4 ||
                         std::max(highest.first, highest.second) >= 1e6
                       ? "%.0e"
                       : "%g")
           << "\n";
      return text.str();
    }


    /**
     * The line of a curve. Open marks and lines by turns thick and thin, so that of two curves that
     * lie on one another both are seen; the numbers of colours and marks have no common divisor, so
     * that 99 curves differ.
     */
    std::string
    style_of(const std::size_t curve)
    {
      const std::vector<const char *> colors = {"#1f77b4",
                                                "#d62728",
                                                "#2ca02c",
                                                "#9467bd",
                                                "#ff7f0e",
                                                "#17becf",
                                                "#8c564b",
                                                "#e377c2",
                                                "#7f7f7f",
                                                "#bcbd22",
                                                "#000000"};
      const std::vector<int> marks           = {4, 6, 8, 10, 12, 1, 14, 2, 3};

      std::ostringstream text;
      text << "lw " << (curve % 2 == 0 ? "3" : "1.5") << " ps 1 pt " << marks[curve % marks.size()]
           << " dt " << 1 + curve / colors.size() << " lc rgb \"" << colors[curve % colors.size()]
           << "\"";
      return text.str();
    }


    std::string
    script_of(const StudyTable &table, const Plot &plot)
    {
      std::ostringstream script;
      script << "# gnuplot " << plot.file << ".gp draws " << plot.file << ".svg and .png anew.\n"
             << "folder = ARGC > 0 ? ARG1.\"/\" : \"\"\n";
      for (std::size_t c = 0; c < plot.curves.size(); ++c)
        write_data(script, "curve" + std::to_string(c), plot.curves[c].points);
      if (!plot.front.empty())
        write_data(script, "front", plot.front);

      script << "set title " << quoted(table.name) << " noenhanced\n"
             << "set logscale xy\n"
             << "set xlabel " << quoted(plot.x_title) << "\n"
             << "set ylabel " << quoted("relative error of " + table.error_names.front() + " [%]")
             << " noenhanced\n"
             << "set grid xtics ytics lt 1 lc rgb \"#dddddd\"\n"
             << "set border 3\nset tics nomirror\n"
             << "set key outside right top noenhanced Left reverse\n"
             << ranges_of(plot) << "plot \\\n";
      if (!plot.front.empty())
        script << "  $front with lines lw 9 lc rgb \"#e4e4e4\" title \"front\", \\\n";
      for (std::size_t c = 0; c < plot.curves.size(); ++c)
        script << "  $curve" << c << " with linespoints " << style_of(c) << " title "
               << quoted(plot.curves[c].name) << (c + 1 < plot.curves.size() ? ", \\\n" : "\n");

      std::string body       = script.str();
      const auto draw        = body.find("plot \\\n");
      const std::string what = body.substr(draw);
      body.resize(draw);
      return body + "set terminal svg size 880,560 font \"Helvetica,14\" background \"white\"\n" +
             "set output folder.\"" + plot.file + ".svg\"\n" + what +
             "set terminal pngcairo size 1100,700 font \"Helvetica,13\"\n" +
             "set output folder.\"" + plot.file + ".png\"\nreplot\n";
    }
  } // namespace


  std::string
  plot_study(const StudyTable &table, const std::string &folder)
  {
    const bool methods      = table.kind == StudyPlan::Kind::methods;
    const auto seconds      = [](const StudyRow &row) { return row.seconds; };
    const auto size         = [](const StudyRow &row) { return row.size; };
    std::vector<Plot> plots = {{"work_precision", "run time [s]", curves_of(table, seconds), {}},
                               {"convergence",
                                methods ? "mean step [s]" : "size of the cells [m]",
                                curves_of(table, size),
                                {}}};
    for (const StudyRow &row : table.rows)
      if (row.on_front && row.error() > 0.)
        plots[0].front.emplace_back(row.seconds, row.error());
    std::sort(plots[0].front.begin(), plots[0].front.end());
    if (plots[0].curves.empty())
      return "No run has an error that could be drawn.";

    for (const Plot &plot : plots)
      {
        write_whole_file(folder + "/" + plot.file + ".gp", script_of(table, plot));
        const std::string problem = draw(folder, plot.file);
        if (!problem.empty())
          return problem;
      }
    return "";
  }
} // namespace Supple
