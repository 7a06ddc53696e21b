#ifndef supple_pressure_h
#define supple_pressure_h

#include <supple/base/expression.h>
#include <supple/forces/face_integrals.h>
#include <supple/forces/load.h>
#include <supple/forces/load_parameters.h>
#include <supple/input/parameter_file.h>

namespace Supple
{
  /**
   * Pressure p(X, t) [Pa] on boundaries: -p n dA, with the pressure interpolated on each face, and
   * the face where the displacement takes it or, if it does not follow, as it is at rest. Its
   * derivative by the displacement is no part of the operator.
   */
  class Pressure : public Load
  {
  public:
    /** Null without pressure. @throws InputError */
    static std::unique_ptr<Force>
    make(const Body &body, const LoadParameters &parameters, const ParameterFile &scene);

    /** @throws InputError for a pressure that acts nowhere, or is not finite */
    Pressure(const Body &body, const LoadParameters &parameters, const ParameterFile &scene);

    std::string
    name() const override
    {
      return "pressure";
    }

    bool
    is_linear() const override
    {
      return !follows;
    }

    bool
    has_energy() const override
    {
      return !follows;
    }

  private:
    const Vector &
    force_at(const Configuration &configuration, double time) const override;

    void
    set_force(const Vector &surface_displacement, double time) const;

    const Body &body;
    const Expression pressure;
    const bool follows;
    const Faces faces;
    mutable Vector force;
    mutable double force_time = 0.; ///< of the force that is kept
  };
} // namespace Supple

#endif
