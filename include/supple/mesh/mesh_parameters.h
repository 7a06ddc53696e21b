#ifndef supple_mesh_parameters_h
#define supple_mesh_parameters_h

#include <supple/input/parameter_file.h>
#include <supple/mesh/refinement_parameters.h>
#include <supple/mesh/section.h>

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

namespace Supple
{
  /** Subsection Mesh: the body at rest. */
  struct MeshParameters
  {
    enum class Shape
    {
      box,
      hollow_cylinder,
      rectangle,
      file
    };

    /** How the squares of a rectangle are cut in two. */
    enum class Split
    {
      falling,
      rising,
      alternating
    };

    Shape shape = Shape::box;

    dealii::Point<3> origin{0., 0., 0.};
    dealii::Point<3> size{1., 1., 1.};
    std::array<unsigned int, 3> cubes{{4, 4, 4}};

    double inner_radius  = 0.3;
    double outer_radius  = 0.4;
    double height        = 1.;
    unsigned int sectors = 15;
    unsigned int rings   = 6;
    unsigned int layers  = 1;

    dealii::Point<2> rectangle_origin{0., 0.};
    dealii::Point<2> rectangle_size{1., 1.};
    std::array<unsigned int, 2> squares{{8, 8}};
    Split split = Split::falling;

    std::vector<double> material_layers;  ///< thicknesses from the top (largest y) downward [m]
    std::vector<unsigned int> layer_rows; ///< of cubes or squares in each layer; may be empty

    std::string file;       ///< or several, as written; relative to the folder of the scene
    std::string piece_maps; ///< where the vertices of each piece are put; empty: one piece
    double scale = 1.;
    std::string boundary_regions;
    std::string map; ///< where vertices are put; empty: they stay

    unsigned int order = 1; ///< of the displacements in a cell

    RefinementParameters refinement;

    void
    declare(dealii::ParameterHandler &prm);

    /** @throws InputError for a mesh that can't be made; @p scene knows who asked for it */
    void
    check(const ParameterFile &scene) const;

    /** Where rows of cubes or squares end along y, from the bottom: one more than there are, from 0
     * to the height [m]. */
    std::vector<double>
    ends_of_rows(double height, unsigned int n_rows) const;

    /** The material id of each row, from the bottom. */
    std::vector<unsigned int>
    material_of_rows(const std::vector<double> &ends) const;

    /** Whether straight edges of a cylinder's outer wall would cut through the inner one. */
    bool
    walls_cross() const;

    /** Of a box or a rectangle along y, and how many cubes or squares it has there. */
    std::pair<double, unsigned int>
    height_and_rows() const;

  private:
    void
    declare_cylinder(dealii::ParameterHandler &prm);

    void
    declare_rectangle(dealii::ParameterHandler &prm);

    /** And where vertices are put. */
    void
    declare_layers(dealii::ParameterHandler &prm);

    void
    declare_file(dealii::ParameterHandler &prm);

    void
    declare_order(dealii::ParameterHandler &prm);

    void
    check_cylinder(const ParameterFile &scene) const;

    /** What quadratic cells can't do. */
    void
    check_order(const ParameterFile &scene) const;

    void
    check_layers(const ParameterFile &scene) const;

    void
    check_layer_rows(const ParameterFile &scene) const;
  };


  /** Subsection Plane: the third dimension of a body of triangles. */
  struct PlaneParameters
  {
    Section section{Geometry::plane_strain, 1.};

    void
    declare(dealii::ParameterHandler &prm);

    /** @throws InputError for a thickness that would count for nothing */
    void
    check(const ParameterFile &scene) const;
  };
} // namespace Supple

#endif
