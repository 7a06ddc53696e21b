#ifndef supple_problem_h
#define supple_problem_h

#include <supple/scene/parameters.h>
#include <supple/time/model.h>

#include <memory>
#include <string>
#include <vector>

namespace Supple
{
  /** The mechanical problem of a scene: the body with its forces and constraints, its
   * configuration, and the operator of implicit steps with its solver. */
  class Problem
  {
  public:
    /** @throws InputError if something in the scene is wrong, or a static scene has a body that is
     * not held */
    Problem(const Parameters &scene, MPI_Comm communicator);

    /** The same on a mesh that is there already, with a body that goes on from another state than
     * the start. @throws InputError */
    Problem(const Parameters &scene, const std::shared_ptr<const Mesh> &mesh);

    /** What integrators work with; it must not outlive the problem. */
    Model
    model();

    const Parameters parameters;
    const bool stationary;
    Effort effort;
    const std::shared_ptr<const Mesh> shared_mesh;
    const Mesh &mesh;
    const TimeParameters time; ///< those of the scene, with what variable steps must not pass over
    const Body body;
    const Constraints constraints;
    Forces forces;
    Configuration configuration; ///< at the start, until somebody takes a step
    ImplicitOperator implicit_operator;
    const std::unique_ptr<LinearSolver> solver;
    std::vector<std::string> warnings; ///< of what was found at the start

  private:
    Problem(const Parameters &scene, const std::shared_ptr<const Mesh> &mesh, bool begins_at_start);

    /** @throws InputError */
    void
    require_held_body() const;

    void
    create_initial_state();

    /** Sets the displacement of the rotation that the scene starts with. */
    void
    turn(Vector &displacement) const;
  };
} // namespace Supple

#endif
