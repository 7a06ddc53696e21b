#include <supple/contact/contact_surface.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <map>

namespace Supple
{
  using dealii::Utilities::MPI::max;
  using dealii::Utilities::MPI::sum;

  namespace
  {
    using Triple = std::array<unsigned int, 3>;

    /** The triangles that a face of the surface counts as. */
    std::vector<Triple>
    triangles_of(const DistributedMesh &mesh, const std::size_t face)
    {
      const Triple &corners = mesh.faces[face].nodes;
      if (!mesh.is_quadratic())
        return {corners};
      const Triple &middles = mesh.face_middles[face];
      return {{{corners[0], middles[0], middles[2]}},
              {{corners[1], middles[1], middles[0]}},
              {{corners[2], middles[2], middles[1]}},
              middles};
    }
  } // namespace


  ContactSurface::ContactSurface(const Body &body)
    : body(body)
  {
    if (body.mesh.section.plane())
      collect_edges_of_plane_body();
    else
      collect_triangles();
    collect_rest();
    represent();
    for (const SurfacePart &face : faces())
      nodes.insert(nodes.end(), face.nodes.begin(), face.nodes.begin() + face.n);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }


  void
  ContactSurface::collect_edges_of_plane_body()
  {
    for (const LocalFace &face : body.mesh.parts->faces)
      {
        SurfacePart edge{2, {{face.nodes[0], face.nodes[1], face.nodes[1]}}, 0., face.owned};
        const Arrow a = body.position(edge.nodes[0]), b = body.position(edge.nodes[1]);
        edge.measure = (b - a).norm() * body.mesh.section.thickness_at(0.5 * (a[0] + b[0]));
        edges.push_back(edge);
      }
  }


  void
  ContactSurface::collect_triangles()
  {
    const DistributedMesh &mesh = *body.mesh.parts;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      for (const Triple &nodes : triangles_of(mesh, f))
        {
          const Arrow a = body.position(nodes[0]);
          const Arrow b = body.position(nodes[1]) - a, c = body.position(nodes[2]) - a;
          triangles.push_back(
            {3, nodes, 0.5 * dealii::cross_product_3d(b, c).norm(), mesh.faces[f].owned});
        }
  }


  void
  ContactSurface::collect_rest()
  {
    const auto owns = [this](const unsigned int node) { return node < body.n_owned; };
    std::vector<double> of_vertex(body.n_local, 0.);
    std::map<std::array<unsigned int, 2>, double> of_edge;
    for (const SurfacePart &face : faces())
      for (unsigned int v = 0; v < face.n; ++v)
        {
          const unsigned int one = face.nodes[v], other = face.nodes[(v + 1) % 3];
          of_vertex[one] += face.measure / face.n;
          if (face.n == 3)
            of_edge[{{std::min(one, other), std::max(one, other)}}] += face.measure / 3.;
        }
    for (unsigned int node = 0; node < body.n_owned; ++node)
      if (of_vertex[node] > 0.)
        vertices.push_back({1, {{node, node, node}}, of_vertex[node], true});
    for (const auto &[nodes, measure] : of_edge)
      {
        const bool ascending = body.serial_vertex[nodes[0]] < body.serial_vertex[nodes[1]];
        const bool owned     = owns(nodes[ascending ? 0 : 1]);
        edges.push_back({2, {{nodes[0], nodes[1], nodes[1]}}, measure, owned});
      }
    for (std::vector<SurfacePart> *parts : {&edges, &triangles})
      parts->erase(std::remove_if(parts->begin(),
                                  parts->end(),
                                  [&](const SurfacePart &part) {
                                    return !part.owned &&
                                           std::none_of(part.nodes.begin(), part.nodes.end(), owns);
                                  }),
                   parts->end());
  }


  Simplex
  ContactSurface::simplex(const SurfacePart &part, const double *const u) const
  {
    Simplex simplex{part.n, {}};
    for (unsigned int v = 0; v < part.n; ++v)
      simplex.x[v] = place(part.nodes[v], u);
    return simplex;
  }


  Corners
  ContactSurface::values(const SurfacePart &part, const double *const values)
  {
    Corners corners;
    for (unsigned int v = 0; v < part.n; ++v)
      for (unsigned int i = 0; i < 3; ++i)
        corners[v][i] = values[3 * part.nodes[v] + i];
    return corners;
  }


  Arrow
  ContactSurface::place(const unsigned int node, const double *const u) const
  {
    Arrow place;
    for (unsigned int i = 0; i < 3; ++i)
      place[i] = body.positions[node][i] + u[3 * node + i];
    return place;
  }


  double
  ContactSurface::length(const SurfacePart &edge) const
  {
    return (body.position(edge.nodes[1]) - body.position(edge.nodes[0])).norm();
  }


  double
  ContactSurface::shortest_edge() const
  {
    double shortest = std::numeric_limits<double>::max();
    for (const SurfacePart &edge : edges)
      shortest = std::min(shortest, length(edge));
    return -max(-shortest, body.mesh.communicator);
  }


  double
  ContactSurface::mean_edge() const
  {
    double lengths = 0., n = 0.;
    for (const SurfacePart &edge : edges)
      if (edge.owned)
        {
          lengths += length(edge);
          n += 1.;
        }
    return sum(lengths, body.mesh.communicator) / sum(n, body.mesh.communicator);
  }
} // namespace Supple
