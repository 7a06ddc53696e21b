#include <supple/base/error.h>
#include <supple/solvers/linear_solver.h>
#include <supple/solvers/patched_matrix.h>

#include <Eigen/CholmodSupport>

#include <algorithm>
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
        , of_blocks(A)
      {
        make_pattern();
        adjust();
        factorization.analyzePattern(matrix);
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
        const SymmetricBlockMatrix &blocks = of_blocks.get();
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

      void
      make_pattern()
      {
        const std::size_t n = 3 * static_cast<std::size_t>(of_blocks.get().pattern.n_owned);
        std::vector<int> rows, first(n + 1);
        for_each_entry([&](const std::size_t row, const std::size_t column, const double) {
          rows.push_back(row);
          first[column + 1] = rows.size();
        });
        matrix.resize(n, n);
        matrix.resizeNonZeros(rows.size());
        std::copy(first.begin(), first.end(), matrix.outerIndexPtr());
        std::copy(rows.begin(), rows.end(), matrix.innerIndexPtr());
        copy_values();
      }

      void
      copy_values()
      {
        double *value = matrix.valuePtr();
        for_each_entry(
          [&](const std::size_t, const std::size_t, const double entry) { *value++ = entry; });
      }

      void
      do_prepare(const Vector &) override
      {
        of_blocks.update();
        copy_values();
        factorization.factorize(matrix);
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

      PatchedMatrix of_blocks;
      SparseMatrix matrix; ///< its upper triangle
      Eigen::CholmodSupernodalLLT<SparseMatrix, Eigen::Upper> factorization;
    };
  } // namespace


  std::unique_ptr<LinearSolver>
  make_cholmod_solver(const ImplicitOperator &A, const SolverParameters &parameters, Effort &effort)
  {
    return std::make_unique<CholmodSolver>(A, parameters, effort);
  }
} // namespace Supple
