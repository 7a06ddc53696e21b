#include <supple/mesh/mesh_check.h>

#include <supple/base/error.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
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
      unsigned int inside = 0, twice = 0, strange = 0;
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
            ++strange;
          else if (found + 1 != faces.end() && (found + 1)->vertices == key)
            ++inside;
          else if (!given.emplace(key, face.boundary_id).second && given[key] != face.boundary_id)
            ++twice;
        }
      const auto warn = [&](const unsigned int n, const std::string &text) {
        if (n > 0)
          report.warnings.push_back(std::to_string(n) + " " + text);
      };
      const std::string kind   = mesh.dimension == 3 ? "triangle(s)" : "edge(s)";
      const std::string groups = mesh.dimension == 3 ? "physical surfaces" : "physical curves";
      warn(inside, kind + " of " + groups + " lie inside the body and are not used.");
      warn(twice, kind + " belong to two " + groups + "; the first one counts.");
      warn(strange, kind + " are no face of a cell and are not used.");
      return given;
    }


    /** Sorts out which faces are the boundary and what id each has. */
    void
    check_faces(SerialMesh &mesh, const std::string &origin, MeshReport &report)
    {
      const std::vector<SerialMesh::CellFace> faces = mesh.sorted_faces();
      std::vector<SerialMesh::CellFace> outer       = outer_faces(mesh, faces, origin);
      const std::map<Face, unsigned int> given      = given_ids(mesh, faces, report);

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


    void
    measure_pieces(const SerialMesh &mesh, const unsigned int n_pieces, MeshReport &report)
    {
      report.pieces.resize(n_pieces);
      std::vector<std::pair<Point<3>, Point<3>>> corners(n_pieces);
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        {
          const unsigned int piece = mesh.pieces[mesh.cells[c][0]];
          auto &[low, high]        = corners[piece];
          if (report.pieces[piece].n_cells++ == 0)
            low = high = mesh.vertices[mesh.cells[c][0]];
          for (const unsigned int vertex : mesh.cell_vertices(c))
            for (unsigned int d = 0; d < 3; ++d)
              {
                low[d]  = std::min(low[d], mesh.vertices[vertex][d]);
                high[d] = std::max(high[d], mesh.vertices[vertex][d]);
              }
        }
      for (unsigned int piece = 0; piece < n_pieces; ++piece)
        report.pieces[piece].box = BoundingBox<3>(corners[piece]);
    }


    void
    find_pieces(SerialMesh &mesh, MeshReport &report)
    {
      std::vector<unsigned int> root(mesh.vertices.size());
      std::iota(root.begin(), root.end(), 0u);
      const auto find = [&](unsigned int v) {
        while (root[v] != v)
          v = root[v] = root[root[v]];
        return v;
      };
      std::vector<bool> used(mesh.vertices.size());
      for (std::size_t c = 0; c < mesh.cells.size(); ++c)
        for (const unsigned int vertex : mesh.cell_vertices(c))
          {
            used[vertex]       = true;
            root[find(vertex)] = find(mesh.cells[c][0]);
          }

      std::map<unsigned int, unsigned int> number;
      mesh.pieces.resize(mesh.vertices.size());
      for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
        if (used[v])
          mesh.pieces[v] = number.emplace(find(v), number.size()).first->second;
        else
          ++report.unused_vertices;
      for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
        if (!used[v])
          mesh.pieces[v] = number.size();
      measure_pieces(mesh, number.size(), report);
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
        if (mesh.pieces[v] < report.pieces.size())
          {
            places.emplace_back();
            for (unsigned int d = 0; d < 3; ++d)
              places.back()[d] = std::llround(mesh.vertices[v][d] / (1e-9 * size));
          }
      std::sort(places.begin(), places.end());
      for (std::size_t i = 1; i < places.size(); ++i)
        report.double_vertices += places[i] == places[i - 1];
    }
  } // namespace


  std::string
  extent_in_words(const BoundingBox<3> &box, const unsigned int dimension)
  {
    std::ostringstream text;
    for (unsigned int d = 0; d < dimension; ++d)
      text << (d == 0 ? "[" : " x [") << box.lower_bound(d) << ", " << box.upper_bound(d) << "]";
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
    check_cells(mesh, origin, report);
    check_faces(mesh, origin, report);
    find_pieces(mesh, report);
    count_double_vertices(mesh, report);

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
         std::to_string(report.unused_vertices) + " vertices are in no cell.");
    warn(report.double_vertices > 0,
         std::to_string(report.double_vertices) +
           " vertices lie at the place of another one: the body may be cut open there.");
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
