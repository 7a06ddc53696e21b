#include <supple/solvers/implicit_operator.h>

#include <supple/base/memory.h>

#include <deal.II/base/mpi.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace Supple
{
  ImplicitOperator::ImplicitOperator(const Body &body,
                                     const Constraints &constraints,
                                     Forces &forces,
                                     Configuration &configuration,
                                     const DampingParameters &damping,
                                     const CorotationParameters &corotation,
                                     const bool dynamic,
                                     Effort &effort)
    : body(body)
    , constraints(constraints)
    , forces(forces)
    , damping(damping)
    , configuration(configuration)
    , effort(effort)
    , warp_tolerance(corotation.warp_tolerance * M_PI / 180.)
    , pattern(make_pattern())
    , A(pattern)
  {
    forces.connect(pattern);
    find_masked_entries();
    if (dynamic)
      make_mass();
  }


  void
  ImplicitOperator::make_mass()
  {
    M = std::make_unique<SymmetricScalarMatrix>(pattern);
    body.cells->add_mass(forces.elastic().cell_slots(), *M);
  }


  void
  ImplicitOperator::renew_pattern()
  {
    pattern = make_pattern();
    forces.connect(pattern);
    A.fit_pattern();
    find_masked_entries();
    if (M)
      make_mass();
    ++patterns;
  }


  /** A node that is held in all directions is coupled to no other. */
  SymmetricPattern
  ImplicitOperator::make_pattern() const
  {
    std::vector<std::vector<std::uint32_t>> columns(body.n_local);
    const auto couple = [&](const unsigned int row, const unsigned int column) {
      if (column < row && column < body.n_owned && !constraints.holds_node(row) &&
          !constraints.holds_node(column))
        columns[row].push_back(column);
    };
    if (body.is_quadratic())
      for (std::size_t cell = 0; cell < body.cell_nodes.size(); ++cell)
        {
          const std::vector<unsigned int> nodes = body.nodes_of_cell(cell);
          for (const unsigned int row : nodes)
            for (const unsigned int column : nodes)
              couple(row, column);
        }
    else
      for (const auto &nodes : body.cell_nodes)
        for (const unsigned int row : nodes)
          for (const unsigned int column : nodes)
            couple(row, column);
    for (const auto &[one, other] : forces.couplings())
      couple(std::max(one, other), std::min(one, other));

    SymmetricPattern pattern;
    pattern.n_owned = body.n_owned;
    pattern.n_local = body.n_local;
    pattern.row_start.push_back(0);
    for (auto &row : columns)
      {
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        pattern.column.insert(pattern.column.end(), row.begin(), row.end());
        pattern.row_start.push_back(pattern.column.size());
      }
    pattern.cut(body.n_threads);
    return pattern;
  }


  void
  ImplicitOperator::find_masked_entries()
  {
    masked_lower.clear();
    masked_diagonal.clear();
    for (const unsigned int dof : constraints.owned())
      {
        const std::size_t node = dof / 3, i = dof % 3;
        for (std::size_t j = 0; j < 3; ++j)
          if (j != i)
            {
              masked_diagonal.push_back(9 * node + 3 * i + j);
              masked_diagonal.push_back(9 * node + 3 * j + i);
            }
      }
    for (std::size_t row = 0; row < pattern.n_local; ++row)
      for (std::size_t k = pattern.row_start[row]; k < pattern.row_start[row + 1]; ++k)
        for (std::size_t i = 0; i < 3; ++i)
          for (std::size_t j = 0; j < 3; ++j)
            if (constraints.holds(3 * row + i) || constraints.holds(3 * pattern.column[k] + j))
              masked_lower.push_back(9 * k + 3 * i + j);
  }


  void
  ImplicitOperator::make()
  {
    if (forces.couplings_have_changed())
      renew_pattern();
    set_matrix(A, 0.);
    made = true;
  }


  void
  ImplicitOperator::set_matrix(SymmetricBlockMatrix &matrix, const double added_bulk) const
  {
    const PhaseTimer timer(effort, Phase::assembly);
    matrix.set_zero();
    forces.add_tangent(configuration, factors, matrix, added_bulk);
    if (diagonal != 0.)
      matrix.add_to_diagonal(diagonal);
    mask(matrix);
  }


  void
  ImplicitOperator::mask(SymmetricBlockMatrix &matrix) const
  {
    for (const std::size_t position : masked_diagonal)
      matrix.diagonal[position] = 0.;
    for (const std::size_t position : masked_lower)
      matrix.lower[position] = 0.;
  }


  bool
  ImplicitOperator::is_made_of(const TangentFactors &wanted, const double wanted_diagonal) const
  {
    return wanted.mass == factors.mass && wanted.velocity == factors.velocity &&
           wanted.displacement == factors.displacement && wanted_diagonal == diagonal;
  }


  bool
  ImplicitOperator::assemble(const double gamma)
  {
    const TangentFactors wanted  = {1. + gamma * damping.mass_factor, gamma, gamma * gamma};
    const double wanted_diagonal = gamma * damping.viscous;
    if (lags)
      return assemble_kept(wanted, wanted_diagonal);
    const bool keeps = warp_tolerance > 0. && forces.elastic().tangent_is_frozen() &&
                       !forces.others_change_operator();
    if (keeps && renewable && is_made_of(wanted, wanted_diagonal))
      return renew();
    factors   = wanted;
    diagonal  = wanted_diagonal;
    renewable = keeps;
    assemble_all();
    return true;
  }


  bool
  ImplicitOperator::assemble_kept(const TangentFactors &wanted, const double wanted_diagonal)
  {
    if (made && is_made_of(wanted, wanted_diagonal))
      return false;
    factors  = wanted;
    diagonal = wanted_diagonal;
    make();
    ++effort.assemblies;
    effort.cells_warped += body.cell_nodes.size();
    return true;
  }


  void
  ImplicitOperator::keep_rotations()
  {
    configuration.keep_for_tangent();
    lags = true;
    made = false;
  }


  bool
  ImplicitOperator::cells_have_turned(const double angle) const
  {
    const unsigned int here = forces.elastic().n_turned(configuration, angle) > 0;
    return dealii::Utilities::MPI::max(here, body.mesh.communicator) > 0;
  }


  nlohmann::json
  ImplicitOperator::save() const
  {
    if (!renewable)
      return nullptr;
    return {{"mass", factors.mass},
            {"velocity", factors.velocity},
            {"displacement", factors.displacement},
            {"diagonal", diagonal}};
  }


  void
  ImplicitOperator::load(const nlohmann::json &saved)
  {
    renewable = !saved.is_null();
    if (!renewable)
      return;
    factors  = {saved.at("mass"), saved.at("velocity"), saved.at("displacement")};
    diagonal = saved.at("diagonal");
    made     = false;
  }


  /** A cell on two processes is renewed by both in the same step: they know the same rotations. */
  bool
  ImplicitOperator::renew()
  {
    const bool anew = !made;
    if (anew)
      make();
    const std::size_t here = forces.elastic().n_turned(configuration, warp_tolerance);
    const std::size_t all  = dealii::Utilities::MPI::sum(here, body.mesh.communicator);
    if (all == 0)
      return anew;
    if (2 * all > body.mesh.n_cells)
      assemble_all(); // to take off and to put on costs more
    else
      {
        const PhaseTimer timer(effort, Phase::assembly);
        forces.elastic().renew_tangent(configuration, warp_tolerance, factors, A);
        mask(A);
        ++effort.assemblies;
        effort.cells_warped += here;
      }
    return true;
  }


  void
  ImplicitOperator::assemble_all()
  {
    if (renewable)
      configuration.rotations.kept = configuration.rotations.current;
    else
      configuration.rotations.kept.clear();
    make();
    ++effort.assemblies;
    effort.cells_warped += body.cell_nodes.size();
  }


  void
  ImplicitOperator::assemble_stiffness()
  {
    factors  = {0., 0., 1.};
    diagonal = 0.;
    make();
    ++effort.assemblies;
  }


  void
  ImplicitOperator::assemble_bounded(SymmetricBlockMatrix &matrix) const
  {
    set_matrix(matrix, bounded_bulk());
  }


  double
  ImplicitOperator::bounded_bulk() const
  {
    constexpr double bulk = 13. / 6.; // kappa / mu at nu = 0.3
    return body.is_quadratic() ? bulk - VolumetricPatches::bulk_of_quadratic_cells : bulk;
  }


  void
  ImplicitOperator::assemble_on_vertices(const CellSlots &slots, SymmetricBlockMatrix &matrix) const
  {
    const PhaseTimer timer(effort, Phase::assembly);
    matrix.set_zero();
    forces.elastic().add_vertex_tangent(
      configuration, factors, slots, matrix, patches() ? bounded_bulk() : 0.);
    if (diagonal != 0.) // of a vertex, and about seven edges that have half of theirs here
      matrix.add_to_diagonal(4.5 * diagonal);
  }


  void
  ImplicitOperator::vmult(Vector &y, const Vector &x) const
  {
    const GhostValues values(x);
    A.vmult(y.begin(), values.data());
    if (configuration.patches)
      {
        configuration.patches->add_product(patch_factor(), values.data(), y.begin());
        constraints.set_zero(y);
      }
  }


  void
  ImplicitOperator::mass_vmult(Vector &y, const Vector &x) const
  {
    const GhostValues values(x);
    M->vmult(y.begin(), values.data());
    constraints.set_zero(y);
  }


  namespace
  {
    /** The product with s (A - m M - d I), row by row. Arrays as in
     * SymmetricBlockMatrix::vmult(). */
    struct StiffnessProduct
    {
      const SymmetricBlockMatrix &A;
      const SymmetricScalarMatrix &M;
      const double m, d, s;
      double *y;
      const double *x;

      /** sum += s^-1 (entries of the row) x, and the transposed ones to y. */
      void
      add(const std::size_t i,
          const std::size_t begin,
          const std::size_t end,
          double (&sum)[3]) const
      {
        const double scaled[3]{s * x[3 * i], s * x[3 * i + 1], s * x[3 * i + 2]};
        for (std::size_t k = begin; k < end; ++k)
          {
            const double *block = &A.lower[9 * k];
            ask_for_line_ahead(block);
            const double mass = m * M.lower[k];
            const double *xj  = x + 3 * static_cast<std::size_t>(A.pattern.column[k]);
            double *yj        = y + 3 * static_cast<std::size_t>(A.pattern.column[k]);
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int b = 0; b < 3; ++b)
                {
                  const double entry = block[3 * a + b] - (a == b ? mass : 0.);
                  sum[a] += entry * xj[b];
                  yj[b] += entry * scaled[a];
                }
          }
      }

      void
      set_row(const std::size_t i, const std::size_t begin, const std::size_t end) const
      {
        double sum[3]{};
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            sum[a] += (A.diagonal[9 * i + 3 * a + b] - (a == b ? m * M.diagonal[i] + d : 0.)) *
                      x[3 * i + b];
        add(i, begin, end, sum);
        for (unsigned int a = 0; a < 3; ++a)
          y[3 * i + a] = s * sum[a];
      }

      void
      add_to_row(const std::size_t i, const std::size_t begin, const std::size_t end) const
      {
        double sum[3]{};
        add(i, begin, end, sum);
        for (unsigned int a = 0; a < 3 && i < A.pattern.n_owned; ++a)
          y[3 * i + a] += s * sum[a];
      }
    };
  } // namespace


  namespace
  {
    /** Products with K take the rotations of now: while it lives, those are the ones that A keeps.
     */
    class KeptRotations
    {
    public:
      KeptRotations(Configuration &configuration, const bool lags)
        : rotations(configuration.rotations)
        , swapped(lags && !rotations.kept.empty())
      {
        swap();
      }

      ~KeptRotations()
      {
        swap();
      }

      KeptRotations(const KeptRotations &) = delete;
      KeptRotations &
      operator=(const KeptRotations &) = delete;

    private:
      void
      swap()
      {
        if (swapped)
          rotations.current.swap(rotations.kept);
      }

      CellRotations &rotations;
      const bool swapped;
    };
  } // namespace


  void
  ImplicitOperator::stiffness_vmult(Vector &y, const Vector &x) const
  {
    const GhostValues values(x);
    const bool is_in_A = M && made && factors.displacement > 0. &&
                         patch_factor() == factors.displacement && !forces.others_have_tangent();
    if (is_in_A)
      {
        // What is lost where M is much larger than K' is round-off of M x / gamma.
        const double scale = 1. / factors.displacement;
        const StiffnessProduct product{
          A, *M, factors.mass, diagonal, scale, y.begin(), values.data()};
        pattern.for_inner_entries(
          [&product](const std::size_t i, const std::size_t begin, const std::size_t end) {
            product.set_row(i, begin, end);
          });
        pattern.for_outer_entries(
          [&product](const std::size_t i, const std::size_t begin, const std::size_t end) {
            product.add_to_row(i, begin, end);
          });
        if (configuration.patches)
          configuration.patches->add_product(1., values.data(), y.begin());
      }
    else
      {
        const KeptRotations kept(configuration, lags);
        sum_into(y, [&](double *sum) {
          forces.add_product(configuration, {0., 0., 1.}, values.data(), sum);
        });
      }
    constraints.set_zero(y);
  }


  void
  ImplicitOperator::elastic_vmult(Vector &y, const Vector &u, const Vector &v) const
  {
    if (!constraints.move() && damping.stiffness_factor == 0.)
      {
        stiffness_vmult(y, u);
        return;
      }
    const GhostValues displacement(u), velocity(v);
    const KeptRotations kept(configuration, lags);
    sum_into(y, [&](double *sum) {
      forces.add_product(configuration, {0., 0., 1.}, displacement.data(), sum);
      if (damping.stiffness_factor > 0.)
        forces.add_product(configuration, {0., 1., 0.}, velocity.data(), sum);
    });
    constraints.set_zero(y);
  }
} // namespace Supple
