#include <supple/mesh/mesh_check.h>

#include <supple/base/error.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <sstream>

namespace Supple
{
  using dealii::BoundingBox;
  using dealii::Point;

  namespace
  {
    using Face = std::array<unsigned int, 3>;

    constexpr unsigned int nothing = dealii::numbers::invalid_unsigned_int;

    /** An edge has nothing in the third place. */
    Face
    sorted(Face face)
    {
      std::sort(face.begin(), face.end());
      return face;
    }


    Point<3>
    centre(const SerialMesh &mesh, const std::size_t cell)
    {
      Point<3> sum;
      for (const unsigned int vertex : mesh.cell_vertices(cell))
        sum += mesh.vertices[vertex] / (mesh.dimension + 1.);
      return sum;
    }


    std::string
    place(const SerialMesh &mesh, const std::size_t cell)
    {
      std::ostringstream text;
      const Point<3> x = centre(mesh, cell);
      text << "cell " << cell << " at (" << x[0] << ", " << x[1] << ", " << x[2] << ")";
      return text.str();
    }


    void
    check_cells(SerialMesh &mesh, const std::string &origin, MeshReport &report)
    {
      std::vector<std::size_t> flat;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          for (const unsigned int vertex : mesh.cell_vertices(c))
            if (vertex >= mesh.vertices.size())
              throw InputError(origin + ": cell " + std::to_string(c) + " has the vertex " +
                               std::to_string(vertex) + ", but there are only " +
                               std::to_string(mesh.vertices.size()) + ".");
          if (mesh.volume(c) < 0.)
            {
              std::swap(mesh.cells[c][1], mesh.cells[c][2]);
              ++report.repaired;
            }
          const double q = quality(mesh, c);
          if (!(q > 1e-6))
            flat.push_back(c);
          if (q < 0.1)
            ++report.slivers;
          if (c == 0 || q < report.worst_quality)
            {
              report.worst_quality  = q;
              report.worst_cell     = c;
              report.worst_position = centre(mesh, c);
            }
        }
      if (!flat.empty())
        throw InputError(origin + ": " + std::to_string(flat.size()) +
                         " cell(s) are flat, that is without " +
                         (mesh.dimension == 3 ? "volume" : "area") + "; the first is " +
                         place(mesh, flat[0]) + ". Mesh the body again, or optimize the mesh.");
    }


    /** Faces that one cell alone has.
     * @throws InputError where a face has more than two */
    std::vector<SerialMesh::CellFace>
    outer_faces(const SerialMesh &mesh,
                const std::vector<SerialMesh::CellFace> &faces,
                const std::string &origin)
    {
      std::vector<SerialMesh::CellFace> outer;
      unsigned int third_cell = nothing;
      for (std::size_t i = 0, end = 0; i < faces.size(); i = end)
        {
          while (end < faces.size() && faces[end].vertices == faces[i].vertices)
            ++end;
          if (end - i == 1)
            outer.push_back(faces[i]);
          else if (end - i > 2)
            third_cell = std::min(third_cell, faces[i + 2].cell);
        }
      if (third_cell != nothing)
        throw InputError(origin + ": a face has three cells or more; one of them is " +
                         place(mesh, third_cell) + ". Cells overlap there, or are given twice.");
      return outer;
    }


    /** What the user says of faces, those of the surface alone; the rest gives warnings. */
    std::map<Face, unsigned int>
    given_ids(const SerialMesh &mesh,
              const std::vector<SerialMesh::CellFace> &faces,
              MeshReport &report)
    {
      std::map<Face, unsigned int> given;
      std::set<Face> inside, twice, strange; // a face may be there several times
      for (const auto &face : mesh.boundary)
        {
          const Face key   = sorted(face.vertices);
          const auto found = std::lower_bound(faces.begin(),
                                              faces.end(),
                                              key,
                                              [](const SerialMesh::CellFace &a, const Face &b) {
                                                return a.vertices < b;
                                              });
          if (found == faces.end() || found->vertices != key)
            strange.insert(key);
          else if (found + 1 != faces.end() && (found + 1)->vertices == key)
            inside.insert(key);
          else if (!given.emplace(key, face.boundary_id).second && given[key] != face.boundary_id)
            twice.insert(key);
        }
      const auto warn = [&](const std::set<Face> &of, const std::string &text) {
        if (!of.empty())
          report.warnings.push_back(std::to_string(of.size()) + " " + text);
      };
      const std::string kind = mesh.dimension == 3 ? "triangle(s)" : "edge(s)";
      warn(inside, kind + " of groups lie inside the body and are not used.");
      warn(twice, kind + " belong to several groups; the least id counts.");
      warn(strange, kind + " are no face of a cell and are not used.");
      return given;
    }


