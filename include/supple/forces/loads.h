#ifndef supple_loads_h
#define supple_loads_h

#include <supple/base/expression.h>
#include <supple/forces/load_parameters.h>
#include <supple/input/parameter_file.h>
#include <supple/mechanics/body.h>

namespace Supple
{
  /** What pushes the body: gravity, body force, nodal forces, traction, and pressure that may
   * follow the surface. */
  class Loads
  {
  public:
    /** @throws InputError; @p scene knows where the entries were set */
    Loads(const Body &body, const LoadParameters &parameters, const ParameterFile &scene);

    /**
     * The load vector [N]; held entries are not set to zero. Valid until the next call.
     * @param time         [s]
     * @param displacement of the surface that pressure follows [m]
     */
    const Vector &
    force(double time, const Vector &displacement) const;

    /** The part of force() that is no gravity, and does work which potential() does not count. */
    const Vector &
    applied_force(double time, const Vector &displacement) const;

    /** Whether there is anything but gravity. */
    bool
    any_applied() const
    {
      return applied;
    }

    /** Whether the force depends on the displacement. */
    bool
    follow() const
    {
      return pressure_follows && !pressure.is_zero();
    }

    /** Potential energy of gravity [J], zero at rest position. */
    double
    potential(const Vector &displacement) const;

  private:
    using Faces = std::vector<std::array<unsigned int, 3>>;

    /** What integrals over a face need, for nodes at these places. */
    struct FaceIntegrals
    {
      dealii::Tensor<1, 3> normal; ///< outward, as long as the face is large
      std::array<std::array<double, 3>, 3>
        products; ///< integrals of products of two shape functions, over the length of the normal
    };

    FaceIntegrals
    integrals(const std::array<dealii::Point<3>, 3> &x) const;

    void
    add_body_force(double time, Vector &force) const;

    void
    add_nodal_force(double time, Vector &force) const;

    void
    add_traction(double time, Vector &force) const;

    void
    add_pressure(double time, const Vector &displacement, Vector &force) const;

    /** Values of an expression at all local nodes, node by node. */
    std::vector<double>
    nodal_values(const Expression &expression, double time) const;

    const Body &body;
    const Expression body_force, nodal_force, traction, pressure;
    const bool pressure_follows;
    bool applied; ///< anything but gravity
    bool time_dependent;
    Vector gravity;
    std::vector<unsigned int> forced_nodes; ///< owned
    Faces traction_faces, pressure_faces;

    // Dead loads are kept from call to call.
    mutable Vector dead, live, total;
    mutable bool evaluated = false;
    mutable double evaluation_time;
  };
} // namespace Supple

#endif
