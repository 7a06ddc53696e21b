#include <supple/forces/face_integrals.h>

#include <supple/base/error.h>
#include <supple/mechanics/selection.h>

namespace Supple
{
  using namespace dealii;

  FaceIntegrals::FaceIntegrals(const std::array<Point<3>, 3> &x, const Section &section)
  {
    if (!section.plane())
      {
        normal = 0.5 * cross_product_3d(x[1] - x[0], x[2] - x[0]);
        for (unsigned int v = 0; v < 3; ++v)
          for (unsigned int w = 0; w < 3; ++w)
            products[v][w] = (v == w ? 2. : 1.) / 12.;
        return;
      }
    // (1 + delta_vw) / 6 for a constant width.
    normal = cross_product_3d(x[1] - x[0], Point<3>(0., 0., 1.));
    const std::array<double, 2> width{
      {section.thickness_at(x[0][0]), section.thickness_at(x[1][0])}};
    products[0][0] = width[0] / 4. + width[1] / 12.;
    products[1][1] = width[0] / 12. + width[1] / 4.;
    products[0][1] = products[1][0] = (width[0] + width[1]) / 12.;
  }


  namespace
  {
    Tensor<1, 3>
    unit_vector(const unsigned int i)
    {
      Tensor<1, 3> e;
      e[i] = 1.;
      return e;
    }


    /** The derivative of the normal by the place of node w. */
    Tensor<2, 3>
    normal_derivative(const std::array<Point<3>, 3> &x,
                      const Section &section,
                      const unsigned int w)
    {
      const double sign = w == 0 ? -1. : w == 1 ? 1. : 0.;
      const Tensor<1, 3> opposite =
        section.plane() ? sign * unit_vector(2) : 0.5 * (x[(w + 1) % 3] - x[(w + 2) % 3]);
      Tensor<2, 3> derivative;
      for (unsigned int j = 0; j < 3; ++j)
        {
          const Tensor<1, 3> column = cross_product_3d(unit_vector(j), opposite);
          for (unsigned int i = 0; i < 3; ++i)
            derivative[i][j] = column[i];
        }
      return derivative;
    }


    /** What the width of an edge about the axis adds, which grows with the distance from there. */
    void
    add_widening(FaceMatrices &matrices,
                 const Tensor<1, 3> &normal,
                 const std::array<double, 3> &p,
                 const Section &section)
    {
      const double slope = section.thickness_at(1.) - section.thickness_at(0.);
      for (unsigned int v = 0; v < 2; ++v)
        for (unsigned int w = 0; w < 2; ++w)
          for (unsigned int b = 0; b < 2; ++b)
            {
              const double product = v == w && w == b ? 1. / 4. : 1. / 12.;
              matrices[v][w] += slope * product * p[b] * outer_product(normal, unit_vector(0));
            }
    }
  } // namespace


  FaceMatrices
  pressure_derivatives(const std::array<Point<3>, 3> &x,
                       const std::array<double, 3> &p,
                       const Section &section)
  {
    const FaceIntegrals face(x, section);
    FaceMatrices matrices;
    for (unsigned int v = 0; v < 3; ++v)
      for (unsigned int w = 0; w < 3; ++w)
        for (unsigned int b = 0; b < 3; ++b)
          matrices[v][w] += face.products[v][b] * p[b] * normal_derivative(x, section, w);
    if (section.axisymmetric())
      add_widening(matrices, face.normal, p, section);
    return matrices;
  }


  Faces
  loaded_faces(const Body &body,
               const bool acts,
               const std::vector<std::string> &boundaries,
               const std::string &load,
               const ParameterFile &scene)
  {
    if (acts && boundaries.empty())
      throw InputError(scene.origin("Loads/" + load) + ": it acts nowhere; set \"" + load +
                       " on\" to boundary ids.");
    return Selection(body).boundary_faces(boundaries, scene.origin("Loads/" + load + " on"));
  }
} // namespace Supple
