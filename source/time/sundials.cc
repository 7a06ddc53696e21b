#include <supple/time/sundials.h>

#include <supple/base/error.h>

#include <deal.II/base/mpi.h>

#include <nvector/nvector_parallel.h>

#include <cmath>

namespace Supple
{
  namespace Sundials
  {
    Context::Context(const MPI_Comm communicator)
      : communicator(communicator)
    {
      context = Compatibility::create_sundials_context(this->communicator);
      Compatibility::collect_errors(context, message);
    }


    Context::~Context()
    {
      SUNContext_Free(&context);
    }


    namespace
    {
      /**
       * z_i = f(i). SUNDIALS's own loops, as distributions compile them, take one number at a time,
       * and there are about fifty of them in a step. Vectors may be the same, but never overlap.
       */
      template <class Function>
      void
      set_each(const N_Vector z, const Function &f)
      {
        double *const values = data(z);
        const auto n         = N_VGetLocalLength_Parallel(z);
#pragma GCC ivdep
        for (sunindextype i = 0; i < n; ++i)
          values[i] = f(i);
      }


      /** The operations that go through no sum, with the vector registers of the machine. */
      void
      use_quick_loops(const N_Vector vector)
      {
        vector->ops->nvconst = [](const double c, N_Vector z) {
          set_each(z, [c](sunindextype) { return c; });
        };
        vector->ops->nvscale = [](const double c, N_Vector x, N_Vector z) {
          const double *const a = data(x);
          set_each(z, [=](const sunindextype i) { return c * a[i]; });
        };
        vector->ops->nvlinearsum =
          [](const double c, N_Vector x, const double d, N_Vector y, N_Vector z) {
            const double *const a = data(x), *const b = data(y);
            set_each(z, [=](const sunindextype i) { return c * a[i] + d * b[i]; });
          };
        vector->ops->nvabs = [](N_Vector x, N_Vector z) {
          const double *const a = data(x);
          set_each(z, [=](const sunindextype i) { return std::abs(a[i]); });
        };
        vector->ops->nvinv = [](N_Vector x, N_Vector z) {
          const double *const a = data(x);
          set_each(z, [=](const sunindextype i) { return 1. / a[i]; });
        };
      }
    } // namespace


    StateVector::StateVector(const unsigned int n_local,
                             const MPI_Comm communicator,
                             const Context &context)
      : vector(N_VNew_Parallel(communicator,
                               n_local,
                               dealii::Utilities::MPI::sum(n_local, communicator),
                               context))
    {
      use_quick_loops(vector); // clones inherit them
      N_VConst(0., vector);
    }


    StateVector::~StateVector()
    {
      N_VDestroy(vector);
    }


    double *
    StateVector::data() const
    {
      return Sundials::data(vector);
    }


    double *
    data(const N_Vector vector)
    {
      return N_VGetArrayPointer(vector);
    }


    namespace
    {
      LinearSystem &
      system_of(const SUNMatrix matrix)
      {
        return *static_cast<LinearSystem *>(matrix->content);
      }


      SUNMatrix
      make_matrix(LinearSystem *system, const SUNContext context)
      {
        const SUNMatrix matrix = SUNMatNewEmpty(context);
        matrix->content        = system;
        matrix->ops->getid     = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
        matrix->ops->clone     = [](SUNMatrix other) {
          return make_matrix(&system_of(other), other->sunctx);
        };
        matrix->ops->destroy = [](SUNMatrix other) { SUNMatFreeEmpty(other); };
        matrix->ops->zero    = [](SUNMatrix) { return 0; };
        matrix->ops->copy    = [](SUNMatrix, SUNMatrix) { return 0; };
        matrix->ops->matvec  = [](SUNMatrix other, N_Vector x, N_Vector y) {
          return system_of(other).product(data(y), data(x));
        };
        return matrix;
      }
    } // namespace


    LinearSystem::LinearSystem(const Context &context)
      : matrix(make_matrix(this, context))
      , solver(SUNLinSolNewEmpty(context))
    {
      solver->content         = this;
      solver->ops->gettype    = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
      solver->ops->getid      = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
      solver->ops->initialize = [](SUNLinearSolver) { return 0; };
      solver->ops->setup      = [](SUNLinearSolver, SUNMatrix) { return 0; };
      solver->ops->solve =
        [](SUNLinearSolver self, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
          // ARKode takes a code it doesn't know for success.
          const int status = static_cast<LinearSystem *>(self->content)->solve(data(x), data(b));
          return status == 0  ? 0
                 : status > 0 ? SUNLS_PACKAGE_FAIL_REC
                              : Compatibility::linear_solver_failed;
        };
    }


    LinearSystem::~LinearSystem()
    {
      SUNLinSolFreeEmpty(solver);
      SUNMatDestroy(matrix);
    }


    int
    Failure::guard(const std::function<void()> &action)
    {
      try
        {
          action();
          return 0;
        }
      catch (const ComputationError &)
        {
          if (!kept) // what failed first is the reason for the rest
            kept = std::current_exception();
          return 1;
        }
      catch (...)
        {
          kept = std::current_exception();
          return -1;
        }
    }


    void
    Failure::rethrow()
    {
      if (kept)
        {
          const std::exception_ptr exception = kept;
          kept                               = nullptr;
          std::rethrow_exception(exception);
        }
    }
  } // namespace Sundials
} // namespace Supple
