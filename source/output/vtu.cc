#include <supple/output/vtu.h>

namespace Supple
{
  Vtu::Vtu(const DistributedMesh &mesh)
    : mesh(mesh)
    , piece(make_piece())
  {
  }


  VtuPiece
  Vtu::make_piece()
  {
    const bool plane = mesh.dimension == 2;
    VtuCells grid{plane ? 5u : 10u, mesh.dimension + 1, {}};
    if (mesh.is_quadratic())
      grid = {24u, 10u, {}};
    std::vector<bool> is_drawn(mesh.n_local, false);
    std::vector<std::int32_t> material;
    for (const LocalCell &cell : mesh.cells)
      if (cell.owned)
        {
          cells.push_back(cell.index);
          material.push_back(cell.material_id);
          for (unsigned int a = 0; a < grid.points_per_cell; ++a)
            is_drawn[node_of(cell, a)] = true;
        }

    std::vector<unsigned int> point_of(mesh.n_local);
    for (unsigned int node = 0; node < mesh.n_local; ++node)
      if (is_drawn[node])
        {
          point_of[node] = nodes.size();
          nodes.push_back(node);
        }
    for (const LocalCell &cell : mesh.cells)
      if (cell.owned)
        for (unsigned int a = 0; a < grid.points_per_cell; ++a)
          grid.points.push_back(point_of[node_of(cell, a)]);
    return VtuPiece(grid, {{"material", &material}});
  }


  unsigned int
  Vtu::node_of(const LocalCell &cell, const unsigned int a) const
  {
    // Places in tetrahedron_edges of 01, 12, 02, 03, 13, 23.
    constexpr std::array<unsigned int, 6> order = {{0, 3, 1, 2, 4, 5}};
    return a < 4 ? cell.nodes[a] : mesh.cell_middles[cell.index][order[a - 4]];
  }


  std::vector<float>
  Vtu::at_points(const Vector &vector) const
  {
    const GhostValues values(vector);
    std::vector<float> at_points(3 * nodes.size());
    for (std::size_t point = 0; point < nodes.size(); ++point)
      for (unsigned int i = 0; i < 3; ++i)
        at_points[3 * point + i] = values.data()[3 * std::size_t(nodes[point]) + i];
    return at_points;
  }


  std::vector<float>
  Vtu::of_cells(const std::vector<float> &values) const
  {
    std::vector<float> of_cells(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c)
      of_cells[c] = values[cells[c]];
    return of_cells;
  }


  std::pair<std::string, std::string>
  Vtu::draw(const Drawing &drawing, const std::vector<std::string> &names) const
  {
    std::vector<double> points(3 * nodes.size());
    {
      const GhostValues u(drawing.displacement);
      for (std::size_t point = 0; point < nodes.size(); ++point)
        for (unsigned int i = 0; i < 3; ++i)
          points[3 * point + i] =
            mesh.positions[nodes[point]][i] + u.data()[3 * std::size_t(nodes[point]) + i];
    }
    const std::vector<float> displacement = at_points(drawing.displacement);
    VtuPiece::Instant now{
      drawing.time, drawing.step, points, {{"displacement", 3, &displacement}}, {}};
    std::vector<float> velocity;
    if (drawing.velocity)
      {
        velocity = at_points(*drawing.velocity);
        now.of_points.push_back({"velocity", 3, &velocity});
      }
    std::vector<float> pressure;
    if (drawing.contact_pressure)
      {
        for (const std::vector<float> numbers = at_points(*drawing.contact_pressure);
             pressure.size() < nodes.size();)
          pressure.push_back(numbers[3 * pressure.size()]);
        now.of_points.push_back({"contact_pressure", 1, &pressure});
      }
    std::vector<std::vector<float>> fields;
    const auto named = drawing.cells.named();
    fields.reserve(named.size() + 1);
    for (const auto &[name, values] : named)
      {
        fields.push_back(of_cells(*values));
        now.of_cells.push_back({name, 1, &fields.back()});
      }
    if (drawing.error_in_space)
      {
        fields.push_back(of_cells(*drawing.error_in_space));
        now.of_cells.push_back({"error_in_space", 1, &fields.back()});
      }
    return {piece.file(now), piece.record(now, names)};
  }
} // namespace Supple
