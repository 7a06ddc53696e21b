#include <supple/observe/measurement.h>

#include <algorithm>
#include <cmath>

namespace Supple
{
  std::vector<std::string>
  Measurement::column_names(const bool with_contact)
  {
    std::vector<std::string> names = {"step",
                                      "time",
                                      "dt",
                                      "kinetic",
                                      "elastic",
                                      "potential",
                                      "dissipated",
                                      "total",
                                      "work",
                                      "px",
                                      "py",
                                      "pz",
                                      "lx",
                                      "ly",
                                      "lz",
                                      "min_volume_ratio",
                                      "max_volume_ratio",
                                      "inverted",
                                      "newton_iterations",
                                      "linear_iterations",
                                      "seconds"};
    if (with_contact)
      names.insert(names.end(), {"contact", "rubbed", "min_gap"});
    return names;
  }


  std::vector<double>
  Measurement::row() const
  {
    const auto &p = linear_momentum, &l = angular_momentum;
    std::vector<double> values = {double(step),
                                  time,
                                  dt,
                                  kinetic,
                                  elastic,
                                  potential,
                                  dissipated,
                                  total,
                                  work,
                                  p[0],
                                  p[1],
                                  p[2],
                                  l[0],
                                  l[1],
                                  l[2],
                                  min_volume_ratio,
                                  max_volume_ratio,
                                  double(inverted),
                                  double(newton_iterations),
                                  double(linear_iterations),
                                  seconds};
    if (contact)
      values.insert(values.end(), {contact->energy, contact->rubbed, contact->min_gap});
    return values;
  }


  std::string
  Measurement::not_finite() const
  {
    const std::vector<double> values = row();
    if (std::all_of(values.begin(), values.end(), [](const double x) { return std::isfinite(x); }))
      return ""; // as in nearly all steps
    const std::vector<std::string> names = column_names(contact.has_value());
    std::string list;
    for (unsigned int i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i]))
        list += (list.empty() ? "" : ", ") + names[i];
    return list;
  }
} // namespace Supple
