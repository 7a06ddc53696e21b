#ifndef supple_sundials_h
#define supple_sundials_h

#include <supple/base/compatibility.h>

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nvector.h>

#include <exception>
#include <functional>
#include <string>

namespace Supple
{
  /**
   * What SUNDIALS's integrators need of their surroundings, owned and freed. ARKode and IDA are
   * called directly and not through deal.II's classes: those take no single step, keep IDA's memory
   * to themselves, and wrap the linear system in an iterative solver that is not there.
   */
  namespace Sundials
  {
    /** SUNDIALS's context. What its integrators have to say is kept and not printed. */
    class Context
    {
    public:
      explicit Context(MPI_Comm communicator);

      ~Context();

      Context(const Context &) = delete;
      Context &
      operator=(const Context &) = delete;

      operator SUNContext() const
      {
        return context;
      }

      std::string message; ///< the last error, empty if there was none

    private:
      MPI_Comm communicator;
      SUNContext context = nullptr;
    };


    /** The state as SUNDIALS sees it: own displacements, then own velocities. */
    class StateVector
    {
    public:
      StateVector(unsigned int n_local, MPI_Comm communicator, const Context &context);

      ~StateVector();

      StateVector(const StateVector &) = delete;
      StateVector &
      operator=(const StateVector &) = delete;

      operator N_Vector() const
      {
        return vector;
      }

      double *
      data() const;

    private:
      N_Vector vector;
    };


    double *
    data(N_Vector vector);


    /**
     * The linear system of an implicit step, and the mass matrix: known by what they do. The
     * callbacks return 0, a positive number where a smaller step may help, or a negative one.
     */
    class LinearSystem
    {
    public:
      /** To be used by solve() and product(). */
      using Action = std::function<int(double *result, const double *argument)>;

      explicit LinearSystem(const Context &context);

      ~LinearSystem();

      LinearSystem(const LinearSystem &) = delete;
      LinearSystem &
      operator=(const LinearSystem &) = delete;

      Action solve;
      Action product;

      SUNMatrix matrix;
      SUNLinearSolver solver;
    };


    /** Keeps what is thrown inside a callback, since SUNDIALS in between knows no exceptions. */
    class Failure
    {
    public:
      /** 0, or 1 if a ComputationError was thrown, -1 for anything else. */
      int
      guard(const std::function<void()> &action);

      /** Throws what was kept, the first of it; forgets it. */
      void
      rethrow();

      void
      forget()
      {
        kept = nullptr;
      }

    private:
      std::exception_ptr kept;
    };
  } // namespace Sundials
} // namespace Supple

#endif
