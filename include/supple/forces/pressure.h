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
   * the face where the displacement takes it or, if it does not follow, as it is at rest.
   *
   * Its derivative by the displacement is part of the consistent operator, symmetric face by face.
   * What that takes away of the whole lies on the edge of the loaded boundaries and where the
   * pressure varies. It may be indefinite: frozen and definite operators go without it.
   *
   * @p n_nodes of a face: 3 or, of quadratic cells, 6.
   */
  template <unsigned int n_nodes>
  class Pressure : public Load
  {
  public:
    /** @throws InputError for a pressure that acts nowhere, or is not finite */
    Pressure(const Body &body, const LoadParameters &parameters, const ParameterFile &scene);

    bool
    is_zero() const
    {
      return pressure.is_zero();
    }

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

    /** Of pressure that follows zero. */
    double
    energy(const Configuration &configuration, const double time) const override
    {
      return follows ? 0. : Load::energy(configuration, time);
    }

    double
    work_along(const Configuration &configuration, double time, const Vector &from) const override;

    void
    connect(const SymmetricPattern &pattern) override;

    void
    update_tangent(Tangent tangent,
                   const Configuration &configuration,
                   double time,
                   double part) override;

    void
    add_product(const Configuration &configuration,
                const TangentFactors &factors,
                const double *w,
                double *y) const override;

    void
    add_tangent(const Configuration &configuration,
                const TangentFactors &factors,
                SymmetricBlockMatrix &A) const override;

  private:
    /** The nodes of a face, where it is loaded. */
    struct LoadedFace
    {
      std::array<dealii::Point<3>, n_nodes> x; ///< places [m]
      std::array<double, n_nodes> p;           ///< [Pa]
    };

    /** @param u displacement of all local nodes */
    LoadedFace
    loaded_face(const std::array<unsigned int, n_nodes> &nodes, const double *u, double time) const;

    /** f -= what the pressure does to the nodes of a face. */
    void
    subtract_force(const std::array<unsigned int, n_nodes> &nodes, const LoadedFace &face) const;

    const Vector &
    force_at(const Configuration &configuration, double time) const override;

    void
    set_force(const Vector &surface_displacement, double time) const;

    const Body &body;
    const Expression pressure;
    const bool follows;
    const FaceList<n_nodes> faces;

    /** Of nodes v, w of a face in matrices, v < w, pair by pair. */
    std::vector<std::array<std::size_t, n_nodes *(n_nodes - 1) / 2>> places;
    std::vector<FaceMatrices<n_nodes>> stiffness; ///< of each face, symmetric; none: zero
    mutable Vector force;
    mutable double force_time = 0.; ///< of the force that is kept
  };


  /** Null without pressure. @throws InputError */
  std::unique_ptr<Force>
  make_pressure(const Body &body, const LoadParameters &parameters, const ParameterFile &scene);
} // namespace Supple

#endif
