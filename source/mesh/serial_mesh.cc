#include <supple/mesh/serial_mesh.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace Supple
{
  using dealii::Point;
  using dealii::Tensor;

  double
  SerialMesh::volume(const std::size_t cell) const
  {
    const Point<3> &origin    = vertices[cells[cell][0]];
    const Tensor<1, 3> normal = dealii::cross_product_3d(vertices[cells[cell][1]] - origin,
                                                         vertices[cells[cell][2]] - origin);
    return dimension == 2 ? 0.5 * normal[2] : normal * (vertices[cells[cell][3]] - origin) / 6.;
  }


  unsigned int
  SerialMesh::middle(const unsigned int v, const unsigned int w) const
  {
    const std::array<unsigned int, 2> ends = {{std::min(v, w), std::max(v, w)}};
    const auto found                       = std::lower_bound(middles.begin(),
                                        middles.end(),
                                        ends,
                                        [](const Middle &middle, const auto &wanted) {
                                          return middle.ends < wanted;
                                        });
    if (found == middles.end() || found->ends != ends)
      throw std::out_of_range("no edge of the mesh");
    return found - middles.begin();
  }


  std::vector<SerialMesh::CellFace>
  SerialMesh::sorted_faces() const
  {
    std::vector<CellFace> faces;
    faces.reserve((dimension + 1) * cells.size());
    for (unsigned int c = 0; c < cells.size(); ++c)
      for (unsigned int opposite = 0; opposite <= dimension; ++opposite)
        {
          CellFace face{{}, c};
          face.vertices.fill(dealii::numbers::invalid_unsigned_int);
          unsigned int end = 0;
          for (unsigned int a = 0; a <= dimension; ++a)
            if (a != opposite)
              face.vertices[end++] = cells[c][a];
          std::sort(face.vertices.begin(), face.vertices.end());
          faces.push_back(face);
        }
    std::sort(faces.begin(), faces.end(), [](const CellFace &a, const CellFace &b) {
      return std::tie(a.vertices, a.cell) < std::tie(b.vertices, b.cell);
    });
    return faces;
  }
} // namespace Supple
