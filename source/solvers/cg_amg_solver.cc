#include <supple/linear_algebra/previous_solutions.h>
#include <supple/solvers/iterative_solver.h>
#include <supple/solvers/vertex_operator.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    using NodeVector = std::vector<NodeValues<3>>;

    // By how much single precision makes a residual smaller before it is computed anew in double
    // precision: for well conditioned matrices, and at the least.
    constexpr double largest_reduction = 1e-3, smallest_reduction = 0.1;

    // It does not come forward if it needs more iterations for that.
    constexpr unsigned int single_precision_iterations = 100;

    // How much of the residual a first guess leaves at most.
    constexpr double largest_guess_residual = 0.5;

    // What the coarse levels cost to compute, in iterations, measured on the bar.
    constexpr double refresh_cost = 12.;

    // Another step changes the matrix at once, and with it what the coarse levels should be.
    constexpr double largest_change = 2.;


    /**
     * When coarse levels are to be computed anew. The older they are, the more iterations are
     * needed: e more than with new ones. It pays when the next solution with old ones would cost
     * more than a solution has cost since the last time, on average: e >= (cost + sum of e) / n.
     */
    class RefreshRule
    {
    public:
      bool
      due() const
      {
        return n_solves > 0 && excess * n_solves >= refresh_cost + excess_sum;
      }

      void
      refreshed()
      {
        n_solves   = 0;
        excess_sum = 0.;
        excess     = 0.;
        new_rate   = {};
      }

      /**
       * @param reduction of the residual, its logarithm
       * @param guessed   whether there was a first guess: what it leaves takes more iterations for
       * the same reduction
       */
      void
      solved(const unsigned int n_iterations, const double reduction, const bool guessed)
      {
        if (!(reduction > 1.) || !std::isfinite(reduction)) // too few iterations to tell
          return;
        const double rate = n_iterations / reduction;
        if (new_rate[guessed] == 0.)
          new_rate[guessed] = mean_rate[guessed] = rate;
        mean_rate[guessed] += (guessed ? weight : 1.) * (rate - mean_rate[guessed]);
        excess = (mean_rate[guessed] - new_rate[guessed]) * reduction;
        excess_sum += excess;
        ++n_solves;
      }

    private:
      static constexpr double weight = 0.25; ///< of a guessed solution in the mean of the last ones

      unsigned int n_solves          = 0;
      std::array<double, 2> new_rate = {}, mean_rate = {}; ///< iterations for a reduction by e
      double excess = 0., excess_sum = 0.;
    };


    using Piece = SymmetricPattern::Piece;


    /** The sum of what summand(node) gives for each node of a piece, in single precision over a few
     * nodes at a time. */
    template <class Summand>
    double
    sum_over_nodes(const Piece &piece, const Summand &summand)
    {
      constexpr std::size_t at_once = 128;

      double sum = 0.;
      for (std::size_t first = piece.begin; first < piece.end; first += at_once)
        {
          Lanes<float, 3> part[2]{};
          const std::size_t end = std::min<std::size_t>(piece.end, first + at_once);
          for (std::size_t node = first; node < end; ++node)
            part[node % 2] += summand(node);
          for (unsigned int i = 0; i < 3; ++i)
            sum += double(part[0][i]) + double(part[1][i]);
        }
      return sum;
    }


    /** Our multigrid for deal.II's solvers, as an approximation of A^-1: for minimal residuals its
     * unit matters, for the mean stresses have a preconditioner of their own. */
    class DoublePrecision
    {
    public:
      DoublePrecision(Cycle &multigrid, NodeVector &r, NodeVector &z, NodeVector &Az)
        : multigrid(multigrid)
        , r(r)
        , z(z)
        , Az(Az)
      {
      }

      void
      vmult(Vector &y, const Vector &x) const
      {
        const double size  = x.linfty_norm(); // single precision would not reach to 1e-50
        const double scale = size > 0. ? 1. / size : 1.;
        for (std::size_t node = 0; node < multigrid.halo.n_owned; ++node)
          for (unsigned int i = 0; i < 3; ++i)
            r[node].lanes[i] = scale * x.local_element(3 * node + i);
        multigrid.apply(z.data(), Az.data(), r.data());
        const double unit = size * multigrid.scale();
        for (std::size_t node = 0; node < multigrid.halo.n_owned; ++node)
          for (unsigned int i = 0; i < 3; ++i)
            y.local_element(3 * node + i) = unit * z[node].lanes[i];
      }

    private:
      Cycle &multigrid;
      NodeVector &r, &z, &Az;
    };


    /**
     * Conjugate gradients in single precision, of which one keeps the residual true: whenever it
     * has become smaller by a factor it is computed anew in double precision, and the iterations go
     * on with the direction they had (van der Vorst, Ye 2000: reliable updates). Where this does
     * not come forward, since the matrix is too badly conditioned for single precision, it is the
     * preconditioner alone that stays in it.
     */
    class AmgSolver : public IterativeSolver
    {
    public:
      AmgSolver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort)
        : IterativeSolver(A, parameters, effort)
        , vertices(A.body.is_quadratic() ? std::make_unique<VertexOperator>(A) : nullptr)
        , cycle(make_cycle())
        , multigrid(*cycle)
        , pattern(A.matrix().pattern)
        , n_owned(A.body.n_owned)
        , correction(A.body.n_local)
        , r(A.body.n_local)
        , z(A.body.n_local)
        , Az(A.body.n_local)
        , p(A.body.n_local)
        , q(A.body.n_local)
        , guesses(!A.patches())
        , previous(A.body.partitioner)
      {
      }

      std::vector<LevelShare>
      coarse_levels() const override
      {
        std::vector<LevelShare> shares;
        for (std::size_t l = 0; l < multigrid.n_coarse_levels(); ++l)
          shares.push_back(
            {multigrid.coarse_level(l).n_nodes, multigrid.coarse_level(l).numbers.n_owned});
        return shares;
      }

      std::string
      name() const override
      {
        return "cg-amg";
      }

    private:
      std::unique_ptr<Cycle>
      make_cycle() const
      {
        const SymmetricBlockMatrix &matrix = preconditioning_matrix.get();
        if (!vertices)
          return std::make_unique<Multigrid>(matrix, A.body.partitioner);
        return std::make_unique<QuadraticMultigrid>(matrix,
                                                    A.body.partitioner,
                                                    vertices->matrix(),
                                                    vertices->level());
      }

      void
      do_prepare(const Vector &displacement) override
      {
        update_matrices();
        if (vertices)
          vertices->update();
        if (built && !rule.due() && !changed_at_once())
          {
            multigrid.refresh_finest();
            return;
          }
        find_rigid_motions(displacement);
        if (built)
          multigrid.refresh(rigid_motions);
        else
          multigrid.build(rigid_motions);
        built            = true;
        factor_of_levels = A.patch_factor();
        rule.refreshed();
        ++effort.hierarchies;
      }

      /** Whether the step is another one, and the matrix with it. */
      bool
      changed_at_once() const
      {
        if (A.patch_factor() == factor_of_levels)
          return false;
        const double change = multigrid.change();
        return change > largest_change || change < 1. / largest_change;
      }

      /** None where the body is held. */
      void
      find_rigid_motions(const Vector &displacement)
      {
        rigid_motions.assign(18 * static_cast<std::size_t>(n_owned), 0.);
        for (std::size_t dof = 0; dof < 3 * n_owned; ++dof)
          if (!A.constraints.holds(dof))
            {
              const std::array<double, 6> motions = rigid_motions_at(dof, displacement);
              std::copy(motions.begin(), motions.end(), &rigid_motions[6 * dof]);
            }
      }

      unsigned int
      do_solve(Vector &x, const Vector &b, Vector &residual) override
      {
        const double size   = b.l2_norm();
        const double before = A.patches() ? size : begin(x, b, residual, size);
        const unsigned int n_iterations =
          A.patches() ? solve_from_zero(x, b, residual, DoublePrecision(multigrid, r, z, Az))
                      : solve_in_single_precision(x, b, residual, before);
        if (guesses)
          previous.add(x, b, residual);
        rule.solved(n_iterations, std::log(before / residual.l2_norm()), before < size);
        return n_iterations;
      }

      /** Sets x to the best guess at hand. @return the norm of its residual */
      double
      begin(Vector &x, const Vector &b, Vector &residual, const double size)
      {
        if (previous.guess(x, b))
          {
            const double norm = set_residual(residual, x, b);
            if (norm < largest_guess_residual * size)
              return norm;
          }
        x        = 0.;
        residual = b;
        return size;
      }

      /** As far as that comes. */
      unsigned int
      solve_in_single_precision(Vector &x, const Vector &b, Vector &residual, double norm)
      {
        const double size = b.l2_norm(), goal = parameters.tolerance * size;
        unsigned int n_iterations = 0;
        last_curvature            = 0.;
        while (norm > goal && reduction <= smallest_reduction)
          {
            if (n_iterations >= parameters.iteration_limit)
              throw_not_converged(n_iterations, norm / size);
            const double before = norm;
            const double aim    = std::max(reduction * norm, std::min(0.9 * goal, 0.5 * norm));
            n_iterations +=
              reduce(residual, size, aim / norm, parameters.iteration_limit - n_iterations);
            add_correction(x, size);
            norm = set_residual(residual, x, b);
            if (norm > std::max(goal, 2. * aim))
              reduction *= norm < before / 3. ? 10. : 1e9;
            if (norm > before)
              {
                add_correction(x, -size);
                norm = set_residual(residual, x, b);
              }
          }
        if (norm > goal)
          n_iterations +=
            iterate(x, b, residual, DoublePrecision(multigrid, r, z, Az), n_iterations);
        return n_iterations;
      }

      void
      add_correction(Vector &x, const double size) const
      {
        const double unit = size * multigrid.scale();
        pattern.for_pieces([&](const Piece &piece) {
          for (std::size_t node = piece.begin; node < piece.end; ++node)
            for (unsigned int i = 0; i < 3; ++i)
              x.local_element(3 * node + i) += unit * double(correction[node].lanes[i]);
        });
      }

      /**
       * Finds a correction in single precision that makes the residual smaller by a factor, if it
       * can.
       * @param size  unit of the residual
       * @param limit of the number of iterations
       * @return the number of iterations
       */
      unsigned int
      reduce(const Vector &residual,
             const double size,
             const double factor,
             const unsigned int limit)
      {
        const double goal_square = factor * factor * take_residual(residual, size);
        for (unsigned int n = 1;; ++n)
          {
            multigrid.apply(z.data(), Az.data(), r.data());
            const double rho = product(r, z);
            // The residual that has just been computed anew is not what the recurrence had: then
            // the direction is made conjugate to the last one by definition.
            double beta = 0.;
            if (n > 1)
              beta = rho / last_rho;
            else if (last_curvature > 0.)
              beta = -product(z, q) / last_curvature;
            last_rho            = rho;
            last_curvature      = add_direction(beta);
            const float alpha   = (n > 1 ? rho : product(p, r)) / last_curvature;
            const double square = go_along_direction(alpha);
            if (!(square > goal_square) || n >= std::min(limit, single_precision_iterations))
              return n;
          }
      }

      /** r = residual / size, correction = 0. @return r.r */
      double
      take_residual(const Vector &residual, const double size)
      {
        return sum([&](const std::size_t node) {
          for (unsigned int i = 0; i < 3; ++i)
            r[node].lanes[i] = residual.local_element(3 * node + i) / size;
          correction[node].lanes = Lanes<float, 3>{};
          return r[node].lanes * r[node].lanes;
        });
      }

      /** p = z + beta p, and q = A p with it. @return p.q */
      double
      add_direction(const float beta)
      {
        const bool anew = beta == 0.f; // whatever is left of an earlier, perhaps failed solution
        return sum([&](const std::size_t node) {
          p[node].lanes = anew ? z[node].lanes : z[node].lanes + beta * p[node].lanes;
          q[node].lanes = anew ? Az[node].lanes : Az[node].lanes + beta * q[node].lanes;
          return p[node].lanes * q[node].lanes;
        });
      }

      /** correction += alpha p, and r with it. @return r.r */
      double
      go_along_direction(const float alpha)
      {
        return sum([&](const std::size_t node) {
          correction[node].lanes += alpha * p[node].lanes;
          r[node].lanes -= alpha * q[node].lanes;
          return r[node].lanes * r[node].lanes;
        });
      }

      double
      product(const NodeVector &x, const NodeVector &y) const
      {
        return sum([&](const std::size_t node) { return x[node].lanes * y[node].lanes; });
      }

      /** The sum of summand(node) over the nodes of all processes. */
      template <class Summand>
      double
      sum(const Summand &summand) const
      {
        const double part = pattern.sum_over_pieces(
          [&](const Piece &piece) { return sum_over_nodes(piece, summand); });
        return multigrid.halo.single() ? part : Utilities::MPI::sum(part, A.body.mesh.communicator);
      }

      const std::unique_ptr<VertexOperator> vertices; ///< of quadratic cells, otherwise null
      const std::unique_ptr<Cycle> cycle;
      Cycle &multigrid;
      RefreshRule rule;
      bool built              = false;
      double factor_of_levels = 0.; ///< of the stiffness in the matrix of the coarse levels
      double reduction        = largest_reduction; ///< until it turns out to be too much
      const SymmetricPattern &pattern;
      const std::size_t n_owned;
      std::vector<double> rigid_motions;
      NodeVector correction, r, z, Az, p, q;
      const bool guesses;
      PreviousSolutions previous; ///< none without guesses
      double last_rho       = 0.; ///< r.z of the last iteration
      double last_curvature = 0.; ///< p.q of the last iteration
    };
  } // namespace


  std::unique_ptr<LinearSolver>
  make_cg_amg_solver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort)
  {
    return std::make_unique<AmgSolver>(A, parameters, effort);
  }
} // namespace Supple
