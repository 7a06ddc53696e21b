#include <supple/mesh/vtk_grid.h>

#include <supple/base/error.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace Supple
{
  namespace
  {
    /** Of cells: which simplex it is, or what else. */
    struct Kind
    {
      unsigned int dimension;
      unsigned int n_vertices;
      std::string other;
    };

    constexpr int triangle_6 = 22, tetrahedron_10 = 24;

    const std::map<int, Kind> kinds = {{3, {1, 2, ""}},
                                       {4, {1, 0, "Polyline"}},
                                       {5, {2, 3, ""}},
                                       {6, {2, 0, "Triangle strip"}},
                                       {7, {2, 0, "Polygon"}},
                                       {8, {2, 4, "Pixel"}},
                                       {9, {2, 4, "Quadrilateral 4"}},
                                       {10, {3, 4, ""}},
                                       {11, {3, 8, "Voxel"}},
                                       {12, {3, 8, "Hexahedron 8"}},
                                       {13, {3, 6, "Prism 6"}},
                                       {14, {3, 5, "Pyramid 5"}},
                                       {21, {1, 3, "Line 3"}},
                                       {22, {2, 6, "Triangle 6"}},
                                       {23, {2, 8, "Quadrilateral 8"}},
                                       {24, {3, 10, "Tetrahedron 10"}},
                                       {25, {3, 20, "Hexahedron 20"}},
                                       {26, {3, 15, "Prism 15"}},
                                       {27, {3, 13, "Pyramid 13"}},
                                       {28, {2, 9, "Quadrilateral 9"}},
                                       {29, {3, 27, "Hexahedron 27"}},
                                       {30, {2, 6, "Quadrilateral 6"}},
                                       {34, {2, 7, "Triangle 7"}},
                                       {35, {1, 4, "Line 4"}},
                                       {36, {2, 0, "Polygon of second order"}},
                                       {42, {3, 0, "Polyhedron"}},
                                       {68, {1, 0, "Lagrange line"}},
                                       {69, {2, 0, "Lagrange triangle"}},
                                       {70, {2, 0, "Lagrange quadrilateral"}},
                                       {71, {3, 0, "Lagrange tetrahedron"}},
                                       {72, {3, 0, "Lagrange hexahedron"}},
                                       {73, {3, 0, "Lagrange prism"}},
                                       {75, {1, 0, "Bezier line"}},
                                       {76, {2, 0, "Bezier triangle"}},
                                       {77, {2, 0, "Bezier quadrilateral"}}};


    /** Names of fields of cells that programs write ids in, in small letters. */
    const std::vector<std::string> id_names = {
      "medit",        "medit:ref",   "gmsh:physical",   "cellentityids", "material",
      "materials",    "materialid",  "materialids",     "material_id",   "material_ids",
      "physical",     "physicalids", "region",          "regionid",      "cell_tags",
      "nastran:ref",  "tetgen:ref",  "avsucd:material", "mat_id",        "attribute",
      "subdomain_id", "geometryids", "elementblockids", "objectid"};


    std::string
    small_letters(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), [](const unsigned char letter) {
        return std::tolower(letter);
      });
      return text;
    }


    bool
    whole(const std::vector<double> &values)
    {
      return std::all_of(values.begin(), values.end(), [](const double value) {
        return std::abs(value) < 1e9 && value == std::floor(value);
      });
    }


    /** Makes elements of a grid. */
    class Elements
    {
    public:
      FileMesh mesh;

      explicit Elements(const VtkGrid &grid)
        : grid(grid)
      {
        const std::size_t n_cells = grid.offsets.empty() ? 0 : grid.offsets.size() - 1;
        if (grid.kinds.size() != n_cells)
          throw InputError("there are " + std::to_string(grid.kinds.size()) +
                           " kinds of cells for " + std::to_string(n_cells) + " cells.");
        for (std::size_t v = 0; v < grid.points.size(); ++v)
          mesh.vertices.emplace_hint(mesh.vertices.end(), v, grid.points[v]);
        find_fields(n_cells);
        for (std::size_t c = 0; c < n_cells; ++c)
          add(c);
        warn();
      }

    private:
      const VtkGrid &grid;
      const VtkGrid::Field *ids    = nullptr;
      const VtkGrid::Field *ghosts = nullptr;
      std::size_t n_ghosts = 0, n_negative = 0;

      static bool
      is_ghost_field(const VtkGrid::Field &field)
      {
        const std::string small = small_letters(field.name);
        return small == "vtkghosttype" || small == "vtkghostlevels";
      }

      static std::size_t
      rank_of(const VtkGrid::Field &field)
      {
        return std::find(id_names.begin(), id_names.end(), small_letters(field.name)) -
               id_names.begin();
      }

      void
      find_fields(const std::size_t n_cells)
      {
        std::string names;
        for (const VtkGrid::Field &field : grid.fields)
          {
            if (field.values.size() != n_cells * field.n_columns)
              throw InputError("the field " + field.name + " has " +
                               std::to_string(field.values.size()) + " values for " +
                               std::to_string(n_cells) + " cells.");
            if (is_ghost_field(field))
              ghosts = &field;
            else
              names += (names.empty() ? "" : ", ") + field.name;
          }
        choose_ids();
        if (!ids && !names.empty())
          mesh.warnings.push_back("Of the fields of cells (" + names +
                                  ") none has the name of ids, such as MaterialIds; all cells "
                                  "have the material id 0.");
      }

      /** The field of ids is the one that has the likeliest name, of those that are not all 0. */
      void
      choose_ids()
      {
        std::vector<const VtkGrid::Field *> possible;
        for (const VtkGrid::Field &field : grid.fields)
          if (rank_of(field) == id_names.size() || field.n_columns != 1)
            continue;
          else if (whole(field.values))
            possible.push_back(&field);
          else
            mesh.warnings.push_back("The field " + field.name +
                                    " has values that are no ids; it is not read.");
        std::stable_sort(possible.begin(), possible.end(), [](const auto *a, const auto *b) {
          return rank_of(*a) < rank_of(*b);
        });
        std::stable_partition(possible.begin(), possible.end(), has_ids);
        if (possible.empty())
          return;
        ids = possible[0];
        std::string others;
        for (std::size_t i = 1; i < possible.size() && has_ids(possible[i]); ++i)
          if (possible[i]->values != ids->values)
            others += (others.empty() ? "" : ", ") + possible[i]->name;
        if (!others.empty())
          mesh.warnings.push_back("Several fields of cells could be the ids: " + ids->name +
                                  " is taken, not " + others + ".");
      }

      static bool
      has_ids(const VtkGrid::Field *field)
      {
        return std::any_of(field->values.begin(), field->values.end(), [](const double value) {
          return value != 0.;
        });
      }

      bool
      is_ghost(const std::size_t c) const
      {
        // Of vtkGhostType the first bit marks copies; vtkGhostLevels counts layers of them.
        return ghosts && (small_letters(ghosts->name) == "vtkghostlevels"
                            ? ghosts->values[c] > 0.
                            : std::fmod(ghosts->values[c], 2.) != 0.);
      }

      void
      add(const std::size_t c)
      {
        const int number = grid.kinds[c];
        if (number >= 0 && number <= 2) // none, a vertex, vertices
          return;
        if (is_ghost(c))
          {
            ++n_ghosts;
            return;
          }
        const auto found = kinds.find(number);
        if (found == kinds.end())
          ++mesh.others[3]["number " + std::to_string(number)];
        else if (!found->second.other.empty() && number != triangle_6 && number != tetrahedron_10)
          ++mesh.others[found->second.dimension][found->second.other];
        else
          add_simplex(c, found->second);
      }

      void
      add_simplex(const std::size_t c, const Kind &kind)
      {
        const double begin = grid.offsets[c];
        if (grid.offsets[c + 1] - begin != kind.n_vertices || !(begin >= 0.) ||
            grid.offsets[c + 1] > grid.connectivity.size())
          throw InputError("the cell " + std::to_string(c) + " has not " +
                           std::to_string(kind.n_vertices) + " vertices.");
        FileMesh::Element element{c, {}, {}};
        std::vector<std::size_t> nodes;
        for (unsigned int v = 0; v < kind.n_vertices; ++v)
          {
            const double vertex = grid.connectivity[static_cast<std::size_t>(begin) + v];
            if (!(vertex >= 0. && vertex < grid.points.size()))
              throw InputError("the cell " + std::to_string(c) + " has the vertex " +
                               std::to_string(std::lround(vertex)) + ", but there are only " +
                               std::to_string(grid.points.size()) + ".");
            nodes.push_back(vertex);
          }
        if (ids && ids->values[c] > 0.)
          element.ids.push_back(ids->values[c]);
        n_negative += ids && ids->values[c] < 0.;
        if (!kind.other.empty())
          {
            add_quadratic(mesh, element, nodes, NodeOrder::vtk);
            return;
          }
        std::copy(nodes.begin(), nodes.end(), element.vertices.begin());
        mesh.elements[kind.dimension].push_back(element);
      }

      void
      warn()
      {
        if (n_negative > 0)
          mesh.warnings.push_back(std::to_string(n_negative) +
                                  " element(s) have a negative id in the field " + ids->name +
                                  "; they get the id 0.");
        if (n_ghosts > 0)
          mesh.warnings.push_back(std::to_string(n_ghosts) +
                                  " ghost cell(s), copies of cells of other parts, are not read (" +
                                  ghosts->name + ").");
      }
    };
  } // namespace


  FileMesh
  mesh_of(const VtkGrid &grid)
  {
    return Elements(grid).mesh;
  }
} // namespace Supple
