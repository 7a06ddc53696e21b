#include <supple/solvers/iterative_solver.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <Eigen/Dense>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

namespace Supple
{
  using namespace dealii;

  namespace
  {
    /** Conjugate gradients with our own product; what remains is the preconditioner. */
    template <class Preconditioner>
    class ConjugateGradients : public IterativeSolver
    {
    public:
      ConjugateGradients(const ImplicitOperator &A,
                         const SolverParameters &parameters,
                         Effort &effort)
        : IterativeSolver(A, parameters, effort)
      {
      }

    protected:
      Preconditioner preconditioner;

    private:
      unsigned int
      do_solve(Vector &x, const Vector &b, Vector &residual) override
      {
        return solve_from_zero(x, b, residual, preconditioner);
      }
    };


    class BlockJacobi
    {
    public:
      void
      initialize(const SymmetricBlockMatrix &A)
      {
        using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
        inverses.resize(9 * static_cast<std::size_t>(A.pattern.n_owned));
        for (std::size_t k = 0; k < inverses.size(); k += 9)
          {
            Eigen::Map<RowMajor> inverse(&inverses[k]);
            inverse = Eigen::Map<const RowMajor>(&A.diagonal[k]).inverse();
          }
      }

      void
      vmult(Vector &y, const Vector &x) const
      {
        for (std::size_t i = 0; 9 * i < inverses.size(); ++i)
          for (unsigned int a = 0; a < 3; ++a)
            {
              const double *row          = &inverses[9 * i + 3 * a];
              y.local_element(3 * i + a) = row[0] * x.local_element(3 * i) +
                                           row[1] * x.local_element(3 * i + 1) +
                                           row[2] * x.local_element(3 * i + 2);
            }
      }

    private:
      std::vector<double> inverses;
    };


    class JacobiSolver : public ConjugateGradients<BlockJacobi>
    {
    public:
      using ConjugateGradients<BlockJacobi>::ConjugateGradients;

      std::string
      name() const override
      {
        return "cg-jacobi";
      }

    private:
      void
      do_prepare(const Vector &) override
      {
        update_matrices();
        preconditioner.initialize(preconditioning_matrix.get());
      }
    };


    class MultigridSolver : public ConjugateGradients<TrilinosWrappers::PreconditionAMG>
    {
    public:
      MultigridSolver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort)
        : ConjugateGradients<TrilinosWrappers::PreconditionAMG>(A, parameters, effort)
      {
        find_rows();
        make_pattern();
      }

      /** ML looks at the matrix once more when it goes. */
      ~MultigridSolver() override
      {
        preconditioner.clear();
      }

      std::string
      name() const override
      {
        return "cg-ml";
      }

    private:
      struct Entry
      {
        unsigned int column; ///< local node
        const double *block; ///< in A
        bool mirrored;       ///< the block is the transpose of what stands in A
      };

      /** Whole rows, as Trilinos wants them, from the half that A keeps. */
      void
      find_rows()
      {
        const SymmetricBlockMatrix &blocks = preconditioning_matrix.get();
        const SymmetricPattern &pattern    = blocks.pattern;
        rows.resize(pattern.n_owned);
        for (std::size_t i = 0; i < pattern.n_local; ++i)
          {
            if (i < pattern.n_owned)
              rows[i].push_back({static_cast<unsigned int>(i), &blocks.diagonal[9 * i], false});
            for (std::size_t k = pattern.row_start[i]; k < pattern.row_start[i + 1]; ++k)
              {
                const unsigned int j = pattern.column[k];
                if (i < pattern.n_owned)
                  rows[i].push_back({j, &blocks.lower[9 * k], false});
                rows[j].push_back({static_cast<unsigned int>(i), &blocks.lower[9 * k], true});
              }
          }
      }

      types::global_dof_index
      global(const unsigned int dof) const
      {
        return A.body.partitioner->local_to_global(dof);
      }

      void
      make_pattern()
      {
        const IndexSet &owned = A.body.partitioner->locally_owned_range();
        DynamicSparsityPattern sparsity(owned.size(), owned.size(), owned);
        for (unsigned int i = 0; i < rows.size(); ++i)
          for (const Entry &entry : rows[i])
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int b = 0; b < 3; ++b)
                sparsity.add(global(3 * i + a), global(3 * entry.column + b));
        matrix.reinit(owned, owned, sparsity, A.body.mesh.communicator);
      }

      void
      copy_values()
      {
        std::vector<types::global_dof_index> columns;
        std::vector<double> values;
        for (unsigned int i = 0; i < rows.size(); ++i)
          for (unsigned int a = 0; a < 3; ++a)
            {
              columns.clear();
              values.clear();
              for (const Entry &entry : rows[i])
                for (unsigned int b = 0; b < 3; ++b)
                  {
                    columns.push_back(global(3 * entry.column + b));
                    values.push_back(entry.block[entry.mirrored ? 3 * b + a : 3 * a + b]);
                  }
              matrix.set(global(3 * i + a), columns.size(), columns.data(), values.data());
            }
        matrix.compress(VectorOperation::insert);
      }

      /** Three translations and three rotations of the deformed body, one after the other; those
       * in the plane for a plane body, which are as soft all around an axis, or nearly so. */
      void
      find_rigid_motions(const Vector &displacement)
      {
        using Places         = std::vector<unsigned int>;
        const unsigned int n = 3 * A.body.n_owned;
        const Places included =
          A.body.mesh.section.plane() ? Places{0, 1, 5} : Places{0, 1, 2, 3, 4, 5};
        n_rigid_motions = included.size();
        rigid_motions.resize(n_rigid_motions * n);
        for (unsigned int dof = 0; dof < n; ++dof)
          {
            const std::array<double, 6> motions = rigid_motions_at(dof, displacement);
            for (unsigned int k = 0; k < n_rigid_motions; ++k)
              rigid_motions[k * n + dof] = motions[included[k]];
          }
      }

      void
      do_prepare(const Vector &displacement) override
      {
        update_matrices();
        copy_values();
        find_rigid_motions(displacement);

        Teuchos::ParameterList list;
        ML_Epetra::SetDefaults("SA", list);
        list.set("ML output", 0);
        list.set("PDE equations", 3);
        list.set("aggregation: type", "Uncoupled");
        list.set("smoother: type", "symmetric Gauss-Seidel");
        list.set("smoother: sweeps", 1);
        list.set("coarse: type", "Amesos-KLU");
        list.set("coarse: max size", 1000);
        list.set("null space: type", "pre-computed");
        list.set("null space: dimension", static_cast<int>(n_rigid_motions));
        list.set("null space: vectors", rigid_motions.data());
        list.set("null space: add default vectors", false);
        preconditioner.initialize(matrix, list);
        ++effort.hierarchies;
      }

      std::vector<std::vector<Entry>> rows;
      TrilinosWrappers::SparseMatrix matrix;
      unsigned int n_rigid_motions = 0;
      std::vector<double> rigid_motions;
    };
  } // namespace


  std::unique_ptr<LinearSolver>
  make_cg_ml_solver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort)
  {
    return std::make_unique<MultigridSolver>(A, parameters, effort);
  }


  std::unique_ptr<LinearSolver>
  make_cg_jacobi_solver(const ImplicitOperator &A,
                        const SolverParameters &parameters,
                        Effort &effort)
  {
    return std::make_unique<JacobiSolver>(A, parameters, effort);
  }
} // namespace Supple
