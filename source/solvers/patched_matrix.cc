#include <supple/solvers/patched_matrix.h>

#include <algorithm>
#include <array>
#include <utility>

namespace Supple
{
  template <class Visit>
  void
  PatchedMatrix::for_each_pair(const Visit &visit) const
  {
    const VolumetricPatches &patches = *A.patches();
    std::vector<std::pair<unsigned int, std::array<double, 3>>> nodes;
    for (unsigned int p = 0; p < patches.partitioner->size(); ++p)
      {
        nodes.clear();
        patches.for_each_node(p, [&](const unsigned int node, std::array<double, 3> c) {
          for (unsigned int i = 0; i < 3; ++i)
            if (A.constraints.holds(3 * node + i))
              c[i] = 0.;
          nodes.emplace_back(node, c);
        });
        const double factor = A.patch_factor() * patches.stiffness(p);
        for (const auto &[row, of_row] : nodes)
          for (const auto &[column, of_column] : nodes)
            if (row >= column)
              visit(row, column, of_row, of_column, factor);
      }
  }


  SymmetricPattern
  PatchedMatrix::make_pattern() const
  {
    const SymmetricPattern &of_cells = A.matrix().pattern;
    std::vector<std::vector<std::uint32_t>> columns(of_cells.n_owned);
    for (unsigned int row = 0; row < of_cells.n_owned; ++row)
      columns[row].assign(of_cells.column.begin() + of_cells.row_start[row],
                          of_cells.column.begin() + of_cells.row_start[row + 1]);
    for_each_pair([&](const unsigned int row, const unsigned int column, const auto &...) {
      if (row != column)
        columns[row].push_back(column);
    });
    SymmetricPattern whole;
    whole.n_owned = whole.n_local = of_cells.n_owned;
    whole.row_start.push_back(0);
    for (std::vector<std::uint32_t> &row : columns)
      {
        std::sort(row.begin(), row.end());
        whole.column.insert(whole.column.end(), row.begin(), std::unique(row.begin(), row.end()));
        whole.row_start.push_back(whole.column.size());
      }
    return whole;
  }


  PatchedMatrix::PatchedMatrix(const ImplicitOperator &A)
    : A(A)
  {
    if (!A.patches())
      return;
    pattern = make_pattern();
    matrix  = std::make_unique<SymmetricBlockMatrix>(pattern);
    for_each_pair([this](const unsigned int row, const unsigned int column, const auto &...) {
      places.push_back(row == column ? row : pattern.position(row, column));
    });
    const SymmetricPattern &of_cells = A.matrix().pattern;
    for (unsigned int row = 0; row < of_cells.n_owned; ++row)
      for (std::size_t k = of_cells.row_start[row]; k < of_cells.row_start[row + 1]; ++k)
        places_of_cells.push_back(pattern.position(row, of_cells.column[k]));
  }


  void
  PatchedMatrix::update()
  {
    if (!matrix)
      return;
    matrix->set_zero();
    matrix->diagonal = A.matrix().diagonal;
    for (std::size_t k = 0; k < places_of_cells.size(); ++k)
      std::copy_n(&A.matrix().lower[9 * k], 9, &matrix->lower[9 * places_of_cells[k]]);
    auto place = places.begin();
    for_each_pair([&](const unsigned int row,
                      const unsigned int column,
                      const std::array<double, 3> &of_row,
                      const std::array<double, 3> &of_column,
                      const double factor) {
      std::vector<double> &values = row == column ? matrix->diagonal : matrix->lower;
      double *const block         = &values[9 * *place++];
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          block[3 * i + j] += factor * of_row[i] * of_column[j];
    });
  }
} // namespace Supple
