#ifndef supple_contact_newton_h
#define supple_contact_newton_h

#include <supple/forces/contact.h>
#include <supple/time/implicit_stage.h>
#include <supple/time/model.h>

namespace Supple
{
  /**
   * Newton's method for a stage in which tools may touch the body. No iterate is within a tool: a
   * correction is cut to what Contact::safe_part() allows.
   *
   * Tools and held vertices go along. They begin where they were at the start of the step, and each
   * correction is computed as if they were at their goal; if only a part of it is safe, they go on
   * by that part too. Where they have arrived, a line search makes the energy of the stage fall.
   * That is the barrier's, and for the rest the mean of the forces at both ends times the way:
   * exact where they are linear, and no difference of large numbers.
   *
   * Without a touch at either end, and with nothing else that is not linear, one correction is all.
   */
  class ContactNewton
  {
  public:
    explicit ContactNewton(const Model &model);

    /** From the configuration to the end of the stage. @throws ComputationError if no state is
     * found, with what stands in the way */
    void
    solve(ImplicitStage &stage);

    /** Corrections so far. */
    unsigned long n_iterations = 0;

  private:
    /** What solve() does, but for what contact is told of it. */
    void
    find(ImplicitStage &stage);

    /** What tells how the energy changes along a correction. */
    struct Slope
    {
      double contact;  ///< energy of the barrier [J]
      double others;   ///< what all other forces do on the whole way, as they are here [J]
      double residual; ///< its norm [N]
    };

    /** Puts tools and held vertices at the end of their way if that is safe and touches nothing, or
     * else at its beginning. */
    void
    choose_passage(ImplicitStage &stage);

    /** Where tools touch, goes a safe part of the way that inertia alone would take. */
    void
    warm_up(ImplicitStage &stage);

    /** Sets correction and way, as if tools and held vertices were at the end of theirs. */
    void
    find_correction(ImplicitStage &stage);

    /** Adds what held vertices have still to go to a way of all nodes. */
    void
    add_way_of_held(Vector &way) const;

    /** Adds a part of the correction, tools and held vertices along with it. */
    void
    advance(ImplicitStage &stage, double part);

    /** Adds as much of a safe part of the correction as lowers the energy, and evaluates the stage.
     * @throws ComputationError if nothing does */
    void
    search(ImplicitStage &stage, double safe);

    Slope
    slope(const ImplicitStage &stage);

    /** Zero where the body is held. */
    void
    set_contact_force();

    /** Whether what is left of the forces is small beside that of contact. Collective. */
    bool
    is_balanced(const ImplicitStage &stage);

    /** For messages: what is nearest to what, and how near. Collective. */
    std::string
    what_is_near() const;

    const Model model;
    Contact &contact;
    Vector correction;    ///< of free nodes [m]
    Vector way;           ///< of all nodes [m]
    Vector right_side;    ///< [N]
    Vector contact_force; ///< [N]
  };
} // namespace Supple

#endif
