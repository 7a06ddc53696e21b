#ifndef supple_pulls_h
#define supple_pulls_h

#include <supple/forces/force.h>
#include <supple/forces/load_parameters.h>
#include <supple/input/parameter_file.h>

namespace Supple
{
  /**
   * Springs between nodes and hands, f = k (p(t) + o - X - u) with a stiffness k [N/m], the place p
   * of the hand and an offset o of the node from it [m]. They are symmetric and definite parts of
   * the operator, so that implicit methods bear any stiffness, and what they do is work.
   */
  class Pulls : public Force
  {
  public:
    /** Null if there are none. */
    static std::unique_ptr<Force>
    make(const Body &body, const LoadParameters &parameters, const ParameterFile &scene);

    Pulls(const Body &body, const std::vector<Pull> &pulls);

    std::string
    name() const override
    {
      return "pulls";
    }

    EnergyAccount
    account() const override
    {
      return EnergyAccount::work;
    }

    bool
    is_load() const override
    {
      return true;
    }

    bool
    is_linear() const override
    {
      return true;
    }

    bool
    has_tangent() const override
    {
      return true;
    }

    void
    add_force(const Configuration &configuration, double time, double *f) const override;

    /** k (p + o - X) */
    void
    add_constant_part(double time, double part, double *f) const override;

    /** k/2 |p + o - X - u|^2 */
    double
    energy(const Configuration &configuration, double time) const override;

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
    /** On a node that this process owns. */
    struct Spring
    {
      unsigned int node;
      double stiffness;            ///< [N/m]
      dealii::Tensor<1, 3> offset; ///< from the hand, less the place at rest [m]
      SharedHandPath path;
    };

    /** By how much a spring is longer than nothing, from the node to the hand [m]. */
    static dealii::Tensor<1, 3>
    length(const Spring &spring, const Vector &displacement, double time);

    std::vector<Spring> springs;
  };
} // namespace Supple

#endif
