#ifndef supple_contact_h
#define supple_contact_h

#include <supple/contact/contact_pairs.h>
#include <supple/contact/contact_search.h>
#include <supple/contact/friction.h>
#include <supple/contact/tool_report.h>
#include <supple/forces/force.h>
#include <supple/mechanics/constraints.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace Supple
{
  /**
   * The force by which rigid tools keep the body out, and bodies each other and themselves. With
   * the gaps g between points of the surface and what they meet it is minus the gradient of
   *
   *   B = kappa sum w b(g),
   *
   * with the barrier b, areas w at rest, and a stiffness kappa [Pa] that stays what it is. No gap
   * may become zero on the way from one state to the next: see safe_part().
   *
   * Friction is that of the touches at the start of a step (Friction); it has no energy that it
   * gives back.
   *
   * A tool touches up to three nodes of a face at once, which share a cell: the pattern of the
   * operator stays as it is. A pair of the surface with itself couples up to six nodes of
   * different cells: when the pattern lacks two of them, it is made anew, with all pairs of what is
   * near. The tangent is definite in all of its kinds.
   */
  class Contact : public Force
  {
  public:
    /** @throws InputError */
    Contact(const Body &body,
            const ContactParameters &parameters,
            const std::vector<ToolParameters> &tools,
            const ParameterFile &scene);

    std::string
    name() const override
    {
      return "contact";
    }

    EnergyAccount
    account() const override
    {
      return EnergyAccount::contact;
    }

    bool
    is_load() const override
    {
      return false;
    }

    bool
    is_linear() const override
    {
      return false;
    }

    bool
    has_tangent() const override
    {
      return true;
    }

    /** With the tools where the passage of the configuration has them, whatever the time. */
    void
    add_force(const Configuration &configuration, double time, double *f) const override;

    /** That of the barrier. */
    double
    energy(const Configuration &configuration, double time) const override;

    /** To be called before a step is computed: takes the touches that friction acts in. */
    void
    begin_step(const Configuration &configuration);

    /** Energy of the barrier and potential of friction: that of which the force is the gradient;
     * this process's part [J]. */
    double
    potential(const Configuration &configuration) const;

    /** What friction has turned into heat in this step; collective [J]. */
    double
    rubbed(const Configuration &configuration) const;

    /** The greatest speed at which a place creeps that friction holds; collective [m/s]. */
    double
    creep(const Configuration &configuration) const;

    void
    add_couplings(Couplings &couplings) const override;

    bool
    couplings_come_and_go() const override
    {
      return bodies != ContactParameters::Bodies::tools;
    }

    bool
    couplings_have_changed() const override
    {
      return pattern_is_old;
    }

    void
    connect(const SymmetricPattern &pattern) override;

    void
    update_tangent(Tangent tangent,
                   const Configuration &configuration,
                   double time,
                   double part) override;

    void
    add_product(const Configuration &configuration,
                const TangentFactors &factors,
                const double *w,
                double *y) const override;

    void
    add_tangent(const Configuration &configuration,
                const TangentFactors &factors,
                SymmetricBlockMatrix &A) const override;

    /** f += what the force changes by, to first order, when the tools go on to a part of their way.
     */
    void
    add_advance(const Configuration &configuration, double part, double *f) const;

    /** Whether a tool has another pose at the end of a passage than at its beginning. */
    bool
    tools_move(const Passage &passage) const;

    /** Whether the barrier acts anywhere, or friction; collective. */
    bool
    acts(const Configuration &configuration) const;

    /** Whether the last update_tangent() found anything to act; collective. */
    bool
    has_stiffness() const;

    /**
     * The largest part, up to 1, of a way of all nodes [m] on which no gap falls below a tenth of
     * what it is, while the tools go on to a part of theirs: by steps as long as the distance
     * allows, the additive continuous collision detection of Li, Kaufman and Jiang, ACM Trans.
     * Graphics 40 (2021) 104. Collective.
     */
    double
    safe_part(const Configuration &configuration, const Vector &way, double part) const;

    /** What the tools meet; collective. */
    std::vector<ToolReport>
    reports(const Configuration &configuration) const;

    /** The least gap of the surface to itself [m]; none if nothing of it is within the reach of the
     * barrier. Collective. */
    std::optional<double>
    own_gap(const Configuration &configuration) const;

    /** What each tool does on its way in a step, with its force at the start taken by @p weight and
     * that at the end by the rest; collective [J]. */
    std::vector<double>
    works(const Configuration &configuration, double weight) const;

    /**
     * The pressure of all that touches, as the first of the three numbers of each node [Pa]: the
     * force on the node over its share of the faces of cells that touch, so that an edge between
     * such a face and another has its whole pressure. Where a guard alone acts, over its share of
     * all faces. On quadratic cells, whose corners bear nothing of an even pressure, it is the mean
     * of such means of the faces around. Collective.
     */
    Vector
    pressure(const Configuration &configuration) const;

    /** What a user should know of the start, in sentences; collective.
     * @throws InputError if the body or a part of it is within a tool or another body, or the other
     * way round */
    std::vector<std::string>
    check_start(const Configuration &configuration, const ParameterFile &scene) const;

    /** @throws ComputationError if a vertex that is held in all directions ends within a tool:
     * there is no such state. Collective. */
    void
    require_room(const Passage &passage, const Constraints &constraints) const;

    /** @throws ComputationError if two places of the surface that are held or moved as prescribed
     * are on their way into each other, and as good as there. Of one process. */
    void
    require_room_between(const Configuration &configuration, const Constraints &constraints) const;

    /** For messages: what is nearest to what, where, and how near; empty if nothing is. Collective.
     */
    std::string
    nearest_in_words(const Configuration &configuration) const;

    /** How hard steps with friction were to find. */
    struct Trouble
    {
      unsigned int most_corrections = 0;  ///< of Newton's, for a stage
      unsigned int n_failed         = 0;  ///< stages that had to be done again in other steps
      double fastest_slip           = 0.; ///< [m/s]
    };

    const Trouble &
    trouble() const
    {
      return of_friction;
    }

    /** To be called when a stage has been found; collective. */
    void
    note_found(const Configuration &configuration, unsigned int n_corrections);

    /** To be called when no stage has been found. */
    void
    note_failed();

    double
    slip_resolution() const
    {
      return friction.slip_resolution;
    }

    /** Of the barrier between bodies [m]. */
    double
    reach_between_bodies() const
    {
      return reach;
    }

    /** The largest angle by which each tool has turned within a step so far [rad]. */
    const std::vector<double> &
    turns_within_steps() const
    {
      return largest_turns;
    }

    const std::vector<Tool> &
    all_tools() const
    {
      return tools;
    }

  private:
    /** The place of the surface that is nearest to a tool. */
    struct Nearest
    {
      double gap;          ///< [m]
      double edge;         ///< the longest there [m]
      unsigned int vertex; ///< one there, by its index in the mesh
    };

    /** Collective. @param u displacement of all local nodes [m] */
    Nearest
    nearest(const double *u, const PlacedTool &tool) const;

    std::vector<Pose>
    poses(const Passage &passage) const;

    /** @param u displacement of all local nodes [m] */
    std::vector<ContactPair>
    pairs(const double *u, const Passage &passage) const;

    /** Takes all that is near as what the pattern must couple, if a pair of the surface with itself
     * is not coupled. */
    void
    renew_couplings(const std::vector<ContactPair> &pairs,
                    const std::vector<Friction::Slip> &slips,
                    const Candidates &near);

    /** As safe_part(), of one tool and on this process. */
    double
    safe_part_at(const Tool &tool,
                 const SurfaceMotion &motion,
                 const ToolMotion &of_tool,
                 const Candidates &candidates) const;

    /** As safe_part(), of the surface with itself. */
    double
    safe_part_of_bodies(const SurfaceMotion &motion, const Candidates &candidates) const;

    /** Whether the body has this place within a cell; this process's part. */
    bool
    body_contains(const double *u, const Arrow &place) const;

    /** @param nearest place of the body to the tool @throws InputError if one is within the other
     */
    void
    require_clear(const double *u,
                  const PlacedTool &placed,
                  const Tool &tool,
                  const Nearest &nearest,
                  const ParameterFile &scene) const;

    /** Of a tool that is outside, in sentences. */
    static void
    add_warnings(std::vector<std::string> &warnings,
                 const PlacedTool &placed,
                 const Tool &tool,
                 const Nearest &nearest);

    /** @throws InputError if the surface crosses itself, or a piece is within another */
    void
    require_no_crossing(const double *u, const ParameterFile &scene) const;

    /** Adds what the forces at the end of a step, or at its start, do on the way of the tools. */
    void
    add_works(std::vector<double> &works,
              const Vector &displacement,
              const Passage &step,
              bool at_end,
              double weight) const;

    void
    note_turns(const Passage &passage);

    std::vector<Friction::Slip>
    slips(const double *u, const Passage &passage) const;

    /** A part of the surface with its piece, its boundary and a vertex. */
    std::string
    in_words(const SurfacePart &part) const;

    /** The pair of the surface with itself whose gap is least; nothing if none is within the reach.
     */
    std::optional<ContactPair>
    nearest_own_pair(const Configuration &configuration) const;

    /** kappa w f: what multiplies the barrier of a pair [N/m]. */
    double
    factor(const ContactPair &pair) const
    {
      return stiffness * pair.weight * pair.factor;
    }

    /** Without the factor of pairs that are parallel [J]. */
    double
    energy_of(const ContactPair &pair) const;

    /** What the couple between two edges that are almost parallel does where the tool turns [J]. */
    double
    turning_work(const ContactPair &pair,
                 const Pose &now,
                 const Pose &first,
                 const Pose &last) const;

    /** On the surface [N]. */
    Arrow
    force_of(const ContactPair &pair) const;

    /** f += the force of a pair on its nodes. */
    void
    add_force(const ContactPair &pair, double *f) const;

    /** f += the force at the place of a pair on its nodes. */
    static void
    spread(const ContactPair &pair, const Arrow &force, double *f);

    struct Stiffness
    {
      unsigned int n;
      std::array<unsigned int, 6> nodes;
      PairMatrix matrix; ///< [N/m]
    };

    const Body &body;
    const double stiffness; ///< kappa [Pa]
    const ContactParameters::Bodies bodies;
    ContactSurface surface;
    const double reach; ///< of the barrier between bodies [m]
    std::vector<Tool> tools;
    PairFinder finder;
    mutable ContactSearch search;
    std::vector<Stiffness> tangent;
    Friction friction;
    std::vector<double> largest_turns; ///< within a step, of each tool [rad]
    Trouble of_friction;
    Couplings coupled; ///< of the surface with itself, ascending
    bool pattern_is_old = false;
  };
} // namespace Supple

#endif
