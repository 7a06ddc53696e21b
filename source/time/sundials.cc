#include <supple/time/sundials.h>

#include <supple/base/error.h>

#include <deal.II/base/mpi.h>

#include <nvector/nvector_parallel.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace Supple
{
  namespace Sundials
  {
    Context::Context(const MPI_Comm communicator)
      : record(std::make_unique<Record>())
      , communicator(communicator)
    {
      context = Compatibility::create_sundials_context(this->communicator);
      Compatibility::collect_errors(context, message);
    }


    Context::~Context()
    {
      SUNContext_Free(&context);
    }


    void
    Record::begin()
    {
      kept    = {};
      keeping = true;
    }


    void
    Record::play(const Decisions &decisions)
    {
      kept         = decisions;
      playing      = true;
      keeping      = !kept.reductions.empty();
      n_reductions = 0;
      n_calls      = 0;
    }


    bool
    Record::end_of_play()
    {
      playing = false;
      return !keeping || (n_reductions == kept.reductions.size() && n_calls == kept.n_calls);
    }


    double
    Record::reduction(const std::function<double()> &compute)
    {
      if (playing)
        {
          const std::size_t i = n_reductions++;
          return i < kept.reductions.size() ? kept.reductions[i] : 0.;
        }
      const double result = compute();
      if (keeping)
        kept.reductions.push_back(result);
      return result;
    }


    int
    Record::call(const std::function<int()> &callback)
    {
      if (playing)
        {
          const auto failure = kept.failures.find(n_calls++);
          return failure == kept.failures.end() ? 0 : failure->second;
        }
      const int code = callback();
      if (keeping)
        {
          if (code != 0)
            kept.failures[kept.n_calls] = code;
          ++kept.n_calls;
        }
      return code;
    }


    namespace
    {
      /** Of SUNDIALS's parallel vector, whose operations take it for theirs. */
      struct Content : _N_VectorContent_Parallel
      {
        Record *record;
        std::vector<double> values;
      };


      Content &
      content_of(const N_Vector vector)
      {
        return *static_cast<Content *>(vector->content);
      }


      Record &
      record_of(const N_Vector vector)
      {
        return *content_of(vector).record;
      }


      void
      give_content(const N_Vector vector,
                   const sunindextype n_local,
                   const sunindextype n_global,
                   const MPI_Comm communicator,
                   Record &record)
      {
        auto *content          = new Content();
        content->local_length  = n_local;
        content->global_length = n_global;
        content->own_data      = 0;
        content->comm          = communicator;
        content->record        = &record;
        content->values.resize(n_local);
        content->data   = content->values.data();
        vector->content = content;
      }


      N_Vector
      clone(const N_Vector vector)
      {
        const Content &content = content_of(vector);
        const N_Vector copy    = N_VNewEmpty(vector->sunctx);
        N_VCopyOps(vector, copy);
        give_content(
          copy, content.local_length, content.global_length, content.comm, *content.record);
        content.record->vectors.push_back(copy);
        return copy;
      }


      void
      destroy(const N_Vector vector)
      {
        std::vector<N_Vector> &vectors = record_of(vector).vectors;
        vectors.erase(std::remove(vectors.begin(), vectors.end(), vector), vectors.end());
        delete &content_of(vector);
        vector->content = nullptr;
        N_VFreeEmpty(vector);
      }


      /**
       * z_i = f(i). SUNDIALS's own loops, as distributions compile them, take one number at a time,
       * and there are about fifty of them in a step. Vectors may be the same, but never overlap.
       */
      template <class Function>
      void
      set_each(const N_Vector z, const Function &f)
      {
        if (record_of(z).plays())
          return;
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


      /** Those that go through a sum, whose result is all that SUNDIALS decides by. */
      void
      keep_reductions(const N_Vector vector)
      {
        vector->ops->nvwrmsnorm = [](N_Vector x, N_Vector w) {
          return record_of(x).reduction([=] { return N_VWrmsNorm_Parallel(x, w); });
        };
        vector->ops->nvdotprod = [](N_Vector x, N_Vector y) {
          return record_of(x).reduction([=] { return N_VDotProd_Parallel(x, y); });
        };
        vector->ops->nvmaxnorm = [](N_Vector x) {
          return record_of(x).reduction([=] { return N_VMaxNorm_Parallel(x); });
        };
        vector->ops->nvmin = [](N_Vector x) {
          return record_of(x).reduction([=] { return N_VMin_Parallel(x); });
        };
      }
    } // namespace


    StateVector::StateVector(const unsigned int n_local,
                             const MPI_Comm communicator,
                             const Context &context)
      : vector(N_VNewEmpty_Parallel(communicator,
                                    n_local,
                                    dealii::Utilities::MPI::sum(n_local, communicator),
                                    context))
    {
      const N_VectorContent_Parallel empty = NV_CONTENT_P(vector);
      give_content(vector, n_local, empty->global_length, communicator, *context.record);
      std::free(empty);
      use_quick_loops(vector); // clones inherit them
      keep_reductions(vector);
      vector->ops->nvclone      = clone;
      vector->ops->nvcloneempty = nullptr;
      vector->ops->nvdestroy    = destroy;
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
      return record.call([&] {
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
      });
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
