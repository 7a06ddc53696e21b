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
