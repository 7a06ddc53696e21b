#include <supple/run/skipped_pulses.h>

#include <supple/base/text.h>

#include <deal.II/base/utilities.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    std::vector<double>
    numbers_in(const std::string &text)
    {
      const std::regex number("[0-9]*\\.?[0-9]+([eE][+-]?[0-9]+)?|[0-9]+\\.");
      std::vector<double> found;
      for (std::sregex_iterator word(text.begin(), text.end(), number), end; word != end; ++word)
        found.push_back(std::strtod(word->str().c_str(), nullptr));
      std::sort(found.begin(), found.end());
      return found;
    }


    /** Both ends and the middle of each part of an interval that is cut at these numbers, of which
     * the first few count. */
    std::vector<double>
    places_between(const double low,
                   const double high,
                   const std::vector<double> &numbers,
                   const std::size_t most_parts)
    {
      std::vector<double> ends = {low};
      for (const double number : numbers)
        if (number > ends.back() && number < high && ends.size() < most_parts)
          ends.push_back(number);
      ends.push_back(high);
      std::vector<double> places = {low, high};
      for (std::size_t k = 1; k < ends.size(); ++k)
        places.push_back(0.5 * (ends[k - 1] + ends[k]));
      return places;
    }


    /** Points at which the values of an expression may differ: along each coordinate that it names,
     * the ends of the box and middles between the numbers of its text. */
    std::vector<Point<3>>
    points_in(const BoundingBox<3> &box, const std::string &text)
    {
      std::vector<double> numbers = numbers_in(text);
      for (std::size_t k = 0, n = numbers.size(); k < n; ++k)
        numbers.push_back(-numbers[k]);
      std::sort(numbers.begin(), numbers.end());
      std::vector<unsigned int> named;
      for (unsigned int i = 0; i < 3; ++i)
        if (std::regex_search(text, std::regex(std::string("\\b") + "xyz"[i] + "\\b")))
          named.push_back(i);

      const auto [low, high]       = box.get_boundary_points();
      const std::size_t most_parts = named.size() < 3 ? 8 : 4;
      std::vector<Point<3>> points = {box.center()};
      for (const unsigned int i : named)
        {
          std::vector<Point<3>> more;
          for (const double place : places_between(low[i], high[i], numbers, most_parts))
            for (Point<3> point : points)
              {
                point[i] = place;
                more.push_back(point);
              }
          points = more;
        }
      return points;
    }
  } // namespace


  SkippedPulses::SkippedPulses(const Parameters &parameters, const BoundingBox<3> &box)
  {
    if (parameters.time.problem == TimeParameters::Problem::stationary)
      return; // only the end of its loads counts
    const auto add_entry = [&](const std::string &entry, const std::string &text) {
      add(text, entry, parameters.origin(entry), box);
    };
    const LoadParameters &loads = parameters.loads;
    add_entry("Loads/Gravity", loads.gravity_expressions());
    add_entry("Loads/Body force", loads.body_force);
    add_entry("Loads/Nodal force", loads.nodal_force);
    add_entry("Loads/Traction", loads.traction);
    add_entry("Loads/Pressure", loads.pressure);
    for (unsigned int m = 0; m < parameters.motions.size(); ++m)
      if (!parameters.motions[m].of.empty())
        add_entry(motion_section(m) + "/Displacement", parameters.motions[m].displacement);
  }


  void
  SkippedPulses::add(const std::string &expressions,
                     const std::string &entry,
                     const std::string &origin,
                     const BoundingBox<3> &box)
  {
    for (const std::string &text : Utilities::split_string_list(expressions, ';'))
      {
        if (text == "free")
          continue;
        Expression value(text, 1, origin);
        if (!value.depends_on_time())
          continue;
        courses.push_back({entry,
                           std::move(value),
                           points_in(box, text),
                           numbers_in(text),
                           std::numeric_limits<double>::max(),
                           std::numeric_limits<double>::lowest()});
      }
  }


  void
  SkippedPulses::begin(const Observation &now, const bool /* resumed */)
  {
    time = now.measurement.time;
  }


  bool
  SkippedPulses::after_step(const Observation &now)
  {
    for (Course &course : courses)
      look(course, time, now.measurement.time);
    time = now.measurement.time;
    return true;
  }


  std::vector<double>
  SkippedPulses::times_between(const double from,
                               const double to,
                               const std::vector<double> &instants)
  {
    constexpr unsigned int n_parts = 32;

    std::vector<double> ends = {from};
    for (const double instant : instants)
      if (instant > from && instant < to)
        ends.push_back(instant);
    ends.push_back(to);

    std::vector<double> times;
    for (unsigned int k = 1; k < n_parts; ++k)
      times.push_back(from + k * (to - from) / n_parts);
    for (std::size_t k = 1; k < ends.size(); ++k)
      {
        times.push_back(0.5 * (ends[k - 1] + ends[k]));
        if (k + 1 < ends.size())
          times.push_back(ends[k]);
      }
    return times;
  }


  void
  SkippedPulses::look(Course &course, const double from, const double to)
  {
    const std::vector<double> times = times_between(from, to, course.instants);
    for (const Point<3> &point : course.points)
      {
        const double first = course.value.value(point, from), last = course.value.value(point, to);
        double low = std::min(first, last), high = std::max(first, last);
        const double low_end = low, high_end = high;
        for (const double instant : times)
          {
            const double value = course.value.value(point, instant);
            if (!std::isfinite(value))
              continue;
            low  = std::min(low, value);
            high = std::max(high, value);
          }
        course.lowest       = std::min(course.lowest, low);
        course.highest      = std::max(course.highest, high);
        const double excess = std::max(low_end - low, high - high_end);
        if (!(excess > course.excess))
          continue;
        course.excess = excess;
        course.from   = from;
        course.to     = to;
      }
  }


  std::vector<std::string>
  SkippedPulses::warnings() const
  {
    std::vector<std::string> list;
    for (const Course &course : courses)
      if (course.excess > 0.25 * (course.highest - course.lowest) &&
          course.excess > 1e-9 * std::max(std::abs(course.highest), std::abs(course.lowest)))
        list.push_back(course.entry + " rises and falls by " + digits(course.excess, 3) +
                       " between the ends of the step from " + digits(course.from, 6) + " to " +
                       digits(course.to, 6) +
                       " s: the method may have stepped over it, and no estimate of the error "
                       "knows of it. Take shorter steps (Time/Step, Time/Longest step).");
    return list;
  }


  std::string
  SkippedPulses::name() const
  {
    return courses.empty() ? "" : "pulses";
  }


  nlohmann::json
  SkippedPulses::save() const
  {
    nlohmann::json all = nlohmann::json::array();
    for (const Course &course : courses)
      all.push_back({course.lowest, course.highest, course.excess, course.from, course.to});
    return all;
  }


  void
  SkippedPulses::load(const nlohmann::json &saved)
  {
    for (std::size_t k = 0; k < courses.size(); ++k)
      {
        const nlohmann::json &values = saved.at(k);
        courses[k].lowest            = values.at(0);
        courses[k].highest           = values.at(1);
        courses[k].excess            = values.at(2);
        courses[k].from              = values.at(3);
        courses[k].to                = values.at(4);
      }
  }
} // namespace Supple
