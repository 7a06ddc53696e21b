#ifndef supple_probe_errors_h
#define supple_probe_errors_h

#include <supple/observe/point_forces.h>
#include <supple/observe/probes.h>
#include <supple/observe/space_error.h>
#include <supple/solvers/implicit_operator.h>
#include <supple/solvers/linear_solver.h>

#include <string>
#include <vector>

namespace Supple
{
  /** The error in space of a component of a probe's displacement. */
  struct ProbeError
  {
    std::string name; ///< "tip.uz"
    double value;     ///< as computed [m]
    double error;     ///< what it lacks of the right one [m]

    /** What it lacks over the right one. */
    double
    relative() const
    {
      return error / (value + error);
    }
  };


  /**
   * The errors of probes in equilibrium, by dual solutions (Becker and Rannacher 2001): for each
   * component, the body's answer z to a unit force there, K'(u) z = e with the derivative K' of all
   * forces, has the gradient G; with what is recovered of G and of the stress P,
   *
   *   error = sum over the cells of the integral of (P* - P) : (G* - G).
   *
   * Where patches resist to a change of volume, G has the change of volume of the patch, and
   * - sum V ((p* - s)(theta_z - Theta_z) + (p_z* - s_z)(theta - Theta)) comes to it, with the mean
   * stress s, p* recovered, and the changes theta of the volumes of cells and Theta of patches.
   */
  class ProbeErrors
  {
  public:
    /**
     * Collective.
     * @param space_error     of the configuration, estimated
     * @param configuration   in equilibrium
     * @param implicit_operator with its solver: the stiffness of the last load step if forces are
     *                        linear, otherwise taken anew
     * @throws ComputationError if the stiffness has no solution
     */
    ProbeErrors(const SpaceError &space_error,
                const Configuration &configuration,
                Forces &forces,
                ImplicitOperator &implicit_operator,
                LinearSolver &solver,
                Effort &effort);

    /**
     * Those of components that move, are not held and carry no nodal force of their own, of probes
     * whose largest one is not held either; the one that moves most comes first. Collective.
     * @throws ComputationError
     * @param only the name of one of them, or empty: all
     */
    std::vector<ProbeError>
    find(const Probes &probes, const PointForces &points, const std::string &only = "");

    /**
     * Of the work of the loads, f . u, whose dual is the body's answer to the loads themselves: of
     * nonlinear bodies this is what the energy alone does not tell, as near to buckling.
     * Collective.
     * @param loads f [N]
     * @throws ComputationError
     */
    ProbeError
    find_of_work(const Vector &loads);

    /** What each cell of the body can add to the last error that was found: the root of the
     * integral of (P* - P)^2 times that of (G* - G)^2 [J/N]; zero of cells of other processes. */
    const std::vector<double> &
    of_body_cells() const
    {
      return weights;
    }

  private:
    /** Nine entries of a matrix of each point, with one more number, in two fields. */
    using MatrixField = std::array<Recovery::Field, 2>;

    /** @param more the number beside the matrix; empty if there is none */
    MatrixField
    recover(const std::vector<Matrix3<Pack>> &of_points, const std::vector<double> &more) const;

    void
    prepare(Forces &forces);

    /** The components that an error is asked for, with their values. */
    std::vector<std::pair<Probes::Component, double>>
    chosen(const Probes &probes, const PointForces &points) const;

    /** z */
    void
    solve(const Probes::Component &component);

    /** G of each point of each batch, with the change of volume of the patch. */
    std::vector<Matrix3<Pack>>
    dual_gradient(const double *z, const std::vector<VolumetricPatches::Growth> &growth) const;

    /** Sets the weights too. */
    double
    error_by_dual();

    /** The weight of a cell. */
    double
    weight(const MatrixField &gradient, std::size_t cell) const;

    const SpaceError &space_error;
    const Configuration &configuration;
    ImplicitOperator &implicit_operator;
    LinearSolver &solver;
    Effort &effort;
    const MatrixField stress;                      ///< P
    std::vector<VolumetricPatches::Growth> growth; ///< theta, Theta; empty without patches
    Vector load, dual;                             ///< e, z
    std::vector<double> weights;                   ///< of the cells of the body
  };
} // namespace Supple

#endif
