#include <supple/mesh/bisection.h>

#include <algorithm>
#include <numeric>

namespace Supple
{
  using dealii::Point;

  namespace
  {
    constexpr std::array<std::array<unsigned int, 2>, 6> pairs = {
      {{{0, 1}}, {{0, 2}}, {{1, 2}}, {{0, 3}}, {{1, 3}}, {{2, 3}}}};
    using Corners                          = std::array<unsigned int, 4>;
    constexpr unsigned int none            = dealii::numbers::invalid_unsigned_int;
    constexpr Corners all_corners          = {{0, 1, 2, 3}};
    constexpr std::array<Corners, 4> faces = {{{{0, 1, 2, none}},
                                               {{0, 1, 3, none}},
                                               {{0, 2, 3, none}},
                                               {{1, 2, 3, none}}}}; // of a tetrahedron


    unsigned int
    n_pairs(const unsigned int n_corners)
    {
      return n_corners * (n_corners - 1) / 2;
    }
  } // namespace


  Bisection::Bisection(const SerialMesh &mesh, const std::vector<Point<3>> &places)
    : mesh(mesh)
    , n_corners(mesh.dimension + 1)
  {
    number_edges();
    rank_edges(places);
    marked.assign(ends.size(), 0);
    middle_of.assign(ends.size(), none);
  }


