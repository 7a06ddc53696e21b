#include <supple/run/checkpoints.h>

#include <supple/base/error.h>
#include <supple/base/first_process.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace Supple
{
  using Json = nlohmann::json;

  namespace
  {
    /** What follows the first @p mark of the last line of a file that has one; 0 if none has. */
    double
    last_number_after(const std::string &mark, const std::string &file)
    {
      std::ifstream stream(file);
      double number = 0.;
      for (std::string line; std::getline(stream, line);)
        {
          const auto place = line.find(mark);
          if (place != std::string::npos)
            number = std::strtod(line.c_str() + place + mark.size(), nullptr);
        }
      return number;
    }
  } // namespace


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
    , checkpoint(problem.body,
                 problem.parameters.checkpoint,
                 problem.parameters.as_used,
                 !problem.stationary,
                 folder)
    , kept(std::make_unique<Json>(Json::object()))
  {
    if (problem.parameters.checkpoint.wanted())
      integrator.keep_past();
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
    std::vector<Vector *> vectors = problem.configuration.vectors();
    for (Vector *const vector : listeners.kept_vectors())
      vectors.push_back(vector);
    return vectors;
  }


  void
  Checkpoints::resume()
  {
    if (!problem.parameters.checkpoint.resume)
      return;
    const auto saved = checkpoint.read(kept_vectors(), problem.configuration.vectors().size());
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
    catch (const std::out_of_range &)
      {
        checkpoint.refuse_content();
      }
    require_later_end();
    course.origin                  = checkpoint.origin();
    course.origin_is_second_choice = checkpoint.was_damaged();
  }


  void
  Checkpoints::require_later_end() const
  {
    on_first_process(problem.mesh.communicator, [this] {
      const double done =
        std::max({course.now.time,
                  last_number_after(",", folder + "/" + HistoryTable::files()[0]),
                  last_number_after("timestep=\"", folder + "/" + Frames::files()[0])});
      if (done <= integrator.end * (1. + 1e-9))
        return;
      std::ostringstream text;
      text << problem.parameters.origin("Time/Steps") << ": the run would end at " << integrator.end
           << " s, but the one to go on from has come to " << done
           << " s: what it wrote would be lost. Let the run be longer, or begin anew with "
              "Checkpoint/Resume = never.";
      throw InputError(text.str());
    });
  }


  void
  Checkpoints::take(const Json &saved)
  {
    course.load(saved.at("course"));
    problem.configuration.load_cells(saved.at("cells"), problem.effort);
    problem.implicit_operator.load(saved.at("operator"));
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
  Checkpoints::write(const bool in_haste)
  {
    const PhaseTimer timer(effort, Phase::output);
    listeners.save(*kept);
    Json rest = {{"course", course.save()},
                 {"integrator", integrator.save()},
                 {"cells", problem.configuration.save_cells()},
                 {"operator", problem.implicit_operator.save()},
                 {"listeners", *kept}};
    if (diagnostics)
      rest["diagnostics"] = diagnostics->save();
    const auto vectors = kept_vectors();
    checkpoint.write(course.now.step, {vectors.begin(), vectors.end()}, rest, in_haste);
  }


  void
  Checkpoints::begin(const Observation & /* now */, const bool /* resumed */)
  {
  }


  bool
  Checkpoints::after_step(const Observation &now)
  {
    if (problem.parameters.checkpoint.wanted() && checkpoint.due(now.measurement.step))
      write(false);
    return true;
  }


  void
  Checkpoints::interrupted(const Observation & /* now */)
  {
    if (problem.parameters.checkpoint.wanted())
      write(true);
  }
} // namespace Supple
