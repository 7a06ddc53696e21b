#ifndef supple_face_integrals_h
#define supple_face_integrals_h

#include <supple/input/parameter_file.h>
#include <supple/mechanics/body.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace Supple
{
  /** Faces of the surface by their local nodes, normals pointing outward; the second node of an
   * edge stands twice. */
  using Faces = std::vector<std::array<unsigned int, 3>>;


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


  /** A matrix for each pair of a face's nodes. */
  using FaceMatrices = std::array<std::array<dealii::Tensor<2, 3>, 3>, 3>;


  /**
   * Of a pressure on a face that moves: the entry (v, w) is the derivative of p n N_v, integrated
   * over the face, by the place of node w [N/m]. Load stiffness: Schweizerhof and Ramm, Computers &
   * Structures 18 (1984) 1099.
   * @param x places of the face's nodes [m]
   * @param p pressure there [Pa]
   */
  FaceMatrices
  pressure_derivatives(const std::array<dealii::Point<3>, 3> &x,
                       const std::array<double, 3> &p,
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
