#include <supple/mechanics/free_motions.h>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace Supple
{
  using dealii::BoundingBox;
  using dealii::Point;

  namespace
  {
    using Matrix6 = Eigen::Matrix<double, 6, 6>;

    constexpr double round_off = 1e-12; // of squares

    double
    diameter_of(const BoundingBox<3> &box)
    {
      const auto &corners = box.get_boundary_points();
      return corners.first.distance(corners.second);
    }


    /** What is held of a part, from 0 to about 1, with what the plane or the axis takes away. */
    Matrix6
    scaled_products(const std::vector<double> &products,
                    const unsigned int part,
                    const Section &section)
    {
      const Eigen::Map<const Matrix6> held(&products[36 * static_cast<std::size_t>(part)]);
      Matrix6 matrix = held / std::max(held.trace(), 1.);
      if (section.plane()) // along z and out of the plane
        for (const unsigned int motion : {2, 3, 4})
          matrix(motion, motion) += 1.;
      if (section.axisymmetric()) // away from the axis to one side
        for (const unsigned int motion : {0, 5})
          matrix(motion, motion) += 1.;
      return matrix;
    }


    /** The parts of a piece, as bodies that are joined at vertices. */
    struct Linkage
    {
      std::vector<unsigned int> parts;               ///< their numbers in the mesh
      std::vector<const MeshReport::Joint *> joints; ///< between them

      std::size_t
      place_of(const unsigned int part) const
      {
        return std::lower_bound(parts.begin(), parts.end(), part) - parts.begin();
      }
    };


    /** Of each piece. */
    std::vector<Linkage>
    linkages(const MeshReport &report)
    {
      std::vector<Linkage> result(report.pieces.size());
      for (unsigned int part = 0; part < report.parts.size(); ++part)
        result[report.parts[part].piece].parts.push_back(part);
      for (const MeshReport::Joint &joint : report.joints)
        result[report.parts[joint.parts[0]].piece].joints.push_back(&joint);
      return result;
    }


    /** The columns that a matrix makes zero, but for round-off. */
    Eigen::MatrixXd
    kernel(const Eigen::MatrixXd &matrix)
    {
      const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
      const double largest      = std::max(solver.eigenvalues().maxCoeff(), 1e-3);
      const Eigen::Index n_free = (solver.eigenvalues().array() <= round_off * largest).count();
      return solver.eigenvectors().leftCols(n_free);
    }


    /** That of all parts together, as if they were one. */
    Matrix6
    sum_of_products(const Linkage &linkage, const Mesh &mesh, const std::vector<double> &products)
    {
      const BoundingBox<3> &box = mesh.report.pieces[mesh.report.parts[linkage.parts[0]].piece].box;
      Matrix6 sum               = Matrix6::Zero();
      for (const unsigned int part : linkage.parts)
        {
          // A motion of the piece as one of the part: at its center, and in its lengths.
          const BoundingBox<3> &own = mesh.report.parts[part].box;
          Matrix6 change            = Matrix6::Zero();
          change.topRows<3>()       = RigidMotions(box).at(own.center());
          change.bottomRightCorner<3, 3>().diagonal().fill(diameter_of(own) / diameter_of(box));
          sum += change.transpose() * scaled_products(products, part, mesh.section) * change;
        }
      return sum;
    }


    /** Free motions as columns, six rows for each part. */
    Eigen::MatrixXd
    free_motions(const Linkage &linkage, const Mesh &mesh, const std::vector<double> &products)
    {
      const auto &parts      = mesh.report.parts;
      const Eigen::Index n   = 6 * linkage.parts.size();
      Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
      for (std::size_t p = 0; p < linkage.parts.size(); ++p)
        matrix.block<6, 6>(6 * p, 6 * p) =
          scaled_products(products, linkage.parts[p], mesh.section);
      for (const MeshReport::Joint *joint : linkage.joints)
        for (std::size_t k = 1; k < joint->parts.size(); ++k)
          {
            // Both parts move the vertex alike; lengths are measured in those of each part.
            const unsigned int a = joint->parts[0], b = joint->parts[k];
            const auto of_a         = RigidMotions(parts[a].box).at(joint->place),
                       of_b         = RigidMotions(parts[b].box).at(joint->place);
            const Eigen::Index at_a = 6 * linkage.place_of(a), at_b = 6 * linkage.place_of(b);
            matrix.block<6, 6>(at_a, at_a) += of_a.transpose() * of_a;
            matrix.block<6, 6>(at_a, at_b) -= of_a.transpose() * of_b;
            matrix.block<6, 6>(at_b, at_a) -= of_b.transpose() * of_a;
            matrix.block<6, 6>(at_b, at_b) += of_b.transpose() * of_b;
          }
      return kernel(matrix);
    }


    /** "x and y" for directions that are columns, or "(0.6, 0.8, 0)" for one that is askew. */
    std::string
    in_words(const Eigen::MatrixXd &directions)
    {
      std::vector<std::string> words;
      for (unsigned int i = 0; i < 3; ++i)
        if (directions.row(i).norm() > 1. - 1e-6)
          words.push_back(std::string(1, "xyz"[i]));
      if (static_cast<Eigen::Index>(words.size()) != directions.cols())
        {
          words.clear();
          for (Eigen::Index c = 0; c < directions.cols(); ++c)
            {
              std::ostringstream text;
              text.precision(3);
              for (unsigned int i = 0; i < 3; ++i)
                text << (i == 0 ? "(" : ", ")
                     << (std::abs(directions(i, c)) < 1e-9 ? 0. : directions(i, c));
              words.push_back(text.str() + ")");
            }
        }
      std::string text = words[0];
      for (std::size_t i = 1; i < words.size(); ++i)
        text += (i + 1 == words.size() ? " and " : ", ") + words[i];
      return text;
    }


    /** "slide along x and turn about y", for motions that are columns of six numbers. */
    std::string
    possible(const Eigen::MatrixXd &motions)
    {
      const Eigen::JacobiSVD<Eigen::MatrixXd> all(motions, Eigen::ComputeThinU);
      const Eigen::Index n_all  = (all.singularValues().array() > 1e-6).count();
      const Eigen::MatrixXd own = all.matrixU().leftCols(n_all);
      const Eigen::JacobiSVD<Eigen::MatrixXd> turns(own.bottomRows(3),
                                                    Eigen::ComputeFullU | Eigen::ComputeFullV);
      const Eigen::Index n_turns = (turns.singularValues().array() > 1e-6).count();

      std::string text;
      if (n_all > n_turns)
        text =
          "slide along " + in_words(own.topRows(3) * turns.matrixV().rightCols(n_all - n_turns));
      if (n_turns > 0)
        text += (text.empty() ? "" : " and ") + std::string("turn about ") +
                in_words(turns.matrixU().leftCols(n_turns));
      return text;
    }


    template <class Set>
    std::string
    that_of(const Set &set, const Section &section)
    {
      return "of " + std::to_string(set.n_cells) + (set.n_cells == 1 ? " cell" : " cells") +
             " in " + extent_in_words(set.box, section.plane() ? 2 : 3) + " m";
    }


    std::string
    describe(const Linkage &linkage, const Eigen::MatrixXd &motions, const Mesh &mesh)
    {
      const MeshReport &report       = mesh.report;
      const MeshReport::Piece &piece = report.pieces[report.parts[linkage.parts[0]].piece];
      const bool is_whole            = report.pieces.size() == 1;
      const std::string of_piece     = " of the piece " + that_of(piece, mesh.section);
      if (mesh.section.axisymmetric())
        return (is_whole ? "its one rigid motion" : "the one rigid motion" + of_piece) +
               ", along its axis, is free";
      std::size_t loosest = 0;
      for (std::size_t p = 1; p < linkage.parts.size(); ++p)
        if (motions.middleRows(6 * p, 6).norm() > motions.middleRows(6 * loosest, 6).norm() + 1e-9)
          loosest = p;
      const std::string can = possible(motions.middleRows(6 * loosest, 6));
      if (linkage.parts.size() > 1)
        return "its part " + that_of(report.parts[linkage.parts[loosest]], mesh.section) +
               " hangs together with the rest by vertices or edges alone, as by a hinge, and can " +
               can;
      return std::to_string(motions.cols()) + (is_whole ? " of its " : " of the ") +
             (mesh.section.plane() ? "3" : "6") + " rigid motions" + (is_whole ? "" : of_piece) +
             (motions.cols() == 1 ? " is free (it can " : " are free (it can ") + can + ")";
    }
  } // namespace


  RigidMotions::RigidMotions(const BoundingBox<3> &box)
    : center(box.center())
    , diameter(diameter_of(box))
  {
  }


  Eigen::Matrix<double, 3, 6>
  RigidMotions::at(const Point<3> &x) const
  {
    const dealii::Tensor<1, 3> arm     = (x - center) / diameter;
    Eigen::Matrix<double, 3, 6> motion = Eigen::Matrix<double, 3, 6>::Zero();
    for (unsigned int i = 0; i < 3; ++i)
      {
        const unsigned int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        motion(i, i)      = 1.;
        motion(i, 3 + i1) = arm[i2]; // (w cross x)_i = w_i1 x_i2 - w_i2 x_i1
        motion(i, 3 + i2) = -arm[i1];
      }
    return motion;
  }


  std::string
  free_motions_in_words(const Mesh &mesh, const std::vector<double> &products)
  {
    constexpr std::size_t most_parts = 100; // the matrix is dense

    for (Linkage &linkage : linkages(mesh.report))
      {
        const bool one                = linkage.parts.size() > most_parts;
        const Eigen::MatrixXd motions = one ? kernel(sum_of_products(linkage, mesh, products))
                                            : free_motions(linkage, mesh, products);
        if (one)
          linkage.parts.resize(1);
        if (motions.cols() > 0)
          return describe(linkage, motions, mesh);
      }
    return "";
  }
} // namespace Supple
