// The pressure of contact at nodes, out of the forces of its pairs.

#include <supple/forces/contact.h>

#include <vector>

namespace Supple
{
  namespace
  {
    /** The first of the three numbers of each node over the second, where that is not zero. */
    void
    divide(Vector &sums, const unsigned int n_nodes)
    {
      for (unsigned int node = 0; node < n_nodes; ++node)
        if (double *const sum = &sums.local_element(3 * node); sum[1] > 0.)
          sum[0] /= sum[1];
    }


    /** The first faces of those that are one face of a cell, of this process's own cells, and that
     * touch something. @param touches of each triangle or edge */
    std::vector<std::size_t>
    touching_faces(const std::vector<SurfacePart> &parts,
                   const std::vector<bool> &touches,
                   const unsigned int n_parts)
    {
      std::vector<std::size_t> first;
      for (std::size_t part = 0; part < parts.size(); part += parts[part].owned ? n_parts : 1)
        {
          bool any = false;
          for (std::size_t k = part; k < part + n_parts && parts[part].owned; ++k)
            any = any || touches[k];
          if (any)
            first.push_back(part);
        }
      return first;
    }
  } // namespace


  Vector
  Contact::pressure(const Configuration &configuration) const
  {
    const std::vector<SurfacePart> &parts = surface.faces();
    const unsigned int n_parts            = body.mesh.parts->is_quadratic() ? 4 : 1; // of a face
    std::vector<bool> touches(parts.size(), false);
    Vector sums; // of forces, and of the areas that touch
    body.initialize(sums);
    sums = 0.;
    {
      const GhostValues u(configuration.displacement());
      for (const ContactPair &pair : pairs(u.data(), configuration.passage))
        {
          for (const SurfacePart *const part : {pair.part, pair.other})
            if (part && !pair.guards)
              touches[part - parts.data()] = true;
          for (unsigned int v = 0; v < pair.n && pair.part->owned; ++v)
            *(sums.begin() + 3 * pair.nodes[v]) += std::abs(pair.c[v]) * force_of(pair).norm();
        }
    }
    const std::vector<std::size_t> faces = touching_faces(parts, touches, n_parts);
    const auto add                       = [&](const unsigned int i, const auto &value) {
      for (const std::size_t face : faces)
        for (std::size_t part = face; part < face + n_parts; ++part)
          for (unsigned int v = 0; v < parts[part].n; ++v)
            *(sums.begin() + 3 * parts[part].nodes[v] + i) +=
              value(face) * parts[part].measure / parts[part].n;
    };
    add(1, [](std::size_t) { return 1.; });
    sums.compress(dealii::VectorOperation::add);
    for (const SurfacePart &vertex : surface.vertices) // that guards alone keep away
      if (double *const sum = &sums.local_element(3 * vertex.nodes[0]); sum[1] == 0.)
        sum[1] = vertex.measure;
    divide(sums, body.n_owned);
    if (n_parts == 1)
      return sums;

    const Vector of_nodes = sums;
    const GhostValues p(of_nodes);
    sums = 0.;
    add(0, [&](const std::size_t face) {
      double force = 0., area = 0.;
      for (std::size_t part = face; part < face + n_parts; ++part)
        for (unsigned int v = 0; v < parts[part].n; ++v)
          {
            force += p.data()[3 * parts[part].nodes[v]] * parts[part].measure / parts[part].n;
            area += parts[part].measure / parts[part].n;
          }
      return force / area;
    });
    add(1, [](std::size_t) { return 1.; });
    sums.compress(dealii::VectorOperation::add);
    for (unsigned int node = 0; node < body.n_owned; ++node)
      if (sums.local_element(3 * node + 1) == 0.)
        sums.local_element(3 * node) = of_nodes.local_element(3 * node);
    divide(sums, body.n_owned);
    return sums;
  }
} // namespace Supple
