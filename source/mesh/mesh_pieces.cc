#include <supple/mesh/mesh_pieces.h>

#include <supple/base/error.h>

#include <algorithm>

namespace Supple
{
  namespace
  {
    void
    add_names(std::map<std::string, unsigned int> &names,
              const std::map<std::string, unsigned int> &more,
              const std::string &origin)
    {
      for (const auto &[name, id] : more)
        for (const auto &[other, same] : names)
          if (same == id && other != name)
            throw InputError(origin + ": the id " + std::to_string(id) + " is called " + other +
                             " in one file and " + name +
                             " in another. Give it one name in all, "
                             "or each its own id.");
      for (const auto &[name, id] : more)
        if (const auto [place, is_new] = names.emplace(name, id); !is_new && place->second != id)
          throw InputError(origin + ": the name " + name + " stands for the id " +
                           std::to_string(place->second) + " in one file and for " +
                           std::to_string(id) + " in another. Give it the same id in all.");
    }
  } // namespace


  void
  add_piece(SerialMesh &whole, const SerialMesh &piece, const std::string &origin)
  {
    if (whole.vertices.empty())
      {
        whole = piece;
        return;
      }
    if (piece.dimension != whole.dimension)
      throw InputError(origin +
                       ": all pieces must have cells of one kind, tetrahedra or triangles "
                       "in the plane.");
    if (piece.middles.empty() != whole.middles.empty())
      throw InputError(origin + ": all pieces must have cells of one order.");
    const unsigned int first = whole.vertices.size(), first_cell = whole.cells.size();
    const auto shift = [first](auto &vertices, const std::size_t n) { // those that count
      std::for_each(vertices.begin(), vertices.begin() + n, [first](unsigned int &vertex) {
        vertex += first;
      });
    };
    whole.vertices.insert(whole.vertices.end(), piece.vertices.begin(), piece.vertices.end());
    whole.materials.insert(whole.materials.end(), piece.materials.begin(), piece.materials.end());
    for (auto cell : piece.cells)
      {
        shift(cell, piece.dimension + 1);
        whole.cells.push_back(cell);
      }
    for (SerialMesh::BoundaryFace face : piece.boundary)
      {
        shift(face.vertices, piece.dimension);
        face.cell += first_cell;
        whole.boundary.push_back(face);
      }
    for (SerialMesh::Middle middle : piece.middles)
      {
        shift(middle.ends, 2);
        whole.middles.push_back(middle);
      }
    add_names(whole.material_names, piece.material_names, origin);
    add_names(whole.boundary_names, piece.boundary_names, origin);
    for (const std::string &warning : piece.warnings)
      if (std::find(whole.warnings.begin(), whole.warnings.end(), warning) == whole.warnings.end())
        whole.warnings.push_back(warning);
  }
} // namespace Supple
