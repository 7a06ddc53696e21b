#ifndef supple_tests_law_of_cells_h
#define supple_tests_law_of_cells_h

#include <supple/mechanics/laws.h>
#include <supple/mesh/edge_middles.h>
#include <supple/mesh/mesh_generators.h>
#include <supple/mesh/refinement.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "driver/checks.h"

namespace Supple
{
  /** A law with cells of its own, whose rotations follow every displacement that it is given. */
  class LawOfCells
  {
  public:
    LawOfCells(const std::string &name,
               const std::vector<std::array<double, 3>> &positions,
               const std::vector<Cell> &list,
               const Section &section = Section(),
               const bool quadratic   = false)
      : cells(std::make_unique<
              const Cells>(positions, positions.size(), list, false, 0., section, 1, quadratic))
      , plane(section.plane())
      , n_nodes(positions.size())
    {
      LawChoice choice;
      choice.name = name;
      law         = make_law(choice, RotationMethod::polar, *cells);
    }

    std::size_t
    n_dofs() const
    {
      return 3 * n_nodes;
    }

    /** Whether a plane body can move so. */
    bool
    is_free(const std::size_t dof) const
    {
      return !plane || dof % 3 != 2;
    }

    double
    energy(const Nodal &u)
    {
      turn(u);
      return law->deformation(rotations, u.data()).elastic;
    }

    /** dW/du */
    Nodal
    force(const Nodal &u)
    {
      turn(u);
      Nodal f(u.size(), 0.);
      law->subtract_force(rotations, u.data(), f.data());
      for (double &x : f)
        x = -x;
      return f;
    }

    void
    update_tangent(const Nodal &u, const Tangent kind)
    {
      turn(u);
      law->update_tangent(kind, rotations, u.data());
    }

    /** K w */
    Nodal
    product(const Nodal &w) const
    {
      Nodal y(w.size(), 0.);
      law->add_frozen_product(rotations, 1., w.data(), y.data());
      law->add_turning_product(rotations, 1., w.data(), y.data());
      return y;
    }

    /** How far the matrix times w is from K w, over |K w|. */
    double
    matrix_stray(const Nodal &w, const Nodal &Kw) const
    {
      const SymmetricPattern pattern = full_pattern(n_nodes);
      const CellSlots slots(*cells, pattern);
      SymmetricBlockMatrix A(pattern);
      law->add_tangent(rotations, 0., 1., 1., slots, A);
      Nodal y(w.size());
      A.vmult(y.data(), w.data());
      double stray = 0.;
      for (std::size_t dof = 0; dof < w.size(); ++dof)
        if (is_free(dof))
          stray = std::max(stray, std::abs(y[dof] - Kw[dof]));
      return stray / norm(Kw);
    }

  private:
    void
    turn(const Nodal &u)
    {
      if (law->has_rotations())
        law->update_rotations(u.data(), rotations.current);
    }

    std::unique_ptr<const Cells> cells;
    std::unique_ptr<Law> law;
    CellRotations rotations;
    const bool plane;
    const std::size_t n_nodes;
  };


  enum class BodyOfLaw
  {
    linear,
    quadratic,
    plane_strain,
    axisymmetric
  };


  /** A small box, or a rectangle away from the axis. */
  inline LawOfCells
  body_of_law(const std::string &name, const BodyOfLaw kind, const IsotropicMaterial &material)
  {
    const bool plane = kind == BodyOfLaw::plane_strain || kind == BodyOfLaw::axisymmetric;
    MeshParameters parameters;
    parameters.size             = {1., 1.5, 1.};
    parameters.cubes            = {{2, 2, 1}};
    parameters.rectangle_origin = {2., -1.};
    parameters.rectangle_size   = {1., 1.5};
    parameters.squares          = {{3, 3}};
    SerialMesh mesh             = plane ? rectangle_mesh(parameters) : box_mesh(parameters);
    if (kind == BodyOfLaw::quadratic)
      add_middles(mesh, middle_of_edge);

    std::vector<std::array<double, 3>> positions;
    for (const auto &x : mesh.vertices)
      positions.push_back({{x[0], x[1], x[2]}});
    for (const auto &middle : mesh.middles)
      positions.push_back({{middle.place[0], middle.place[1], middle.place[2]}});
    std::vector<Cell> cells;
    for (const auto &nodes : mesh.cells)
      {
        cells.push_back({nodes, material, true});
        for (unsigned int e = 0; e < 6 && kind == BodyOfLaw::quadratic; ++e)
          cells.back().middles[e] =
            mesh.vertices.size() +
            mesh.middle(nodes[tetrahedron_edges[e][0]], nodes[tetrahedron_edges[e][1]]);
      }
    Section section;
    if (plane)
      section.geometry =
        kind == BodyOfLaw::plane_strain ? Geometry::plane_strain : Geometry::axisymmetric;
    return LawOfCells(name, positions, cells, section, kind == BodyOfLaw::quadratic);
  }
} // namespace Supple

#endif
