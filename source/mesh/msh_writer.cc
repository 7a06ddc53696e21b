#include <supple/mesh/msh_writer.h>

#include <supple/base/text.h>

namespace Supple
{
  namespace
  {
    /** By the number of nodes. */
    unsigned int
    kind_of_element(const std::size_t n_nodes)
    {
      constexpr std::array<unsigned int, 11> kinds = {{0, 15, 1, 2, 4, 0, 9, 0, 0, 0, 11}};
      return kinds[n_nodes];
    }


    void
    add_names(std::string &text, const SerialMesh &mesh)
    {
      const std::size_t n = mesh.material_names.size() + mesh.boundary_names.size();
      if (n == 0)
        return;
      text += "$PhysicalNames\n" + std::to_string(n) + "\n";
      const auto add = [&](const std::map<std::string, unsigned int> &names,
                           const unsigned int dim) {
        for (const auto &[name, id] : names)
          text += std::to_string(dim) + " " + std::to_string(id) + " \"" + name + "\"\n";
      };
      add(mesh.boundary_names, mesh.dimension - 1);
      add(mesh.material_names, mesh.dimension);
      text += "$EndPhysicalNames\n";
    }


    /** Numbers from 0 on: the vertices and, of quadratic cells, the middles of edges in Gmsh's
     * order.
     */
    std::vector<unsigned int>
    nodes_of(const SerialMesh &mesh, const dealii::ArrayView<const unsigned int> &vertices)
    {
      constexpr std::array<std::array<unsigned int, 2>, 6> edges = {
        {{{0, 1}}, {{1, 2}}, {{0, 2}}, {{0, 3}}, {{2, 3}}, {{1, 3}}}};
      std::vector<unsigned int> nodes(vertices.begin(), vertices.end());
      if (!mesh.middles.empty())
        for (unsigned int e = 0; e < (vertices.size() == 4 ? 6 : 3); ++e)
          nodes.push_back(mesh.vertices.size() +
                          mesh.middle(vertices[edges[e][0]], vertices[edges[e][1]]));
      return nodes;
    }


    void
    add_node(std::string &text, const std::size_t number, const dealii::Point<3> &place)
    {
      text += std::to_string(number);
      for (unsigned int d = 0; d < 3; ++d)
        text += " " + digits(place[d], all_digits);
      text += "\n";
    }


    void
    add_element(std::string &text,
                const std::size_t number,
                const unsigned int id,
                const std::vector<unsigned int> &nodes)
    {
      // The second tag, a number of Gmsh's own, must not be 0, and not larger than its integers.
      const unsigned int tag = id < 2147483647u ? id + 1 : 1;
      text += std::to_string(number) + " " + std::to_string(kind_of_element(nodes.size())) + " 2 " +
              std::to_string(id) + " " + std::to_string(tag);
      for (const unsigned int node : nodes)
        text += " " + std::to_string(node + 1);
      text += "\n";
    }
  } // namespace


  std::string
  msh_text(const SerialMesh &mesh)
  {
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    add_names(text, mesh);
    text += "$Nodes\n" + std::to_string(mesh.vertices.size() + mesh.middles.size()) + "\n";
    std::size_t number = 0;
    for (const auto &vertex : mesh.vertices)
      add_node(text, ++number, vertex);
    for (const auto &middle : mesh.middles)
      add_node(text, ++number, middle.place);
    text +=
      "$EndNodes\n$Elements\n" + std::to_string(mesh.boundary.size() + mesh.cells.size()) + "\n";
    number = 0;
    for (const SerialMesh::BoundaryFace &face : mesh.boundary)
      add_element(text, ++number, face.boundary_id, nodes_of(mesh, mesh.face_vertices(face)));
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      add_element(text, ++number, mesh.materials[c], nodes_of(mesh, mesh.cell_vertices(c)));
    return text + "$EndElements\n";
  }
} // namespace Supple
