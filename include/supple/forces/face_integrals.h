#ifndef supple_face_integrals_h
#define supple_face_integrals_h

#include <supple/input/parameter_file.h>
#include <supple/mechanics/body.h>
#include <supple/mechanics/selection.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace Supple
{
  /** Faces by their local nodes: three or, of quadratic cells, six, those of the edges 01, 12, 20
   * behind the corners. */
  template <unsigned int n>
  using FaceList = std::vector<std::array<unsigned int, n>>;


  /** @p n must be what the faces have. */
  template <unsigned int n>
  FaceList<n>
  nodes_of(const Faces &faces);


  /**
   * What integrals over a face need.
   *
   * An edge of a plane body stands for a strip as wide as the section is thick, or for a ring about
   * the axis, as wide as its distance from there makes it, which is linear along the edge.
   */
  struct FaceIntegrals
  {
    /** @param x places of the face's nodes [m] */
    FaceIntegrals(const std::array<dealii::Point<3>, 3> &x, const Section &section);

    dealii::Tensor<1, 3> normal; ///< outward, as long as the face is large

    /** Integrals of products of two shape functions, over the length of the normal. */
    std::array<std::array<double, 3>, 3> products{};
  };


  /**
   * The face of a quadratic cell, which may be curved: x = sum N_v x_v with six shape functions,
   * and a rule of six points, exact to degree four (Strang and Fix 1973).
   */
  class CurvedFace
  {
  public:
    static constexpr unsigned int n_points = 6;

    /** @param x places of the face's nodes [m] */
    explicit CurvedFace(const std::array<dealii::Point<3>, 6> &x);

    /** Outward, as long as what the point stands for is large [m^2]. */
    std::array<dealii::Tensor<1, 3>, n_points> normals;

    /** N_v at each point. */
    static const std::array<std::array<double, 6>, n_points> &
    shape_values();

    /** The derivative of the normal of a point by the place of node v. */
    dealii::Tensor<2, 3>
    normal_derivative(unsigned int point, unsigned int v) const;

  private:
    std::array<std::array<dealii::Tensor<1, 3>, 2>, n_points> tangents;
  };


  /** A matrix for each pair of a face's nodes. */
  template <unsigned int n>
  using FaceMatrices = std::array<std::array<dealii::Tensor<2, 3>, n>, n>;


  /**
   * Of a pressure on a face that moves: the entry (v, w) is the derivative of p n N_v, integrated
   * over the face, by the place of node w [N/m]. Load stiffness: Schweizerhof and Ramm, Computers &
   * Structures 18 (1984) 1099.
   * @param x places of the face's nodes [m]
   * @param p pressure there [Pa]
   */
  FaceMatrices<3>
  pressure_derivatives(const std::array<dealii::Point<3>, 3> &x,
                       const std::array<double, 3> &p,
                       const Section &section);

  /** The same for a face of a quadratic cell. */
  FaceMatrices<6>
  pressure_derivatives(const std::array<dealii::Point<3>, 6> &x,
                       const std::array<double, 6> &p,
                       const Section &section);


  /** The faces that a load of this name in subsection Loads acts on.
   * @throws InputError for a load that acts nowhere, or boundaries that the body does not have */
  Faces
  loaded_faces(const Body &body,
               bool acts,
               const std::vector<std::string> &boundaries,
               const std::string &load,
               const ParameterFile &scene);
} // namespace Supple

#endif
