#ifndef supple_time_parameters_h
#define supple_time_parameters_h

#include <supple/input/parameter_file.h>
#include <supple/mechanics/tangent.h>
#include <supple/solvers/matrix_use.h>

#include <string>
#include <vector>

namespace Supple
{
  /** The methods of a dynamic problem. */
  enum class TimeMethod
  {
    backward_euler,
    implicit_backward_euler,
    implicit_midpoint,
    sdirk2,
    trbdf2,
    esdirk3,
    esdirk4,
    esdirk5,
    imex3,
    imex4,
    imex5,
    explicit2,
    explicit3,
    explicit4,
    explicit5,
    ida
  };


  /** Subsection Time: the problem, its method in time and its steps. */
  struct TimeParameters
  {
    enum class Problem
    {
      dynamic,
      stationary
    };

    enum class EnergyGuard
    {
      off,
      warn,
      reject
    };

    Problem problem               = Problem::dynamic;
    TimeMethod method             = TimeMethod::backward_euler;
    double step                   = 0.01;
    unsigned int n_steps          = 100;
    bool adaptive                 = false;
    double relative_tolerance     = 1e-3;
    double displacement_tolerance = 0.;  ///< [m]; 0: by the size of the body
    double velocity_tolerance     = 0.;  ///< [m/s]; 0: from that of the displacement
    double longest_step           = 0.;  ///< [s]; 0: any
    unsigned int maximum_order    = 2;   ///< of IDA
    double renewal_angle          = 20.; ///< of semi-implicit methods [degrees]
    Tangent tangent               = Tangent::automatic;
    double newton_tolerance       = 1e-8;
    unsigned int newton_limit     = 100;
    unsigned int n_retries        = 10;
    EnergyGuard energy_guard      = EnergyGuard::off;
    bool estimate_error           = false; ///< by a second run

    // No entries, but what the rest of the scene asks of variable steps: to end there.
    std::vector<double> instants; ///< at which a load or a motion jumps or bends [s], ascending
    double stop_interval = 0.;    ///< at whose multiples something is written [s]; 0: nothing

    /** No entry: a live session goes on far beyond the end of its scene. */
    bool open_ended = false;

    void
    declare(dealii::ParameterHandler &prm);

    /** @throws InputError for settings that contradict each other */
    void
    check(const ParameterFile &scene) const;

    /** As it is written. */
    std::string
    method_name() const;

    bool
    is_explicit() const;

    /** Whether it splits the elastic force: each stage is one linear system. */
    bool
    is_semi_implicit() const;

    /** How many linear systems have the same matrix, if it changes. */
    MatrixUse
    matrix_use() const;

    /** Whether the last implicit stage of a step is its end: those methods are stiffly accurate. */
    bool
    ends_with_stage() const;

    /** With which power of the step the error falls; of ida its maximum order. */
    unsigned int
    order() const;

    bool
    has_variable_steps() const;

    /** The time at the end [s]; the load factor of a static problem. */
    double
    end() const;

    /** Where integrators end [s], or the load factor: end(), or a thousand times that if it is
     * open.
     */
    double
    last_end() const
    {
      return open_ended ? 1000. * end() : end();
    }

    /** Where a variable step that begins at a time has to end at the latest [s]. */
    double
    next_stop(double time) const;

    /** Whether a load or a motion jumps or bends at a time. */
    bool
    is_instant(double time) const;

    /** An instant too short for anything to happen in [s]. Forces of a step that begins or ends
     * where they jump are those this far within it. */
    double
    moment() const
    {
      return 1e-10 * end();
    }

    /** So short a time [s] that differences over it are derivatives, and so long that round-off is
     * small beside them. */
    double
    derivative_interval() const;

  private:
    void
    declare_tolerances(dealii::ParameterHandler &prm);

    void
    declare_renewal_angle(dealii::ParameterHandler &prm);

    void
    declare_newton(dealii::ParameterHandler &prm);
  };
} // namespace Supple

#endif