    /** Sorts out which faces are the boundary and what id each has. */
    void
    check_faces(SerialMesh &mesh,
                const std::vector<SerialMesh::CellFace> &faces,
                const std::string &origin,
                MeshReport &report)
    {
      std::vector<SerialMesh::CellFace> outer  = outer_faces(mesh, faces, origin);
      const std::map<Face, unsigned int> given = given_ids(mesh, faces, report);

      std::stable_sort(outer.begin(), outer.end(), [](const auto &a, const auto &b) {
        return a.cell < b.cell;
      });
      mesh.boundary.clear();
      for (const SerialMesh::CellFace &face : outer)
        {
          const auto found = given.find(face.vertices);
          mesh.boundary.push_back(
            {face.vertices, found == given.end() ? 0 : found->second, face.cell});
        }
    }


    /** Sets n_cells and box of sets of cells; @param set of each cell */
    template <class Set>
    void
    measure(const SerialMesh &mesh, const std::vector<unsigned int> &set, std::vector<Set> &sets)
    {
      std::vector<std::pair<Point<3>, Point<3>>> corners(sets.size());
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          auto &[low, high] = corners[set[c]];
          if (sets[set[c]].n_cells++ == 0)
            low = high = mesh.vertices[mesh.cells[c][0]];
          for (const unsigned int vertex : mesh.cell_vertices(c))
            for (unsigned int d = 0; d < 3; ++d)
              {
                low[d]  = std::min(low[d], mesh.vertices[vertex][d]);
                high[d] = std::max(high[d], mesh.vertices[vertex][d]);
              }
        }
      for (std::size_t s = 0; s < sets.size(); ++s)
        sets[s].box = BoundingBox<3>(corners[s]);
    }


    /** Numbers of things that are joined two by two. */
    class Union
    {
    public:
      explicit Union(const std::size_t n)
        : root(n)
      {
        std::iota(root.begin(), root.end(), 0u);
      }

      unsigned int
      find(unsigned int i)
      {
        while (root[i] != i)
          i = root[i] = root[root[i]];
        return i;
      }

      void
      join(const unsigned int i, const unsigned int j)
      {
        root[find(i)] = find(j);
      }

    private:
      std::vector<unsigned int> root;
    };


    /** Sets the pieces, in the order of their first vertices. @return that of each cell */
    std::vector<unsigned int>
    find_pieces(const SerialMesh &mesh, MeshReport &report)
    {
      Union joined(mesh.vertices.size());
      std::vector<bool> used(mesh.vertices.size());
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (const unsigned int vertex : mesh.cell_vertices(c))
          {
            used[vertex] = true;
            joined.join(vertex, mesh.cells[c][0]);
          }
      std::map<unsigned int, unsigned int> number;
      for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
        if (used[v])
          number.emplace(joined.find(v), number.size());
        else
          ++report.unused_vertices;
      std::vector<unsigned int> piece;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        piece.push_back(number.at(joined.find(mesh.cells[c][0])));
      report.pieces.resize(number.size());
      measure(mesh, piece, report.pieces);
      return piece;
    }


    /** Sets the parts and their joints, and the part of each vertex. */
    void
    find_parts(SerialMesh &mesh, const std::vector<SerialMesh::CellFace> &faces, MeshReport &report)
    {
      const std::vector<unsigned int> piece = find_pieces(mesh, report);
      Union joined(mesh.cells.size());
      for (std::size_t f = 1; f < faces.size(); ++f)
        if (faces[f].vertices == faces[f - 1].vertices)
          joined.join(faces[f].cell, faces[f - 1].cell);

      std::map<unsigned int, unsigned int> number;
      std::vector<unsigned int> part;
      std::map<unsigned int, std::set<unsigned int>> shared;
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          part.push_back(number.emplace(joined.find(c), number.size()).first->second);
          report.parts.resize(number.size());
          report.parts[part[c]].piece = piece[c];
        }
      measure(mesh, part, report.parts);

      mesh.parts.assign(mesh.vertices.size(), nothing);
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (const unsigned int v : mesh.cell_vertices(c))
          if (mesh.parts[v] == nothing)
            mesh.parts[v] = part[c];
          else if (mesh.parts[v] != part[c])
            shared[v].insert(part[c]);
      for (const auto &[v, others] : shared)
        {
          report.joints.push_back({mesh.vertices[v], {mesh.parts[v]}});
          auto &parts = report.joints.back().parts;
          parts.insert(parts.end(), others.begin(), others.end());
        }
      std::replace(mesh.parts.begin(),
                   mesh.parts.end(),
                   nothing,
                   static_cast<unsigned int>(report.parts.size()));
    }


    void
    count_double_vertices(const SerialMesh &mesh, MeshReport &report)
    {
      double size = 0.;
      for (const auto &piece : report.pieces)
        size = std::max(size,
                        piece.box.get_boundary_points().first.distance(
                          piece.box.get_boundary_points().second));
      std::vector<std::array<long long, 3>> places;
      for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
        if (mesh.parts[v] < report.parts.size())
          {
            places.emplace_back();
            for (unsigned int d = 0; d < 3; ++d)
              places.back()[d] = std::llround(mesh.vertices[v][d] / (1e-9 * size));
          }
      std::sort(places.begin(), places.end());
      for (std::size_t i = 1; i < places.size(); ++i)
        report.double_vertices += places[i] == places[i - 1];
    }


    /** Programs that draw use single precision, whatever is in the file. */
    void
    warn_of_distance(MeshReport &report)
    {
      double far = 0., size = 0.;
      for (const auto &piece : report.pieces)
        {
          const auto &corners = piece.box.get_boundary_points();
          size                = std::max(size, corners.first.distance(corners.second));
          far                 = std::max({far, corners.first.norm(), corners.second.norm()});
        }
      const double step = far * std::numeric_limits<float>::epsilon();
      if (step < 1e-3 * size)
        return;
      std::ostringstream text;
      text << "The body is " << far
           << " m from the origin. In single precision, in which frames are "
           << "drawn, places there are " << step
           << " m apart: smaller motions can't be seen. Put the "
           << "origin near the body.";
      report.warnings.push_back(text.str());
    }
  } // namespace


  std::string
  extent_in_words(const BoundingBox<3> &box, const unsigned int dimension)
  {
    std::ostringstream text;
    for (unsigned int d = 0; d < dimension; ++d)
      {
        // As many digits as show the length of the box, however far from the origin it is.
        const double low = box.lower_bound(d), high = box.upper_bound(d);
        const double ratio = std::max(std::abs(low), std::abs(high)) / (high - low);
        text.precision(ratio > 100. && std::isfinite(ratio)
                         ? std::min(4 + static_cast<int>(std::ceil(std::log10(ratio))), 17)
                         : 6);
        text << (d == 0 ? "[" : " x [") << low << ", " << high << "]";
      }
    return text.str();
  }


  double
  quality(const SerialMesh &mesh, const std::size_t cell)
  {
    double squares = 0.;
    for (const unsigned int a : mesh.cell_vertices(cell))
      for (const unsigned int b : mesh.cell_vertices(cell))
        squares += 0.5 * mesh.vertices[a].distance_square(mesh.vertices[b]);
    const double size = std::abs(mesh.volume(cell));
    return (mesh.dimension == 2 ? 4. * std::sqrt(3.) * size : 12. * std::cbrt(9. * size * size)) /
           squares;
  }


  MeshReport
  check_mesh(SerialMesh &mesh, const std::string &origin)
  {
    MeshReport report;
    report.warnings = mesh.warnings;
    check_cells(mesh, origin, report);
    const std::vector<SerialMesh::CellFace> faces = mesh.sorted_faces();
    check_faces(mesh, faces, origin, report);
    find_parts(mesh, faces, report);
    count_double_vertices(mesh, report);

    warn_of_distance(report);
    const auto warn = [&](const bool wrong, const std::string &text) {
      if (wrong)
        report.warnings.push_back(text);
    };
    warn(report.repaired > 0,
         std::to_string(report.repaired) + " inverted cell(s) were reoriented.");
    warn(report.slivers > 0,
         std::to_string(report.slivers) +
           " cell(s) are slivers of a quality below 0.1; the worst is " +
           place(mesh, report.worst_cell) + ".");
    warn(report.unused_vertices > 0,
         std::to_string(report.unused_vertices) +
           (report.unused_vertices == 1 ? " vertex is" : " vertices are") + " in no cell.");
    warn(report.double_vertices > 0,
         std::to_string(report.double_vertices) +
           (report.double_vertices == 1 ? " vertex lies" : " vertices lie") +
           " at the place of another one: the body may be cut open there.");
    warn(report.pieces.size() > 1,
         "The body is in " + std::to_string(report.pieces.size()) +
           " pieces that do not hang together.");
    return report;
  }


  void
  fit_to_axis(SerialMesh &mesh, const std::string &origin)
  {
    double width = 0., smallest = 0.;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (const unsigned int v : mesh.cell_vertices(c))
        {
          width    = std::max(width, mesh.vertices[v][0]);
          smallest = std::min(smallest, mesh.vertices[v][0]);
        }
    if (smallest < -1e-9 * width || width <= 0.)
      {
        std::ostringstream text;
        text << origin
             << ": the body is axisymmetric, and x is the distance from the axis; it can't be "
                "negative. The smallest one is "
             << smallest << " m.";
        throw InputError(text.str());
      }
    for (auto &vertex : mesh.vertices)
      if (std::abs(vertex[0]) <= 1e-9 * width)
        vertex[0] = 0.;
  }
} // namespace Supple
