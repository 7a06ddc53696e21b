#ifndef supple_dead_loads_h
#define supple_dead_loads_h

#include <supple/base/expression.h>
#include <supple/forces/face_integrals.h>
#include <supple/forces/load.h>
#include <supple/forces/load_parameters.h>
#include <supple/input/parameter_file.h>

namespace Supple
{
  /** Forces given at the body at rest: body force [N/m^3], forces on single vertices [N] and
   * traction [Pa], f(X, t). */
  class DeadLoads : public Load
  {
  public:
    /** Null if there are none. @throws InputError */
    static std::unique_ptr<Force>
    make(const Body &body, const LoadParameters &parameters, const ParameterFile &scene);

    /** @throws InputError for loads that act nowhere, or are not finite */
    DeadLoads(const Body &body, const LoadParameters &parameters, const ParameterFile &scene);

    std::string
    name() const override
    {
      return "dead loads";
    }

  private:
    const Vector &
    force_at(const Configuration &configuration, double time) const override;

    void
    add_body_force(double time, Vector &to) const;

    void
    add_nodal_force(double time, Vector &to) const;

    void
    add_traction(double time, Vector &to) const;

    /** The nodes of a face: places [m] and tractions [Pa]. */
    template <unsigned int n>
    struct TractionFace
    {
      std::array<dealii::Point<3>, n> x;
      std::array<dealii::Tensor<1, 3>, n> values;
    };

    template <unsigned int n>
    TractionFace<n>
    traction_on(const std::array<unsigned int, n> &nodes, double time) const;

    const Body &body;
    const Expression body_force, nodal_force, traction;
    const bool time_dependent;
    std::vector<unsigned int> forced_nodes; ///< owned
    FaceList<3> traction_faces;
    FaceList<6> quadratic_traction_faces; ///< of quadratic cells, in place of those
    mutable Vector force;
    mutable double force_time = 0.; ///< of the force that is kept
  };
} // namespace Supple

#endif
