#include <supple/base/error.h>
#include <supple/solvers/linear_solver.h>

#include <Eigen/CholmodSupport>

#include <algorithm>
#include <cmath>
#include <cstdlib>

// OpenBLAS has it, other BLAS libraries have not.
extern "C" void
openblas_set_num_threads(int) __attribute__((weak));

namespace Supple
{
  namespace
  {
    /** Threads of BLAS that wait for each other slow bodies of this size down: one unless the user
     * asks for more. */
    void
    limit_blas_threads()
    {
      if (openblas_set_num_threads != nullptr && std::getenv("OPENBLAS_NUM_THREADS") == nullptr)
        openblas_set_num_threads(1);
    }


    using SparseMatrix = Eigen::SparseMatrix<double>;

    /**
     * CHOLMOD's factorization on one process. The rows of A below the diagonal are, read by
     * columns, the upper triangle that Eigen wants.
     */
    class CholmodSolver : public LinearSolver
    {
    public:
      CholmodSolver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort)
        : LinearSolver(A, parameters, effort)
      {
        make_pattern();
        adjust();
        factorization.analyzePattern(whole_matrix());
      }

      std::string
      name() const override
      {
        return "cholmod";
      }

    private:
      /** One ordering tried, the one that was best for meshes of tetrahedra. */
      void
      adjust()
      {
        limit_blas_threads();
        factorization.cholmod().nmethods           = 1;
        factorization.cholmod().method[0].ordering = CHOLMOD_AMD;
        factorization.cholmod().postorder          = 1;
        factorization.cholmod().print              = 0;
      }

      /** Calls @p visit(row, column, value) for each entry of the upper triangle, column by column
       * from the top. Nothing is coupled to the z of a plane body. */
      template <class Visit>
      void
      for_each_entry(const Visit &visit) const
      {
        const SymmetricBlockMatrix &blocks = A.matrix();
        const SymmetricPattern &pattern    = blocks.pattern;
        const unsigned int n_coupled       = A.body.mesh.section.plane() ? 2 : 3;
        for (std::size_t i = 0; i < pattern.n_owned; ++i)
          for (unsigned int a = 0; a < 3; ++a)
            {
              for (std::size_t k = pattern.row_start[i]; k < pattern.row_start[i + 1]; ++k)
                for (unsigned int b = 0; b < n_coupled && a < n_coupled; ++b)
                  visit(3 * pattern.column[k] + b, 3 * i + a, blocks.lower[9 * k + 3 * a + b]);
              for (unsigned int b = a < n_coupled ? 0 : a; b <= a; ++b)
                visit(3 * i + b, 3 * i + a, blocks.diagonal[9 * i + 3 * a + b]);
            }
      }

      const SparseMatrix &
      whole_matrix() const
      {
        return A.patches() ? matrix : matrix_of_cells;
      }

      void
      make_pattern()
      {
        const std::size_t n = 3 * static_cast<std::size_t>(A.matrix().pattern.n_owned);
        std::vector<int> rows, first(n + 1);
        for_each_entry([&](const std::size_t row, const std::size_t column, const double) {
          rows.push_back(row);
          first[column + 1] = rows.size();
        });
        matrix_of_cells.resize(n, n);
        matrix_of_cells.resizeNonZeros(rows.size());
        std::copy(first.begin(), first.end(), matrix_of_cells.outerIndexPtr());
        std::copy(rows.begin(), rows.end(), matrix_of_cells.innerIndexPtr());
        copy_values();
      }

      void
      copy_values()
      {
        double *value = matrix_of_cells.valuePtr();
        for_each_entry(
          [&](const std::size_t, const std::size_t, const double entry) { *value++ = entry; });
        if (A.patches())
          {
            const SparseMatrix square_root = square_root_of_patches();
            matrix =
              matrix_of_cells +
              SparseMatrix(
                SparseMatrix(square_root * square_root.transpose()).triangularView<Eigen::Upper>());
          }
      }

      /** A column for each patch: it couples all nodes of the patch with each other. */
      SparseMatrix
      square_root_of_patches() const
      {
        const VolumetricPatches &patches = *A.patches();
        std::vector<Eigen::Triplet<double>> entries;
        for (unsigned int p = 0; p < patches.partitioner->size(); ++p)
          {
            const double factor = std::sqrt(A.patch_factor() * patches.stiffness(p));
            patches.for_each_node(p, [&](const unsigned int node, const std::array<double, 3> &c) {
              for (unsigned int i = 0; i < (A.body.mesh.section.plane() ? 2 : 3); ++i)
                if (!A.constraints.holds(3 * node + i))
                  entries.emplace_back(3 * node + i, p, factor * c[i]);
            });
          }
        SparseMatrix columns(matrix_of_cells.rows(), patches.partitioner->size());
        columns.setFromTriplets(entries.begin(), entries.end());
        return columns;
      }

      void
      do_prepare(const Vector &) override
      {
        copy_values();
        factorization.factorize(whole_matrix());
        ++effort.factorizations;
        if (factorization.info() != Eigen::Success)
          throw ComputationError(
            "the matrix is not positive definite, or too badly conditioned to tell (cholmod)");
      }

      unsigned int
      do_solve(Vector &x, const Vector &b, Vector &residual) override
      {
        Eigen::Map<Eigen::VectorXd>(x.begin(), x.size()) =
          factorization.solve(Eigen::Map<const Eigen::VectorXd>(b.begin(), b.size()));
        set_residual(residual, x, b);
        return 0;
      }

      SparseMatrix matrix_of_cells;
      SparseMatrix matrix; ///< with patches, if there are any
      Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Upper> factorization;
    };
  } // namespace


  std::unique_ptr<LinearSolver>
  make_cholmod_solver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort)
  {
    return std::make_unique<CholmodSolver>(A, parameters, effort);
  }
} // namespace Supple