  void
  Bisection::number_edges()
  {
    ends.reserve(n_pairs(n_corners) * mesh.cells.size());
    for (const auto &cell : mesh.cells)
      for (unsigned int p = 0; p < n_pairs(n_corners); ++p)
        ends.push_back({{std::min(cell[pairs[p][0]], cell[pairs[p][1]]),
                         std::max(cell[pairs[p][0]], cell[pairs[p][1]])}});
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    ends.shrink_to_fit();
    cell_edges.resize(mesh.cells.size());
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int p = 0; p < n_pairs(n_corners); ++p)
        cell_edges[c][p] = edge(mesh.cells[c][pairs[p][0]], mesh.cells[c][pairs[p][1]]);
  }


  void
  Bisection::rank_edges(const std::vector<Point<3>> &places)
  {
    // In single precision, edges that differ by round-off alone are equally long.
    std::vector<float> length;
    length.reserve(ends.size());
    for (const auto &[a, b] : ends)
      length.push_back(places[a].distance_square(places[b]));
    std::vector<unsigned int> order(ends.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(), [&](const unsigned int e, const unsigned int f) {
      return length[e] < length[f];
    });
    rank.resize(ends.size());
    for (unsigned int r = 0; r < order.size(); ++r)
      rank[order[r]] = r;
  }


  unsigned int
  Bisection::edge(const unsigned int a, const unsigned int b) const
  {
    const std::array<unsigned int, 2> key = {{std::min(a, b), std::max(a, b)}};
    const auto found                      = std::lower_bound(ends.begin(), ends.end(), key);
    return found != ends.end() && *found == key ? found - ends.begin() : none;
  }


  Bisection::EdgeTable
  Bisection::edges_of_cell(const std::size_t cell) const
  {
    EdgeTable table;
    for (unsigned int p = 0; p < n_pairs(n_corners); ++p)
      table[pairs[p][0]][pairs[p][1]] = table[pairs[p][1]][pairs[p][0]] = cell_edges[cell][p];
    return table;
  }


  Bisection::EdgeTable
  Bisection::edges_of_face(const SerialMesh::BoundaryFace &face) const
  {
    EdgeTable table;
    for (unsigned int p = 0; p < n_pairs(mesh.dimension); ++p)
      table[pairs[p][0]][pairs[p][1]] = table[pairs[p][1]][pairs[p][0]] =
        edge(face.vertices[pairs[p][0]], face.vertices[pairs[p][1]]);
    return table;
  }


  unsigned int
  Bisection::longest(const EdgeTable &edges,
                     const std::array<unsigned int, 4> &corners,
                     const unsigned int n,
                     const bool only_marked) const
  {
    unsigned int best = none;
    for (unsigned int p = 0; p < n_pairs(n); ++p)
      {
        const unsigned int i = corners[pairs[p][0]], j = corners[pairs[p][1]];
        if (i == none || j == none)
          continue;
        const unsigned int e = edges[i][j];
        if (e != none && (!only_marked || marked[e]) && (best == none || rank[e] > rank[best]))
          best = e;
      }
    return best;
  }


  void
  Bisection::mark_longest(const std::size_t cell)
  {
    marked[longest(edges_of_cell(cell), all_corners, n_corners, false)] = 1;
  }


  void
  Bisection::mark(const std::size_t cell)
  {
    const EdgeTable edges = edges_of_cell(cell);
    mark_longest(cell);
    if (mesh.dimension == 3)
      for (const Corners &face : faces)
        marked[longest(edges, face, 3, false)] = 1;
  }


  void
  Bisection::mark_all(const std::size_t cell)
  {
    for (unsigned int p = 0; p < n_pairs(n_corners); ++p)
      marked[cell_edges[cell][p]] = 1;
  }


  bool
  Bisection::close(const std::size_t cell)
  {
    const EdgeTable edges = edges_of_cell(cell);
    bool more             = false;
    const auto close_one  = [&](const Corners &corners, const unsigned int n) {
      if (longest(edges, corners, n, true) == none)
        return;
      const unsigned int first = longest(edges, corners, n, false);
      more                     = more || !marked[first];
      marked[first]            = 1;
    };
    close_one(all_corners, n_corners);
    if (mesh.dimension == 3)
      for (const Corners &face : faces)
        close_one(face, 3);
    return more;
  }


  void
  Bisection::close()
  {
    bool more = true;
    while (more)
      {
        more = false;
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
          more = close(c) || more;
      }
    middle_of.assign(ends.size(), none);
    unsigned int next = mesh.vertices.size();
    for (std::size_t e = 0; e < ends.size(); ++e)
      if (marked[e])
        middle_of[e] = next++;
  }


  template <class Visit>
  void
  Bisection::cut(const Piece &piece,
                 const unsigned int n,
                 const EdgeTable &edges,
                 const Visit &visit) const
  {
    const unsigned int e = longest(edges, piece.corners, n, true);
    if (e == none)
      return visit(piece.vertices);
    for (const unsigned int end : ends[e])
      {
        Piece half           = piece;
        const auto other     = std::find(piece.vertices.begin(), piece.vertices.end(), end);
        const std::size_t at = other - piece.vertices.begin();
        half.vertices[at]    = middle_of[e];
        half.corners[at]     = none;
        cut(half, n, edges, visit);
      }
  }


  std::size_t
  Bisection::n_cells() const
  {
    std::size_t n = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      cut({mesh.cells[c], all_corners}, n_corners, edges_of_cell(c), [&](const Corners &) { ++n; });
    return n;
  }


  SerialMesh
  Bisection::refined(const Middle &middle) const
  {
    SerialMesh fine;
    fine.dimension      = mesh.dimension;
    fine.vertices       = mesh.vertices;
    fine.material_names = mesh.material_names;
    fine.boundary_names = mesh.boundary_names;
    fine.warnings       = mesh.warnings;
    for (std::size_t e = 0; e < ends.size(); ++e)
      if (marked[e])
        fine.vertices.push_back(middle(mesh.vertices[ends[e][0]], mesh.vertices[ends[e][1]]));
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      cut({mesh.cells[c], all_corners}, n_corners, edges_of_cell(c), [&](const Corners &cell) {
        fine.cells.push_back(cell);
        fine.materials.push_back(mesh.materials[c]);
      });
    for (const SerialMesh::BoundaryFace &face : mesh.boundary)
      {
        Piece whole{{{none, none, none, none}}, all_corners};
        std::copy(face.vertices.begin(), face.vertices.end(), whole.vertices.begin());
        cut(whole, mesh.dimension, edges_of_face(face), [&](const Corners &part) {
          fine.boundary.push_back({{{part[0], part[1], part[2]}}, face.boundary_id});
        });
      }
    return fine;
  }
} // namespace Supple
