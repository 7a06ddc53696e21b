#ifndef supple_effort_h
#define supple_effort_h

#include <array>
#include <chrono>
#include <string>

namespace Supple
{
  /** Where the time goes. */
  enum class Phase : unsigned int
  {
    rotations,
    forces,
    assembly,
    solver_setup,
    solve,
    diagnostics,
    output
  };

  constexpr std::array<const char *, 7> phase_names = {
    {"rotations", "forces", "assembly", "solver_setup", "solve", "diagnostics", "output"}};


  /** What a run did: counted and timed by those who do it, read by the summary. */
  struct Effort
  {
    unsigned long rotations_computed = 0; ///< cells times updates
    unsigned long assemblies         = 0; ///< of the implicit operator
    unsigned long cells_warped       = 0; ///< cells whose stiffness was taken anew for it
    unsigned long factorizations     = 0; ///< by a direct solver
    unsigned long hierarchies        = 0; ///< multigrid set-ups
    unsigned long solves             = 0;
    unsigned long linear_iterations  = 0;
    unsigned long stand_in_solves    = 0; ///< those of them where the first solver had failed
    unsigned long newton_iterations  = 0;
    unsigned long rejected_steps     = 0;  ///< tried and taken back
    unsigned long jumps              = 0;  ///< steps in which a prescribed motion jumps
    unsigned long failed_steps       = 0;  ///< those of them whose equations were not solved
    double max_relative_residual     = 0.; ///< true residual over right hand side, worst solve

    std::array<double, phase_names.size()> seconds{{}};
  };


  /** Adds the time from its making to its end to a phase. */
  class PhaseTimer
  {
  public:
    PhaseTimer(Effort &effort, const Phase phase)
      : seconds(effort.seconds[static_cast<unsigned int>(phase)])
      , start(std::chrono::steady_clock::now())
    {
    }

    ~PhaseTimer()
    {
      seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    PhaseTimer(const PhaseTimer &) = delete;
    PhaseTimer &
    operator=(const PhaseTimer &) = delete;

  private:
    double &seconds;
    const std::chrono::steady_clock::time_point start;
  };
} // namespace Supple

#endif
