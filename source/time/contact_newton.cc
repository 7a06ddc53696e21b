#include <supple/time/contact_newton.h>

#include <supple/base/error.h>
#include <supple/base/text.h>

#include <deal.II/base/mpi.h>

#include <cmath>
#include <string>

namespace Supple
{
  using namespace dealii;

  ContactNewton::ContactNewton(const Model &model)
    : model(model)
    , contact(*model.forces.contact())
  {
    for (Vector *vector : {&correction, &way, &right_side, &contact_force})
      model.body.initialize(*vector);
  }


  void
  ContactNewton::solve(ImplicitStage &stage)
  {
    const unsigned long n_before = n_iterations;
    try
      {
        find(stage);
      }
    catch (const ComputationError &)
      {
        contact.note_failed();
        throw;
      }
    contact.note_found(model.configuration, n_iterations - n_before);
  }


  void
  ContactNewton::find(ImplicitStage &stage)
  {
    constexpr unsigned int patience = 3;    // with round-off in forces that hardly act any more
    constexpr double hardly         = 1e-3; // a part of the way

    const Configuration &configuration = model.configuration;
    unsigned int n_small               = 0; // corrections
    contact.require_room(configuration.passage, model.constraints);
    contact.begin_step(configuration);
    choose_passage(stage);
    warm_up(stage);
    for (unsigned int n = 0; n < model.time.newton_limit; ++n)
      {
        const bool touched = contact.acts(configuration);
        const bool arrived = configuration.passage.part == 1.;
        stage.keep();
        find_correction(stage);
        ++n_iterations;

        const double safe = contact.safe_part(configuration, way, 1.);
        if (!arrived && safe < hardly)
          contact.require_room_between(configuration, model.constraints);
        const bool small = arrived && safe == 1. && stage.is_done(correction);
        const bool last  = small && (!touched || n_small == patience || is_balanced(stage));
        n_small += small;
        const bool free = safe == 1. && !touched && stage.is_linear();
        if (!arrived || last || free)
          {
            advance(stage, safe);
            if (last || (free && !contact.acts(configuration)))
              return;
            stage.evaluate();
          }
        else
          search(stage, safe);
      }
    throw ComputationError("Newton's method is not done after " +
                           std::to_string(model.time.newton_limit) +
                           " iterations (Time/Newton iterations)" + what_is_near());
  }


  /** A correction that is small beside the body may still be large beside the barrier. */
  bool
  ContactNewton::is_balanced(const ImplicitStage &stage)
  {
    constexpr double small = 1e-3; // of the forces before the last correction: squared after it

    set_contact_force();
    return stage.residual().l2_norm() <= small * contact_force.l2_norm();
  }


  void
  ContactNewton::choose_passage(ImplicitStage &stage)
  {
    Configuration &configuration = model.configuration;
    Passage &passage             = configuration.passage;
    const auto place_at          = [&](const double part) {
      passage.part = part;
      stage.correct(0., correction);
    };
    correction = 0.;
    stage.keep();
    place_at(0.);
    way = 0.;
    add_way_of_held(way);
    const bool still = !contact.tools_move(passage) && way.linfty_norm() == 0.;
    const bool safe  = still || contact.safe_part(configuration, way, 1.) == 1.;
    if (safe)
      place_at(1.);
    if (!still && safe && contact.acts(configuration))
      place_at(0.);
    stage.evaluate();
  }


  void
  ContactNewton::warm_up(ImplicitStage &stage)
  {
    const Configuration &configuration = model.configuration;
    if (!contact.acts(configuration) || !stage.foresee(correction))
      return;
    const double safe = contact.safe_part(configuration, correction, configuration.passage.part);
    stage.keep();
    stage.correct(safe == 1. ? 1. : 0.5 * safe, correction);
    stage.evaluate();
  }


  void
  ContactNewton::add_way_of_held(Vector &sum) const
  {
    const Configuration &configuration = model.configuration;
    const Passage &passage             = configuration.passage;
    if (!model.constraints.move() || passage.part == 1.)
      return;
    Vector goal = configuration.displacement();
    model.constraints.set_displacement(goal, passage.to);
    goal -= configuration.displacement();
    sum += goal;
  }


  void
  ContactNewton::find_correction(ImplicitStage &stage)
  {
    const Configuration &configuration = model.configuration;
    const bool arrived                 = configuration.passage.part == 1.;
    const auto solve                   = [&](const bool definite) {
      stage.prepare(definite);
      right_side = stage.residual();
      way        = 0.;
      if (!arrived)
        {
          add_way_of_held(way);
          stage.subtract_product(right_side, way);
          sum_into(contact_force,
                   [&](double *sum) { contact.add_advance(configuration, 1., sum); });
          right_side += contact_force;
          model.constraints.set_zero(right_side);
        }
      stage.solve(correction, right_side);
      way += correction;
    };
    try
      {
        solve(false);
      }
    catch (const ComputationError &)
      {
        solve(true);
        return;
      }
    if (arrived && stage.residual() * correction < 0.)
      solve(true);
  }


  void
  ContactNewton::advance(ImplicitStage &stage, const double part)
  {
    Passage &passage = model.configuration.passage;
    passage.part     = part == 1. ? 1. : passage.part + part * (1. - passage.part);
    stage.correct(part, correction);
  }


  void
  ContactNewton::set_contact_force()
  {
    const Configuration &configuration = model.configuration;
    sum_into(contact_force,
             [&](double *sum) { contact.add_force(configuration, configuration.passage.to, sum); });
    model.constraints.set_zero(contact_force);
  }


  ContactNewton::Slope
  ContactNewton::slope(const ImplicitStage &stage)
  {
    const Configuration &configuration = model.configuration;
    const MPI_Comm communicator        = model.body.mesh.communicator;
    set_contact_force();
    const double energy = contact.potential(configuration);
    return {Utilities::MPI::sum(energy, communicator),
            stage.residual() * correction - contact_force * correction,
            stage.residual().l2_norm()};
  }


  void
  ContactNewton::search(ImplicitStage &stage, const double safe)
  {
    constexpr double sufficient = 1e-4, round_off = 1e-13, shortest = 1e-9;

    const Slope before = slope(stage);
    const double fall  = stage.residual() * correction;
    for (double part = safe; part > shortest * safe; part *= 0.5)
      {
        stage.correct(part, correction);
        stage.evaluate();
        const Slope after = slope(stage);
        const double change =
          after.contact - before.contact - 0.5 * part * (before.others + after.others);
        // Near the end the energy changes by less than it is accurate; the forces tell more.
        if (change <= round_off * std::abs(before.contact) - sufficient * part * fall ||
            after.residual <= before.residual)
          return;
      }
    throw ComputationError(
      "no part of Newton's correction lowers the energy of the body and what "
      "it touches" +
      what_is_near());
  }


  std::string
  ContactNewton::what_is_near() const
  {
    const std::string words = contact.nearest_in_words(model.configuration);
    return words.empty() ? "" : "; " + words;
  }
} // namespace Supple
