#include <supple/forces/face_integrals.h>

#include <supple/base/error.h>

#include <algorithm>

namespace Supple
{
  using namespace dealii;

  template <>
  FaceList<3>
  nodes_of<3>(const Faces &faces)
  {
    return faces.corners;
  }


  template <>
  FaceList<6>
  nodes_of<6>(const Faces &faces)
  {
    FaceList<6> list(faces.middles.size());
    for (std::size_t f = 0; f < list.size(); ++f)
      {
        std::copy(faces.corners[f].begin(), faces.corners[f].end(), list[f].begin());
        std::copy(faces.middles[f].begin(), faces.middles[f].end(), list[f].begin() + 3);
      }
    return list;
  }


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
    add_widening(FaceMatrices<3> &matrices,
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


  FaceMatrices<3>
  pressure_derivatives(const std::array<Point<3>, 3> &x,
                       const std::array<double, 3> &p,
                       const Section &section)
  {
    const FaceIntegrals face(x, section);
    FaceMatrices<3> matrices;
    for (unsigned int v = 0; v < 3; ++v)
      for (unsigned int w = 0; w < 3; ++w)
        for (unsigned int b = 0; b < 3; ++b)
          matrices[v][w] += face.products[v][b] * p[b] * normal_derivative(x, section, w);
    if (section.axisymmetric())
      add_widening(matrices, face.normal, p, section);
    return matrices;
  }


  namespace
  {
    /** A point of the rule: barycentric coordinates and weight. */
    struct FacePoint
    {
      std::array<double, 3> L;
      double weight;
    };


    const std::array<FacePoint, 6> &
    face_points()
    {
      static const std::array<FacePoint, 6> points = [] {
        std::array<FacePoint, 6> list{};
        unsigned int n = 0;
        for (const auto &[near, weight] :
             {std::array<double, 2>{{0.44594849091596489, 0.22338158967801147}},
              {{0.09157621350977073, 0.10995174365532187}}})
          for (unsigned int apart = 0; apart < 3; ++apart, ++n)
            {
              list[n].L.fill(near);
              list[n].L[apart] = 1. - 2. * near;
              list[n].weight   = weight;
            }
        return list;
      }();
      return points;
    }


    /** dN_v/dL_k of the six shape functions. */
    std::array<double, 3>
    shape_slopes(const unsigned int v, const std::array<double, 3> &L)
    {
      std::array<double, 3> slopes{};
      if (v < 3)
        slopes[v] = 4. * L[v] - 1.;
      else
        {
          const unsigned int a = v - 3, b = (a + 1) % 3;
          slopes[a] = 4. * L[b];
          slopes[b] = 4. * L[a];
        }
      return slopes;
    }
  } // namespace


  CurvedFace::CurvedFace(const std::array<Point<3>, 6> &x)
  {
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const FacePoint &point = face_points()[q];
        for (unsigned int v = 0; v < 6; ++v)
          {
            const std::array<double, 3> slopes = shape_slopes(v, point.L);
            for (unsigned int k = 0; k < 2; ++k)
              tangents[q][k] += (slopes[k + 1] - slopes[0]) * x[v];
          }
        normals[q] = 0.5 * point.weight * cross_product_3d(tangents[q][0], tangents[q][1]);
      }
  }


  const std::array<std::array<double, 6>, CurvedFace::n_points> &
  CurvedFace::shape_values()
  {
    static const std::array<std::array<double, 6>, n_points> values = [] {
      std::array<std::array<double, 6>, n_points> list{};
      for (unsigned int q = 0; q < n_points; ++q)
        for (unsigned int v = 0; v < 3; ++v)
          {
            const std::array<double, 3> &L = face_points()[q].L;
            list[q][v]                     = L[v] * (2. * L[v] - 1.);
            list[q][v + 3]                 = 4. * L[v] * L[(v + 1) % 3];
          }
      return list;
    }();
    return values;
  }


  /** Of (t0 x t1) w/2, with the tangents t_k = sum (dN_v/dL_(k+1) - dN_v/dL_0) x_v. */
  Tensor<2, 3>
  CurvedFace::normal_derivative(const unsigned int q, const unsigned int v) const
  {
    const FacePoint &point             = face_points()[q];
    const std::array<double, 3> slopes = shape_slopes(v, point.L);
    const Tensor<1, 3> opposite =
      (slopes[1] - slopes[0]) * tangents[q][1] - (slopes[2] - slopes[0]) * tangents[q][0];
    Tensor<2, 3> derivative;
    for (unsigned int j = 0; j < 3; ++j)
      {
        const Tensor<1, 3> column = 0.5 * point.weight * cross_product_3d(unit_vector(j), opposite);
        for (unsigned int i = 0; i < 3; ++i)
          derivative[i][j] = column[i];
      }
    return derivative;
  }


  FaceMatrices<6>
  pressure_derivatives(const std::array<Point<3>, 6> &x,
                       const std::array<double, 6> &p,
                       const Section &)
  {
    const CurvedFace face(x);
    FaceMatrices<6> matrices;
    for (unsigned int q = 0; q < CurvedFace::n_points; ++q)
      {
        const std::array<double, 6> &N = CurvedFace::shape_values()[q];
        double pressure                = 0.;
        for (unsigned int b = 0; b < 6; ++b)
          pressure += N[b] * p[b];
        for (unsigned int w = 0; w < 6; ++w)
          {
            const Tensor<2, 3> derivative = face.normal_derivative(q, w);
            for (unsigned int v = 0; v < 6; ++v)
              matrices[v][w] += N[v] * pressure * derivative;
          }
      }
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
