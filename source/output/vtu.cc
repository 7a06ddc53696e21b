#include <supple/output/vtu.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/grid/reference_cell.h>

#include <sstream>
#include <tuple>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    using Component = DataComponentInterpretation::DataComponentInterpretation;


    /** The vectors of nodes, with their names in the file. */
    std::vector<std::pair<std::string, const Vector *>>
    node_fields(const Drawing &drawing)
    {
      std::vector<std::pair<std::string, const Vector *>> fields = {
        {"displacement", &drawing.displacement}};
      if (drawing.velocity)
        fields.emplace_back("velocity", drawing.velocity);
      return fields;
    }


    /** The cells of this process, each with points and values of its own, as deal.II writes them.
     */
    template <int dim>
    std::vector<DataOutBase::Patch<dim, 3>>
    pieces(const DistributedMesh &mesh, const Drawing &drawing)
    {
      const auto of_nodes        = node_fields(drawing);
      const auto of_cells        = drawing.cells.named();
      const std::size_t n_values = 3 * of_nodes.size() + of_cells.size();
      std::vector<DataOutBase::Patch<dim, 3>> pieces;
      for (const LocalCell &cell : mesh.cells)
        {
          if (!cell.owned)
            continue;
          pieces.emplace_back();
          auto &piece          = pieces.back();
          piece.patch_index    = pieces.size() - 1;
          piece.n_subdivisions = 1;
          piece.reference_cell = ReferenceCells::get_simplex<dim>();
          piece.data.reinit(n_values, dim + 1);
          for (unsigned int a = 0; a <= dim; ++a)
            {
              const std::size_t first = 3 * std::size_t(cell.nodes[a]);
              for (unsigned int i = 0; i < 3; ++i)
                piece.vertices[a][i] = drawing.positions.local_element(first + i);
              unsigned int value = 0;
              for (const auto &field : of_nodes)
                for (unsigned int i = 0; i < 3; ++i)
                  piece.data(value++, a) = field.second->local_element(first + i);
              for (const auto &field : of_cells)
                piece.data(value++, a) = (*field.second)[cell.index];
            }
        }
      return pieces;
    }
  } // namespace


  std::pair<std::string, std::string>
  draw(const DistributedMesh &mesh, const Drawing &drawing, const std::vector<std::string> &names)
  {
    std::vector<std::string> names_of_values;
    std::vector<std::tuple<unsigned int, unsigned int, std::string, Component>> vectors;
    for (const auto &field : node_fields(drawing))
      {
        const unsigned int first = names_of_values.size();
        vectors.emplace_back(first,
                             first + 2,
                             field.first,
                             DataComponentInterpretation::component_is_part_of_vector);
        names_of_values.insert(names_of_values.end(), 3, field.first);
      }
    for (const auto &field : drawing.cells.named())
      names_of_values.push_back(field.first);

    DataOutBase::VtkFlags flags(drawing.time, drawing.step);
    flags.compression_level = DataOutBase::VtkFlags::best_speed;
    std::ostringstream part, record;
    if (mesh.dimension == 2)
      DataOutBase::write_vtu(pieces<2>(mesh, drawing), names_of_values, vectors, flags, part);
    else
      DataOutBase::write_vtu(pieces<3>(mesh, drawing), names_of_values, vectors, flags, part);
    DataOutBase::write_pvtu_record(record, names, names_of_values, vectors, flags);
    return {part.str(), record.str()};
  }
} // namespace Supple
