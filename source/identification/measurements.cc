#include <supple/identification/measurements.h>

#include <supple/base/error.h>
#include <supple/base/text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>

namespace Supple
{
  namespace
  {
    using dealii::Utilities::trim;

    constexpr unsigned int fewest_points = 3;


    double
    number(const std::string &text, const std::string &place, const std::string &column)
    {
      char *end          = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      if (text.empty() || *end != '\0' || !std::isfinite(value))
        throw InputError(place + ": the " + column + " is '" + text + "'; it must be a number.");
      if (value < 0.)
        throw InputError(place + ": the " + column + " is " + text + "; it must not be negative.");
      return value;
    }


    /** Without the empty ones at the end, which spreadsheets leave. */
    std::vector<std::string>
    fields_of(const std::string &line, const std::string &place)
    {
      require_length(line.size(), longest_line, place);
      auto fields = dealii::Utilities::split_string_list(trim(line), ',');
      while (!fields.empty() && fields.back().empty())
        fields.pop_back();
      return fields;
    }


    void
    check_fields(const std::size_t n_fields, const std::size_t n_titles, const std::string &place)
    {
      if (n_fields < 3)
        throw InputError(place + ": found " + std::to_string(n_fields) +
                         " value(s); there must be three: set, distance, depth.");
      if (n_fields > n_titles)
        throw InputError(place + ": found " + std::to_string(n_fields) +
                         " values, the first line has " + std::to_string(n_titles) +
                         "; decimals need a point, not a comma.");
    }


    void
    add_point(std::map<unsigned int, MeasuredSet> &sets,
              const std::vector<std::string> &fields,
              const double unit,
              const std::string &place)
    {
      const double set      = number(fields[0], place, "set");
      const double distance = unit * number(fields[1], place, "distance");
      const double depth    = unit * number(fields[2], place, "depth");
      if (set != std::floor(set) || set > 1e6)
        throw InputError(place + ": the set is " + fields[0] + "; it must be a whole number.");

      MeasuredSet &points = sets[static_cast<unsigned int>(set)];
      points.number       = static_cast<unsigned int>(set);
      if (!points.distances.empty() && distance <= points.distances.back())
        throw InputError(place + ": the distance is " + fields[1] +
                         ", but the point before of set " + fields[0] +
                         " is not nearer to the needle. Sort each set by distance.");
      if (points.distances.empty() && depth == 0.)
        throw InputError(place + ": the depth is 0 at the first point of set " + fields[0] +
                         ", by which the depth of the needle is found; it must be positive.");
      points.distances.push_back(distance);
      points.depths.push_back(depth);
      points.places.push_back(place);
    }


    std::vector<MeasuredSet>
    chosen(const std::map<unsigned int, MeasuredSet> &sets,
           const std::vector<unsigned int> &wanted,
           const std::string &file,
           const std::string &origin)
    {
      for (const unsigned int set : wanted)
        if (sets.count(set) == 0)
          throw InputError(origin + ": there is no set " + std::to_string(set) + " in " + file +
                           ".");
      std::vector<MeasuredSet> list;
      for (const auto &[set, points] : sets)
        {
          if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), set) == wanted.end())
            continue;
          if (points.distances.size() < fewest_points)
            throw InputError(points.places.back() + ": set " + std::to_string(set) +
                             " ends here with " + std::to_string(points.distances.size()) +
                             " point(s); at least " + std::to_string(fewest_points) +
                             " are needed.");
          list.push_back(points);
        }
      return list;
    }
  } // namespace


  std::vector<MeasuredSet>
  read_measurements(const std::string &file,
                    const double unit,
                    const std::vector<unsigned int> &wanted,
                    const std::string &origin)
  {
    std::ifstream stream(file);
    std::string line;
    if (!stream || !std::getline(stream, line))
      throw InputError(origin + ": there is no such file, or nothing in it: " + file + ".");
    const std::string byte_order_mark = "\xEF\xBB\xBF"; // that spreadsheets begin with
    if (line.rfind(byte_order_mark, 0) == 0)
      line.erase(0, byte_order_mark.size());
    const auto titles = fields_of(line, file + ":1");
    if (titles.size() < 3 || titles[0] != "set" || titles[1] != "distance" || titles[2] != "depth")
      throw InputError(file + ":1: found '" + trim(line) +
                       "'; the first line must be set,distance,depth.");

    std::map<unsigned int, MeasuredSet> sets;
    for (unsigned int n = 2; std::getline(stream, line); ++n)
      if (!trim(line).empty())
        {
          const std::string place = file + ":" + std::to_string(n);
          const auto fields       = fields_of(line, place);
          check_fields(fields.size(), titles.size(), place);
          add_point(sets, fields, unit, place);
        }
    if (sets.empty())
      throw InputError(file + ":1: no measurement follows this line.");
    return chosen(sets, wanted, file, origin);
  }
} // namespace Supple
