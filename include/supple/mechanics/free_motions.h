#ifndef supple_free_motions_h
#define supple_free_motions_h

#include <supple/mesh/mesh.h>

#include <Eigen/Dense>

#include <string>
#include <vector>

namespace Supple
{
  /** Small rigid motions u(x) = a + w cross (x - c) / d with the center c and the diameter d of a
   * box: three numbers a and three w. */
  class RigidMotions
  {
  public:
    explicit RigidMotions(const dealii::BoundingBox<3> &box);

    /** What they do to a point: the displacement is this times (a, w). */
    Eigen::Matrix<double, 3, 6>
    at(const dealii::Point<3> &x) const;

  private:
    const dealii::Point<3> center;
    const double diameter;
  };


  /**
   * Which rigid motions of the first piece that has any nothing prevents: for one that is held, its
   * stiffness is singular by them. The parts of a piece move against each other, but for the places
   * of their joints; where there are more than a hundred of them, they count as one.
   * @param products 6x6 matrix of each part, the sum of b b^T over its held degrees of freedom,
   * where b (a, w) is the displacement of one by RigidMotions of the part's box
   * @return "3 of its 6 rigid motions are free (it can slide along x and y and turn about z)";
   * empty if there are none
   */
  std::string
  free_motions_in_words(const Mesh &mesh, const std::vector<double> &products);
} // namespace Supple

#endif
