#ifndef supple_surface_response_h
#define supple_surface_response_h

#include <supple/identification/measurements.h>

#include <vector>

namespace Supple
{
  /**
   * The surface of a linearly elastic body under a needle. Displacements are proportional to the
   * depth of the needle, so that one solution tells the surface at every depth.
   */
  class SurfaceResponse
  {
  public:
    /** A vertex of the surface. */
    struct Vertex
    {
      double position; ///< at rest, from the needle [m]
      double slide;    ///< along the surface, per depth of the needle
      double depth;    ///< per depth of the needle
    };

    /** @param vertices at least two, in ascending order of their position */
    explicit SurfaceResponse(const std::vector<Vertex> &vertices);

    /**
     * How deep the deformed surface lies at a place [m], linear between its vertices.
     * @throws ComputationError if it does not reach so far
     */
    double
    depth(double position, double needle_depth) const;

  private:
    std::vector<Vertex> all;
  };


  /** How a computed surface is compared with a measured one. */
  struct SurfaceComparison
  {
    /** Of the needle, whose depth was not measured. */
    enum class Correction
    {
      thesis,   ///< two passes of: depth -= deviation at the first point
      converged ///< until the surface goes through the first point
    };

    enum class Norm
    {
      thesis, ///< sqrt(sum e^2) / n
      rms,    ///< sqrt(sum e^2 / n)
      largest ///< max |e|
    };

    enum class Side
    {
      left,
      right,
      both
    };

    Correction correction = Correction::converged;
    Norm norm             = Norm::rms;
    Side side             = Side::both;

    /** Computed minus measured depths [m]: for each point one, or two, left and right. */
    std::vector<double>
    deviations(const SurfaceResponse &surface,
               const MeasuredSet &measured,
               double needle_depth) const;

    /**
     * The depth of the needle [m]; with both sides, the mean of these goes through the first point.
     * @param start where the thesis's passes begin [m]
     * @throws ComputationError if no depth does
     */
    double
    needle_depth(const SurfaceResponse &surface, const MeasuredSet &measured, double start) const;

    /** [m] */
    double
    error(const std::vector<double> &deviations) const;

    /** -1, 1 or both: where distances are put on the line of the surface. */
    std::vector<double>
    directions() const;

  private:
    double
    first_deviation(const SurfaceResponse &surface,
                    const MeasuredSet &measured,
                    double needle_depth) const;
  };
} // namespace Supple

#endif
