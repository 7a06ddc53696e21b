#ifndef supple_sundials_h
#define supple_sundials_h

#include <supple/base/compatibility.h>

#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nvector.h>

#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Supple
{
  /**
   * What SUNDIALS's integrators need of their surroundings, owned and freed. ARKode and IDA are
   * called directly and not through deal.II's classes: those take no single step, keep IDA's memory
   * to themselves, and wrap the linear system in an iterative solver that is not there.
   */
  namespace Sundials
  {
    /** What decides over the memory of an integrator: the results of all reductions over its
     * vectors, and the codes of callbacks that failed, by the number of the call. */
    struct Decisions
    {
      std::vector<double> reductions;
      std::map<unsigned long, int> failures;
      unsigned long n_calls = 0;
    };


    /**
     * Keeps the decisions of an integrator from an instant on, and plays them back: a new
     * integrator goes through the same steps without computing any of them, and then lacks the
     * contents of its vectors alone. SUNDIALS neither tells nor takes what an integrator remembers.
     */
    class Record
    {
    public:
      /** Keeps the decisions from here on. */
      void
      begin();

      /** Gives these decisions from here on, instead of those that are computed. Without any,
       * reductions give zero and callbacks succeed: so each step does. */
      void
      play(const Decisions &decisions);

      /** Goes on with what was played. @return whether all of it was asked for, and no more */
      bool
      end_of_play();

      bool
      plays() const
      {
        return playing;
      }

      double
      reduction(const std::function<double()> &compute);

      int
      call(const std::function<int()> &callback);

      const Decisions &
      decisions() const
      {
        return kept;
      }

      /** That the integrator has made for itself and not destroyed, in the order of their making.
       */
      std::vector<N_Vector> vectors;

    private:
      Decisions kept;
      bool keeping = false, playing = false;
      std::size_t n_reductions = 0; ///< played
      unsigned long n_calls    = 0; ///< played
    };


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
      std::unique_ptr<Record> record;

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
      explicit Failure(const Context &context)
        : record(*context.record)
      {
      }

      /** 0, or 1 if a ComputationError was thrown, -1 for anything else; where a record is played,
       * what it was then. */
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
      Record &record;
      std::exception_ptr kept;
    };
  } // namespace Sundials
} // namespace Supple

#endif
