#include <supple/contact/surface_parts.h>

#include <algorithm>
#include <map>

namespace Supple
{
  Simplex
  SurfacePart::at(const std::vector<Arrow> &places) const
  {
    Simplex simplex{n, {}};
    for (unsigned int v = 0; v < n; ++v)
      simplex.x[v] = places[nodes[v]];
    return simplex;
  }


  bool
  SurfacePart::has_node(const unsigned int node) const
  {
    return std::find(nodes.begin(), nodes.begin() + n, node) != nodes.begin() + n;
  }


  bool
  SurfacePart::shares_node_with(const SurfacePart &other) const
  {
    return std::any_of(nodes.begin(), nodes.begin() + n, [&other](const unsigned int node) {
      return other.has_node(node);
    });
  }


  namespace
  {
    using Nodes = std::array<unsigned int, 2>;

    Nodes
    ends(const unsigned int one, const unsigned int other)
    {
      return {{std::min(one, other), std::max(one, other)}};
    }
  } // namespace


  void
  SurfaceParts::represent()
  {
    std::map<unsigned int, unsigned int> vertex_at;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      vertex_at[vertices[v].nodes[0]] = v;
    std::map<Nodes, unsigned int> edge_between;
    for (unsigned int e = 0; e < edges.size(); ++e)
      edge_between[ends(edges[e].nodes[0], edges[e].nodes[edges[e].n - 1])] = e;

    const std::vector<SurfacePart> &all = faces();
    represented_vertices.assign(all.size(), {});
    represented_edges.assign(all.size(), {});
    const auto take = [](auto &map, const auto &key, std::vector<unsigned int> &list) {
      if (const auto found = map.find(key); found != map.end())
        {
          list.push_back(found->second);
          map.erase(found);
        }
    };
    for (std::size_t f = 0; f < all.size(); ++f)
      for (unsigned int v = 0; v < all[f].n; ++v)
        {
          const unsigned int one = all[f].nodes[v], other = all[f].nodes[(v + 1) % all[f].n];
          take(vertex_at, one, represented_vertices[f]);
          take(edge_between, ends(one, other), represented_edges[f]);
        }
  }
} // namespace Supple
