#include <supple/mesh/msh_writer.h>

#include <supple/base/text.h>

namespace Supple
{
  namespace
  {
    constexpr std::array<unsigned int, 4> kind_of_dimension = {{15, 1, 2, 4}};


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


    /** @param n vertices */
    template <class Vertices>
    void
    add_element(std::string &text,
                const std::size_t number,
                const unsigned int id,
                const Vertices &vertices)
    {
      // The second tag, a number of Gmsh's own, must not be 0, and not larger than its integers.
      const unsigned int tag = id < 2147483647u ? id + 1 : 1;
      text += std::to_string(number) + " " +
              std::to_string(kind_of_dimension[vertices.size() - 1]) + " 2 " + std::to_string(id) +
              " " + std::to_string(tag);
      for (const unsigned int vertex : vertices)
        text += " " + std::to_string(vertex + 1);
      text += "\n";
    }
  } // namespace


  std::string
  msh_text(const SerialMesh &mesh)
  {
    std::string text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    add_names(text, mesh);
    text += "$Nodes\n" + std::to_string(mesh.vertices.size()) + "\n";
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      {
        text += std::to_string(v + 1);
        for (unsigned int d = 0; d < 3; ++d)
          text += " " + digits(mesh.vertices[v][d], all_digits);
        text += "\n";
      }
    text +=
      "$EndNodes\n$Elements\n" + std::to_string(mesh.boundary.size() + mesh.cells.size()) + "\n";
    std::size_t number = 0;
    for (const SerialMesh::BoundaryFace &face : mesh.boundary)
      add_element(text, ++number, face.boundary_id, mesh.face_vertices(face));
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      add_element(text, ++number, mesh.materials[c], mesh.cell_vertices(c));
    return text + "$EndElements\n";
  }
} // namespace Supple
