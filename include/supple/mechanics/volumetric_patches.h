#ifndef supple_volumetric_patches_h
#define supple_volumetric_patches_h

#include <supple/linear_algebra/vector.h>
#include <supple/mechanics/volume_change.h>

#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace Supple
{
  /** What patches know of a cell. */
  struct PatchCell
  {
    std::vector<unsigned int> nodes; ///< local numbers, three or four; none of a quadratic cell
    unsigned int patch;              ///< number on all processes
    double bulk;                     ///< kappa of the patch [Pa], the same in all of it
  };


  /**
   * The resistance of an almost incompressible body to a change of its volume, by patches of cells
   * instead of single cells, which would lock (de Souza Neto, Pires & Owen 2005: F-bar patches):
   *
   *   W_P = sum V_e,   Theta_P = sum V_e theta_e / W_P,   s_P = kappa Theta_P,
   *   energy   sum_P W_P kappa/2 Theta_P^2,
   *   force    sum_P s_P c_P,   c_P = sum_e V_e H_e g_a at each node of the patch,
   *   tangent  sum_P (kappa / W_P) c_P c_P^T,
   *
   * with the sums over the cells e of a patch P and the volume change theta_e of VolumeMeasure,
   * which is linear in the displacement as long as H is kept: rotations, or cofactors, of the last
   * update(). s_P is the mean stress, positive in tension. The second derivative of theta_e is not
   * here but with the rotations, in Law. The tangent may lag: it has the c_P of the last keep(), if
   * there was one.
   *
   * In quadratic cells the mean stress of a patch is linear, s = sum_k s_Pk psi_k, and the sums are
   * those over the points of its cells, each with psi_k there: 1 and three linear functions that
   * are orthogonal, sum V psi_k psi_l = W_P delta_kl. So each function has a Theta_Pk of its own
   * and adds to energy, force and tangent as a patch does; the members below count functions. The
   * cells keep a bulk modulus of 2/3 mu, for inside a patch there are volumes that no psi_k sees,
   * and kappa is that of the material less this one.
   *
   * Each process computes Theta of its own patches, all cells of which it has, and learns that of
   * the patches next to them; the forces of these on its own nodes it knows by itself.
   */
  class VolumetricPatches
  {
  public:
    /** What quadratic cells keep of their resistance to a change of volume, over mu. */
    static constexpr double bulk_of_quadratic_cells = 2. / 3.;

    /**
     * @param cells       in the same order and with the same nodes as @p list
     * @param n_owned     own nodes: forces of others mean nothing
     * @param partitioner of the functions of the patches, one or four of each in a row
     */
    VolumetricPatches(const Cells &cells,
                      const std::vector<PatchCell> &list,
                      unsigned int n_owned,
                      VolumeMeasure measure,
                      std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner);

    /** H of every cell, from the displacement and its rotations. */
    void
    update(const CellRotations::List &rotations, const double *displacement);

    /** The tangent has the c_P of now, until called again. */
    void
    keep();

    /** f -= sum s_P c_P */
    void
    subtract_force(const double *displacement, double *force) const;

    /** y += factor sum (kappa / W_P) c_P c_P^T w */
    void
    add_product(double factor, const double *w, double *y) const;

    /** Of this process's patches [J]. */
    double
    energy(const double *displacement) const;

    /** s_P at each point of each cell [Pa], owned or not. */
    std::vector<double>
    mean_stress(const double *displacement) const;

    /** The same, mean over each cell [Pa]. */
    std::vector<double>
    mean_stress_of_cells(const double *displacement) const;

    /** How much a point of a cell and its patch there have grown. */
    struct Growth
    {
      double cell;  ///< theta_e
      double patch; ///< Theta_P, or sum_k Theta_Pk psi_k
    };

    /** At each point of each cell, owned or not, by a displacement. */
    std::vector<Growth>
    growth(const double *displacement) const;

    /** What a small change of the displacement adds to it, to first order. */
    std::vector<Growth>
    growth_by_change(const double *change) const;

    /** Sum over own patches of (round-off in the forces)^2 [N^2], at strains of order one. */
    double
    round_off_square() const;

    const VolumeMeasure measure;

    /** One number for each function: those of this process's own patches, then those of the patches
     * next to them. */
    const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;

    /** kappa / W_P [Pa/m^3] */
    double
    stiffness(const unsigned int patch) const
    {
      return bulk[patch] / volume[patch];
    }

    /** c_P.w of own patches, with the c_P of the tangent; @p w must have valid ghost values. */
    void
    reduce(Vector &of_patches, const double *w) const
    {
      reduce(of_patches, w, of_tangent());
    }

    /** y += sum c_P times a number of each patch, whose ghost values must be valid, with the c_P of
     * the tangent. */
    void
    expand(double *y, const double *of_patches) const
    {
      expand(y, of_patches, of_tangent());
    }

    /** Calls @p visit(node, c) for each node of a patch, with the c_P of the tangent. */
    template <class Visit>
    void
    for_each_node(const unsigned int patch, const Visit &visit) const
    {
      for (std::size_t k = start[patch]; k < start[patch + 1]; ++k)
        visit(node[k], of_tangent()[k]);
    }

  private:
    /** c_P at the nodes of all patches, one patch after the other. */
    using Gradients = std::vector<std::array<double, 3>>;

    const Gradients &
    of_tangent() const
    {
      return kept_gradient.empty() ? gradient : kept_gradient;
    }

    void
    reduce(Vector &of_patches, const double *w, const Gradients &gradients) const;

    void
    expand(double *y, const double *of_patches, const Gradients &gradients) const;

    void
    find_nodes(const std::vector<PatchCell> &list);

    /** Nodes of a cell in the order of VolumeChanges. */
    std::vector<unsigned int>
    nodes_of(const PatchCell &cell, std::size_t number) const;

    /** psi_k at the points of quadratic cells. */
    void
    find_functions();

    /** psi_k at a point, of whatever cell. */
    double
    function(const std::size_t point, const unsigned int k) const
    {
      return functions.empty() ? 1. : functions[n_functions * point + k];
    }

    /** sum_k psi_k at a point times a number of each function. */
    double
    value_at(std::size_t point, const double *of_functions) const;

    /** @param constant_part 1 for a displacement, 0 for a change of it */
    std::vector<Growth>
    growth(const double *w, double constant_part) const;

    unsigned int
    n_own() const
    {
      return partitioner->locally_owned_size();
    }

    const Cells &cells;
    const unsigned int n_owned; ///< nodes
    const unsigned int n_points, n_functions;
    VolumeChanges changes;
    std::vector<unsigned int> patch_of; ///< of each cell, local number of its first function
    std::vector<std::size_t> places;    ///< of each cell's nodes in gradient, for that function
    std::vector<std::size_t> start;     ///< of each function in node and gradient
    std::vector<unsigned int> node;
    std::vector<double> functions;              ///< psi_k of each point; none: 1
    Gradients gradient;                         ///< c_P of the last update()
    Gradients kept_gradient;                    ///< c_P of the last keep(); none: those above
    std::vector<double> bulk, volume, constant; ///< kappa, W_P and W_P Theta_P without c_P.u
    mutable Vector change;                      ///< of functions, at hand
  };
} // namespace Supple

#endif
