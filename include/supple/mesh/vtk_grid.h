#ifndef supple_vtk_grid_h
#define supple_vtk_grid_h

#include <supple/mesh/file_mesh.h>

namespace Supple
{
  /** An unstructured grid of VTK, as its files of either kind hold it. Numbers begin with 0. */
  struct VtkGrid
  {
    /** A value, or several, of each cell. */
    struct Field
    {
      std::string name;
      std::size_t n_columns;
      std::vector<double> values; ///< cell by cell
    };

    std::vector<dealii::Point<3>> points;
    std::vector<double> connectivity; ///< the points of all cells
    std::vector<double> offsets;      ///< where each cell begins there, and where the last one ends
    std::vector<double> kinds;        ///< VTK's numbers, such as 10 for tetrahedra
    std::vector<Field> fields;        ///< of cells
  };


  /**
   * Its tetrahedra, triangles and lines. Ids are those of a field of one of the names in
   * doc/meshes.md; cells that the field vtkGhostType or vtkGhostLevels marks are left out, with a
   * warning.
   * @throws InputError where the lists don't fit each other
   */
  FileMesh
  mesh_of(const VtkGrid &grid);
} // namespace Supple

#endif
