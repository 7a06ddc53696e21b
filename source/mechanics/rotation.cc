#include <supple/mechanics/rotation.h>

#include <Eigen/Dense>

#include <cmath>

namespace Supple
{
  Matrix3<double>
  nearest_rotation(const Matrix3<double> &F)
  {
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

    Eigen::Matrix3d A  = Eigen::Map<const RowMajor>(F.entries.data());
    const double scale = A.cwiseAbs().maxCoeff();
    if (!A.allFinite() || scale == 0.)
      return Matrix3<double>::identity();
    A /= scale;

    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);

    Eigen::Matrix3d U = svd.matrixU();
    if ((U * svd.matrixV().transpose()).determinant() < 0.)
      U.col(2) *= -1.; // Eigen sorts: the last singular value is the smallest

    Matrix3<double> R;
    Eigen::Map<RowMajor>(R.entries.data()) = U * svd.matrixV().transpose();
    return R;
  }


  void
  repair_rotations(const Matrix3<Pack> &F, Matrix3<Pack> &R)
  {
    const Pack defect = orthogonality_defect(R);
    for (unsigned int lane = 0; lane < n_lanes; ++lane)
      if (!(defect[lane] <= largest_orthogonality_defect))
        {
          Matrix3<double> G;
          for (unsigned int k = 0; k < 9; ++k)
            G.entries[k] = F.entries[k][lane];
          const Matrix3<double> Q = nearest_rotation(G);
          for (unsigned int k = 0; k < 9; ++k)
            R.entries[k][lane] = Q.entries[k];
        }
  }
} // namespace Supple
