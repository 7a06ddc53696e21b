#include <supple/study/study_record.h>

#include <supple/input/entries.h>
#include <supple/observe/measurement.h>

#include <algorithm>

namespace Supple
{
  namespace
  {
    bool
    ends_with(const std::string &text, const std::string &end)
    {
      return text.size() >= end.size() &&
             text.compare(text.size() - end.size(), end.size(), end) == 0;
    }
  } // namespace


  std::string
  rate_column(const std::string &name)
  {
    for (const char direction : {'x', 'y', 'z'})
      if (ends_with(name, std::string(".u") + direction))
        return name.substr(0, name.size() - 2) + "v" + direction;
    return "";
  }


  std::set<std::string>
  StudyRecord::column_names(const Parameters &parameters)
  {
    const auto names = Measurement::column_names(parameters.has_contact());
    std::set<std::string> all(names.begin(), names.end());
    const ProbeParameters &probes = parameters.probes;
    for (const auto &[entry, list] : {std::make_pair("Probes/Points", probes.points),
                                      std::make_pair("Probes/Boundaries", probes.boundaries),
                                      std::make_pair("Probes/Regions", probes.regions)})
      for (const auto &[name, text] : named_list(list, parameters.origin(entry)))
        for (const char quantity : {'u', 'v', 'f'})
          for (const char direction : {'x', 'y', 'z'})
            all.insert(name + "." + quantity + direction);
    return all;
  }


  bool
  StudyRecord::has(const double time) const
  {
    const std::vector<double> &times = column("time");
    return times.size() > 1 && time >= times.front() && time <= times.back() * (1. + 1e-12);
  }


  double
  StudyRecord::value(const std::string &name, const double time) const
  {
    const std::vector<double> &times = column("time"), &values = column(name);
    const auto after       = std::upper_bound(times.begin(), times.end(), time);
    const std::size_t next = std::clamp<std::size_t>(after - times.begin(), 1, times.size() - 1);
    const std::size_t last = next - 1;
    const double length    = times[next] - times[last];
    const double s         = std::clamp((time - times[last]) / length, 0., 1.);

    const auto rates = columns.find(rate_column(name));
    if (rates == columns.end())
      return (1. - s) * values[last] + s * values[next];
    const double r = 1. - s;
    return r * r * ((1. + 2. * s) * values[last] + s * length * rates->second[last]) +
           s * s * ((1. + 2. * r) * values[next] - r * length * rates->second[next]);
  }
} // namespace Supple
