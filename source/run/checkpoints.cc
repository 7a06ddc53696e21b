#include <supple/run/checkpoints.h>

#include <supple/base/error.h>

#include <nlohmann/json.hpp>

namespace Supple
{
  using Json = nlohmann::json;

  Checkpoints::Checkpoints(const std::string &folder,
                           Problem &problem,
                           TimeIntegrator &integrator,
                           Diagnostics *const diagnostics,
                           Course &course,
                           const Listeners &listeners)
    : Writer(folder, problem.effort)
    , problem(problem)
    , integrator(integrator)
    , diagnostics(diagnostics)
    , course(course)
    , listeners(listeners)
    , checkpoint(problem.body, problem.parameters, folder)
    , kept(std::make_unique<Json>(Json::object()))
  {
  }


  std::vector<std::string>
  Checkpoints::files()
  {
    return Checkpoint::files();
  }


  void
  Checkpoints::open(const bool /* resumed */, const unsigned int /* step */)
  {
  }


  std::vector<Vector *>
  Checkpoints::kept_vectors() const
  {
    std::vector<Vector *> vectors;
    for (unsigned int b = 0; b < problem.state.n_blocks(); ++b)
      vectors.push_back(&problem.state.block(b));
    for (Vector *const vector : listeners.kept_vectors())
      vectors.push_back(vector);
    return vectors;
  }


  void
  Checkpoints::resume()
  {
    if (!problem.parameters.checkpoint.resume)
      return;
    const auto saved = checkpoint.read(kept_vectors(), problem.state.n_blocks());
    if (!saved)
      return;
    try
      {
        take(*saved);
      }
    catch (const Json::exception &)
      {
        checkpoint.refuse_content();
      }
    course.origin                  = checkpoint.origin();
    course.origin_is_second_choice = checkpoint.was_damaged();
    problem.body.update_rotations(problem.state.block(0), problem.effort);
  }


  void
  Checkpoints::take(const Json &saved)
  {
    course.load(saved.at("course"));
    integrator.load(saved.at("integrator"));
    if (diagnostics && !saved.contains("diagnostics"))
      throw InputError(problem.parameters.origin("Output/History") +
                       ": the run to go on from measured no energies, for it wrote neither a "
                       "history nor frames. Set Output/History = false and Output/Frames = none "
                       "as there, or Checkpoint/Resume = never to begin anew.");
    if (diagnostics)
      diagnostics->load(saved.at("diagnostics"));
    *kept = saved.at("listeners");
    listeners.load(*kept);
  }


  void
  Checkpoints::write()
  {
    const PhaseTimer timer(effort, Phase::output);
    listeners.save(*kept);
    Json rest = {{"course", course.save()},
                 {"integrator", integrator.save()},
                 {"listeners", *kept}};
    if (diagnostics)
      rest["diagnostics"] = diagnostics->save();
    problem.implicit_operator.forget(); // as a run that goes on from here
    problem.solver->forget();
    const auto vectors = kept_vectors();
    checkpoint.write(course.now.step, {vectors.begin(), vectors.end()}, rest);
  }


  void
  Checkpoints::begin(const Observation & /* now */, const bool /* resumed */)
  {
  }


  bool
  Checkpoints::after_step(const Observation &now)
  {
    if (problem.parameters.checkpoint.wanted() && checkpoint.due(now.measurement.step))
      write();
    return true;
  }


  void
  Checkpoints::interrupted(const Observation & /* now */)
  {
    // The operator forgets at a checkpoint. Where its cells keep their warp and checkpoints are due
    // after steps, only at these an uninterrupted run forgets too.
    const CheckpointParameters &wanted = problem.parameters.checkpoint;
    const bool repeats = problem.parameters.corotation.warp_tolerance > 0. && wanted.minutes == 0.;
    if (wanted.wanted() && !repeats)
      write();
  }
} // namespace Supple
