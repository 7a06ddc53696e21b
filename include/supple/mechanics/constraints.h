#ifndef supple_constraints_h
#define supple_constraints_h

#include <supple/mechanics/body.h>
#include <supple/mechanics/constraint_parameters.h>

#include <functional>

namespace Supple
{
  /** Which degrees of freedom are held, at their place at rest or on a prescribed path. */
  class Constraints
  {
  public:
    /** @throws InputError if a boundary or region selects nothing; @p scene knows where the entries
     * were set */
    Constraints(const Body &body,
                const ConstraintParameters &parameters,
                const Motions &prescribed,
                const ParameterFile &scene);

    /** By local number of the degree of freedom, ghosts included. */
    bool
    holds(const unsigned int dof) const
    {
      return held[dof];
    }

    bool
    holds_node(const unsigned int node) const
    {
      return held[3 * node] && held[3 * node + 1] && held[3 * node + 2];
    }

    /** The held degrees of freedom this process owns, ascending. */
    const std::vector<unsigned int> &
    owned() const
    {
      return held_owned;
    }

    /** Sets the held entries to zero. */
    void
    set_zero(Vector &vector) const;

    /** Whether anything is held elsewhere than at its place at rest. */
    bool
    move() const
    {
      return !motions.empty();
    }

    /** Sets the held entries to their prescribed displacement [m] at a time [s]. */
    void
    set_displacement(Vector &displacement, double time) const;

    /** Sets the held entries to the velocity of their prescribed displacement [m/s], by differences
     * at five times from @p time to @p time + 4 @p interval, of fourth order. */
    void
    set_velocity(Vector &velocity, double time, double interval) const;

    /** Whether a prescribed displacement changes between two times [s] by far more than its
     * velocities there let it: it jumps, or swings to and fro in between. */
    bool
    jump(double start, double end) const;

    /** Copies the held entries. */
    void
    copy_held(Vector &to, const Vector &from) const;

    /** Sets the held entries of a displacement to a part of the straight way from a start to a
     * goal.
     */
    void
    set_held_on_way(Vector &to, const Vector &start, const Vector &goal, double part) const;

    unsigned int n_held; ///< degrees of freedom on all processes, without those along z of a
                         ///< plane body

    std::vector<unsigned int> free_pieces; ///< those of the body of which nothing is held

    /** Which pieces are free: how many cells each has, and where it is; empty if none is, or if
     * the whole body is free. */
    std::string
    free_pieces_in_words() const;

    /** Which rigid motions are possible, of the first piece of the body that has any; empty if
     * there are none. Parts of a piece that hang together by a vertex or an edge alone move against
     * each other. */
    std::string
    free_motions_in_words() const;

  private:
    struct Motion
    {
      unsigned int direction;
      std::function<double(const dealii::Point<3> &, double)> displacement; ///< of place and time
      std::vector<unsigned int> nodes;                                      ///< owned
      dealii::Point<3> sample; ///< one of the vertices, the same on all processes
    };

    void
    add_motion(const MotionParameters &motion,
               const std::string &section,
               const ParameterFile &scene);

    /** @throws InputError if it is held already, or there is no such vertex */
    void
    add_hand(const ConstraintParameters::ByHand &hand);

    /** A vertex among those selected. */
    dealii::Point<3>
    sample_of(const std::vector<bool> &nodes) const;

    const Body &body;
    std::vector<Motion> motions;

    /** What the body itself demands, and lists and numbers of all that is held. */
    void
    complete();

    /** For each part of the body, the 6x6 matrix of scalar products of what its rigid motions do to
     * held degrees of freedom, column by column; collective. */
    std::vector<double>
    held_products() const;

    std::vector<bool> held;
    std::vector<unsigned int> held_owned;
    std::vector<double> products; ///< held_products()
  };
} // namespace Supple

#endif
