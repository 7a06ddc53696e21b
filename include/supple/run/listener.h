#ifndef supple_listener_h
#define supple_listener_h

#include <supple/mechanics/configuration.h>
#include <supple/observe/measurement.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace Supple
{
  /** An accepted state, and what was measured of it. */
  struct Observation
  {
    const Measurement &measurement;    ///< step and time alone if nobody asks for energies
    const std::vector<double> &probes; ///< as in a row of probes.csv
    const State &state;
    bool last; ///< whether the run ends here
  };


  /** Follows a run from state to state. All functions are called on all processes. */
  class Listener
  {
  public:
    virtual ~Listener() = default;

    /** Why the run must not accept a state, in words; empty if it may. */
    virtual std::string
    objection(const Observation & /* now */)
    {
      return "";
    }

    /**
     * Receives the first state. One of the start is treated like one after a step; one of a
     * checkpoint has been treated by the run that wrote it.
     * @param resumed whether the state is of a checkpoint
     */
    virtual void
    begin(const Observation &now, const bool resumed)
    {
      if (!resumed)
        after_step(now);
    }

    /** Receives the state after a step. @return whether the run may go on, else it is interrupted;
     * the same on all processes */
    virtual bool
    after_step(const Observation &now) = 0;

    /** Receives the state at which the run is interrupted, before end(). */
    virtual void
    interrupted(const Observation & /* now */)
    {
    }

    /** Receives the last state of a run that is done, interrupted or has failed. */
    virtual void
    end(const Observation & /* now */)
    {
    }

    /** The name under which checkpoints keep what save() returns; empty if there is nothing. */
    virtual std::string
    name() const
    {
      return "";
    }

    virtual nlohmann::json
    save() const;

    virtual void
    load(const nlohmann::json &saved);

    /** A vector that checkpoints keep too, or null. */
    virtual Vector *
    kept_vector()
    {
      return nullptr;
    }
  };


  /** The listeners of a run, called in the order in which they were added. */
  class Listeners
  {
  public:
    /** @param listener must live as long as the run; null adds none */
    void
    add(Listener *listener);

    /** The first objection; empty if there is none. */
    std::string
    objection(const Observation &now) const;

    void
    begin(const Observation &now, bool resumed) const;

    /** @return whether all say that the run may go on */
    bool
    after_step(const Observation &now) const;

    void
    interrupted(const Observation &now) const;

    void
    end(const Observation &now) const;

    /** Puts what each listener keeps into an object, by its name. */
    void
    save(nlohmann::json &kept) const;

    /** Gives each listener its part of what save() has put together, if it is there. */
    void
    load(const nlohmann::json &kept) const;

    std::vector<Vector *>
    kept_vectors() const;

  private:
    std::vector<Listener *> list;
  };
} // namespace Supple

#endif
