#include <supple/mesh/mesh_counts.h>

namespace Supple
{
  std::vector<MeshCounts>
  counts_of(const MeshParameters &mesh)
  {
    using Shape = MeshParameters::Shape;
    switch (mesh.shape)
      {
        case Shape::box:
          return {{"Mesh/Box cubes", {mesh.cubes.begin(), mesh.cubes.end()}},
                  {"Mesh/Layer rows", mesh.layer_rows}};
        case Shape::rectangle:
          return {{"Mesh/Rectangle squares", {mesh.squares.begin(), mesh.squares.end()}},
                  {"Mesh/Layer rows", mesh.layer_rows}};
        case Shape::hollow_cylinder:
          return {{"Mesh/Cylinder sectors", {mesh.sectors}},
                  {"Mesh/Cylinder layers", {mesh.layers}},
                  {"Mesh/Cylinder rings", {mesh.rings - 1}, 1}};
        default:
          return {};
      }
  }
} // namespace Supple
