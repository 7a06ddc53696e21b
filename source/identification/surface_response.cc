#include <supple/identification/surface_response.h>

#include <supple/base/error.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>
#include <sstream>

namespace Supple
{
  SurfaceResponse::SurfaceResponse(const std::vector<Vertex> &vertices)
    : all(vertices)
  {
  }


  double
  SurfaceResponse::depth(const double position, const double needle_depth) const
  {
    const auto place       = [&](const Vertex &v) { return v.position + needle_depth * v.slide; };
    const double tolerance = 1e-9 * (all.back().position - all.front().position);
    for (std::size_t i = 0; i + 1 < all.size(); ++i)
      {
        const double x0 = place(all[i]), x1 = place(all[i + 1]);
        if (position < x0 - tolerance || position > x1 + tolerance)
          continue;
        const double part = x1 > x0 ? (position - x0) / (x1 - x0) : 0.;
        return needle_depth * ((1. - part) * all[i].depth + part * all[i + 1].depth);
      }
    std::ostringstream text;
    text << "The surface that the needle pushes " << needle_depth << " m deep does not reach "
         << position << " m from the needle any more, or is folded.";
    throw ComputationError(text.str());
  }


  std::vector<double>
  SurfaceComparison::directions() const
  {
    switch (side)
      {
        case Side::left:
          return {-1.};
        case Side::right:
          return {1.};
        default:
          return {-1., 1.};
      }
  }


  std::vector<double>
  SurfaceComparison::deviations(const SurfaceResponse &surface,
                                const MeasuredSet &measured,
                                const double needle_depth) const
  {
    std::vector<double> all;
    for (std::size_t i = 0; i < measured.distances.size(); ++i)
      for (const double direction : directions())
        all.push_back(surface.depth(direction * measured.distances[i], needle_depth) -
                      measured.depths[i]);
    return all;
  }


  double
  SurfaceComparison::first_deviation(const SurfaceResponse &surface,
                                     const MeasuredSet &measured,
                                     const double needle_depth) const
  {
    double sum = 0.;
    for (const double direction : directions())
      sum += surface.depth(direction * measured.distances.front(), needle_depth);
    return sum / directions().size() - measured.depths.front();
  }


  double
  SurfaceComparison::needle_depth(const SurfaceResponse &surface,
                                  const MeasuredSet &measured,
                                  const double start) const
  {
    const auto deviation = [&](const double depth) {
      return first_deviation(surface, measured, depth);
    };
    if (correction == Correction::thesis)
      {
        double depth = start;
        for (unsigned int pass = 0; pass < 2; ++pass)
          depth -= deviation(depth);
        return depth;
      }

    // The surface is nowhere deeper than under the needle, and deeper where the needle is.
    const double lowest = measured.depths.front();
    double highest      = lowest;
    for (unsigned int growths = 0; deviation(highest) < 0.; ++growths)
      {
        if (growths == 40)
          throw ComputationError(measured.places.front() +
                                 ": no depth of the needle brings the surface to this point.");
        highest *= 1.25;
      }
    if (deviation(lowest) >= 0.)
      return lowest;
    boost::uintmax_t n_most = 100;
    const auto bracket      = boost::math::tools::toms748_solve(
      deviation, lowest, highest, boost::math::tools::eps_tolerance<double>(45), n_most);
    return 0.5 * (bracket.first + bracket.second);
  }


  double
  SurfaceComparison::error(const std::vector<double> &deviations) const
  {
    double squares = 0., largest = 0.;
    for (const double e : deviations)
      {
        squares += e * e;
        largest = std::max(largest, std::abs(e));
      }
    switch (norm)
      {
        case Norm::thesis:
          return std::sqrt(squares) / deviations.size();
        case Norm::rms:
          return std::sqrt(squares / deviations.size());
        default:
          return largest;
      }
  }
} // namespace Supple
