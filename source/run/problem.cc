#include <supple/run/problem.h>

#include <supple/base/error.h>
#include <supple/base/expression.h>
#include <supple/forces/contact.h>
#include <supple/run/time_dependence.h>
#include <supple/scene/read_scene.h>

#include <deal.II/base/multithread_info.h>
#include <deal.II/physics/transformations.h>

#include <array>

namespace Supple
{
  using namespace dealii;

  Problem::Problem(const Parameters &scene, const MPI_Comm communicator)
    : Problem(scene, std::make_shared<const Mesh>(make_mesh(scene, communicator)), true)
  {
  }


  Problem::Problem(const Parameters &scene, const std::shared_ptr<const Mesh> &mesh)
    : Problem(scene, mesh, false)
  {
  }


  Problem::Problem(const Parameters &scene,
                   const std::shared_ptr<const Mesh> &ready_mesh,
                   const bool begins_at_start)
    : parameters(scene)
    , stationary(parameters.time.problem == TimeParameters::Problem::stationary)
    , shared_mesh(ready_mesh)
    , mesh(*shared_mesh)
    , time(time_with_instants(parameters, mesh.bounding_box))
    , body(mesh, parameters.material, parameters.solver.threads, parameters.file)
    , constraints(body, parameters.constraints, parameters.motions, parameters.file)
    , forces(body,
             parameters.material,
             parameters.corotation,
             parameters.damping,
             parameters.loads,
             parameters.contact,
             parameters.tools,
             parameters.file)
    , configuration(body, forces.elastic().cell_law(), !stationary)
    , implicit_operator(body,
                        constraints,
                        forces,
                        configuration,
                        parameters.damping,
                        parameters.corotation,
                        !stationary,
                        effort)
    , solver(LinearSolver::create(implicit_operator,
                                  parameters.solver,
                                  parameters.time.matrix_use(),
                                  parameters.file,
                                  effort))
  {
    dealii::MultithreadInfo::set_thread_limit(body.n_threads); // deal.II's vectors have as many
    require_held_body();
    create_initial_state();
    if (forces.contact() && begins_at_start)
      warnings = forces.contact()->check_start(configuration, parameters.file);
  }


  Model
  Problem::model()
  {
    return {body,
            constraints,
            forces,
            configuration,
            implicit_operator,
            *solver,
            time,
            parameters.damping,
            parameters.material,
            parameters.file,
            effort};
  }


  void
  Problem::require_held_body() const
  {
    const std::string free_pieces = constraints.free_pieces_in_words();
    if (stationary && !free_pieces.empty())
      throw InputError("A static scene needs a body that is held: " + free_pieces);
    const std::string free_motions = constraints.free_motions_in_words();
    if (stationary && !free_motions.empty())
      throw InputError("A static scene needs a body that is held: " + free_motions +
                       ", so that the stiffness is singular. Hold a boundary or a region "
                       "(subsection Constraints), or make the problem dynamic.");
  }


  void
  Problem::turn(Vector &displacement) const
  {
    const double degrees = parameters.start.rotation.norm();
    if (degrees == 0.)
      return;
    const auto R =
      Physics::Transformations::Rotations::rotation_matrix_3d(parameters.start.rotation / degrees,
                                                              degrees * numbers::PI / 180.);
    for (unsigned int node = 0; node < body.n_owned; ++node)
      {
        const Tensor<1, 3> arm = body.position(node) - parameters.start.rotation_center;
        const Tensor<1, 3> u   = R * arm - arm;
        for (unsigned int i = 0; i < 3; ++i)
          displacement.local_element(3 * node + i) = u[i];
      }
  }


  void
  Problem::create_initial_state()
  {
    const std::array<std::pair<const char *, std::string>, 2> starts = {
      {{"Start/Displacement", parameters.start.displacement},
       {"Start/Velocity", parameters.start.velocity}}};
    State &state                        = configuration.state;
    const std::vector<Vector *> vectors = configuration.vectors();
    turn(state.displacement);
    for (std::size_t k = 0; k < vectors.size(); ++k)
      {
        const Expression expression(starts[k].second, 3, parameters.origin(starts[k].first));
        for (unsigned int node = 0; node < body.n_owned && !expression.is_zero(); ++node)
          for (unsigned int i = 0; i < 3; ++i)
            vectors[k]->local_element(3 * node + i) += expression.value(body.position(node), 0., i);
        constraints.set_zero(*vectors[k]);
        if (!all_finite(*vectors[k]))
          throw InputError(parameters.origin(starts[k].first) +
                           ": it is not a finite number at every vertex.");
      }
    if (!constraints.move())
      return;
    constraints.set_displacement(state.displacement, 0.);
    if (!stationary)
      constraints.set_velocity(state.velocity, 0., parameters.time.derivative_interval());
    for (std::size_t k = 0; k < vectors.size(); ++k)
      if (!all_finite(*vectors[k]))
        throw InputError(std::string("A displacement of subsection Motion ") +
                         (k == 0 ? "is not a finite number" : "has no finite derivative") +
                         " at time 0.");
  }
} // namespace Supple
