#include <supple/run/time_dependence.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <functional>
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


    /** Times that an expression with these numbers may compare with t: t > 0.1, 10*t > 1, t - 0.1 >
     * 0.2. */
    std::vector<double>
    candidates(const std::vector<double> &numbers, const double end)
    {
      constexpr std::size_t most_numbers = 12;

      std::vector<double> found;
      const std::size_t n = std::min(numbers.size(), most_numbers);
      for (std::size_t i = 0; i < n; ++i)
        {
          found.push_back(numbers[i]);
          for (std::size_t j = 0; j < n; ++j)
            {
              found.push_back(numbers[i] / numbers[j]);
              found.push_back(numbers[i] + numbers[j]);
            }
          found.push_back(1. / numbers[i]);
        }
      found.erase(std::remove_if(found.begin(),
                                 found.end(),
                                 [end](const double time) {
                                   return !(time > 1e-9 * end && time < end * (1. - 1e-9));
                                 }),
                  found.end());
      std::sort(found.begin(), found.end());
      return found;
    }


    using Course = std::function<double(double)>;

    /** How far apart values or slopes on both sides are beside what they are. */
    constexpr double clear = 1e-3;

    /** Whether a course of values up to @p size jumps or bends at a time. */
    bool
    breaks(const Course &value, const double at, const double end, const double size)
    {
      const double delta  = 1e-7 * end;
      const double before = value(at - delta), after = value(at + delta);
      const double slope_before = (before - value(at - 2. * delta)) / delta;
      const double slope_after  = (value(at + 2. * delta) - after) / delta;
      const double jump         = after - before - (slope_before + slope_after) * delta;
      const double bend         = slope_after - slope_before;
      return std::abs(jump) > clear * size ||
             (std::abs(bend) > clear * std::max(std::abs(slope_before), std::abs(slope_after)) &&
              std::abs(bend) * end > clear * size);
    }


    /** Where a course jumps between two times, by bisection; the middle at last. */
    double
    jump_between(const Course &value, double from, double to)
    {
      const double accuracy = 1e-13 * to;
      double low = value(from), high = value(to);
      while (to - from > accuracy)
        {
          const double middle = 0.5 * (from + to), between = value(middle);
          if (std::abs(between - low) > std::abs(high - between))
            {
              to   = middle;
              high = between;
            }
          else
            {
              from = middle;
              low  = between;
            }
        }
      return 0.5 * (from + to);
    }


    void
    add_instants(std::vector<double> &instants,
                 const Course &value,
                 const std::vector<double> &numbers,
                 const double end)
    {
      constexpr unsigned int n_samples = 2000;
      constexpr double large           = 0.02;

      std::vector<double> samples;
      for (unsigned int k = 0; k <= n_samples; ++k)
        samples.push_back(value(k * end / n_samples));
      const std::vector<double> named = candidates(numbers, end);
      double size                     = 0.;
      for (const double sample : samples)
        if (std::isfinite(sample))
          size = std::max(size, std::abs(sample));
      for (const double time : named)
        for (const double beside : {time - 1e-6 * end, time + 1e-6 * end})
          if (const double sample = value(beside); std::isfinite(sample))
            size = std::max(size, std::abs(sample));
      if (size == 0.)
        return;
      for (const double time : named)
        if (breaks(value, time, end, size))
          instants.push_back(time);
      for (unsigned int k = 1; k <= n_samples; ++k)
        if (std::abs(samples[k] - samples[k - 1]) > large * size)
          {
            const double time = jump_between(value, (k - 1) * end / n_samples, k * end / n_samples);
            if (time > 1e-9 * end && time < end * (1. - 1e-9) && breaks(value, time, end, size))
              instants.push_back(time);
          }
    }
  } // namespace


  std::vector<TimeDependence>
  time_dependences(const Parameters &parameters, const BoundingBox<3> &box)
  {
    std::vector<TimeDependence> list;
    if (parameters.time.problem == TimeParameters::Problem::stationary)
      return list; // only the end of its loads counts
    const auto add = [&](const std::string &entry, const std::string &expressions) {
      for (const std::string &text : Utilities::split_string_list(expressions, ';'))
        {
          if (text == "free")
            continue;
          Expression value(text, 1, parameters.origin(entry));
          if (value.depends_on_time())
            list.push_back({entry, text, std::move(value), points_in(box, text), numbers_in(text)});
        }
    };
    const LoadParameters &loads = parameters.loads;
    add("Loads/Gravity", loads.gravity_expressions());
    add("Loads/Body force", loads.body_force);
    add("Loads/Nodal force", loads.nodal_force);
    add("Loads/Traction", loads.traction);
    add("Loads/Pressure", loads.pressure);
    for (unsigned int m = 0; m < parameters.motions.size(); ++m)
      if (!parameters.motions[m].of.empty())
        add(motion_section(m) + "/Displacement", parameters.motions[m].displacement);
    for (const ToolParameters &tool : parameters.tools)
      {
        add(tool.section() + "/Position", tool.position);
        add(tool.section() + "/Rotation", tool.rotation);
      }
    return list;
  }


  std::vector<double>
  instants_of(const std::vector<TimeDependence> &dependences, const double end)
  {
    constexpr std::size_t most_points = 64;

    std::vector<double> instants;
    for (const TimeDependence &dependence : dependences)
      for (std::size_t p = 0; p < std::min(dependence.points.size(), most_points); ++p)
        add_instants(
          instants,
          [&](const double time) { return dependence.value.value(dependence.points[p], time); },
          dependence.numbers,
          end);
    std::sort(instants.begin(), instants.end());
    // what was found twice differs by round-off
    instants.erase(std::unique(instants.begin(),
                               instants.end(),
                               [end](const double one, const double other) {
                                 return other - one < 1e-9 * end;
                               }),
                   instants.end());
    return instants;
  }


  TimeParameters
  time_with_instants(const Parameters &parameters, const BoundingBox<3> &box)
  {
    TimeParameters time = parameters.time;
    if (!time.has_variable_steps() || time.problem == TimeParameters::Problem::stationary)
      return time;
    time.instants = instants_of(time_dependences(parameters, box), time.end());
    if (parameters.output.frames == OutputParameters::Frames::interval)
      time.stop_interval = parameters.output.interval;
    return time;
  }
} // namespace Supple
