#ifndef supple_contact_search_h
#define supple_contact_search_h

#include <supple/contact/candidates.h>

namespace Supple
{
  /** Candidates of each tool, and those of the surface with itself. */
  struct AllCandidates
  {
    std::vector<Candidates> of_tools;
    const Candidates *own;
  };


  /**
   * Finds what may touch. What was found for a way serves for all states and ways that are not
   * farther from it than a margin: most iterations, and steps of a slow motion, need no search.
   */
  class ContactSearch
  {
  public:
    /**
     * @param tools  must outlive this
     * @param reach  of the barrier between bodies [m]
     * @param bodies what bodies meet
     */
    ContactSearch(const ContactSurface &surface,
                  const std::vector<Tool> &tools,
                  double reach,
                  ContactParameters::Bodies bodies);

    /** All whose gaps fall below the reach of their barrier somewhere on a way; others are among
     * them. Valid until called again. */
    const AllCandidates &
    find(const SurfaceMotion &motion, const std::vector<ToolMotion> &tools);

    /** The same of a state. */
    const AllCandidates &
    find(const double *u, const std::vector<Pose> &poses);

    /** All of the surface with itself that are nearer than the reach. */
    Candidates
    own(const double *u) const;

  private:
    /** A way that was searched. */
    struct Searched
    {
      std::vector<Arrow> start; ///< displacements of the nodes of the surface [m]
      std::vector<Arrow> way;   ///< of these nodes [m]; none: they stay
      ToolMotion tool;          ///< none of the surface with itself
      double margin = 0.;       ///< [m]
    };

    /** Which part of a searched way is nearest to a state. */
    double
    nearest_part(const Searched &searched, const std::vector<Arrow> &u, const Pose *pose) const;

    /** Whether a state is no farther from the searched way than its margin.
     * @param tool null for the surface with itself */
    bool
    covers(const Searched &searched,
           const std::vector<Arrow> &u,
           const Tool *tool,
           const Pose &pose) const;

    void
    search_tool(unsigned int tool, const SurfaceMotion &motion, const ToolMotion &way);

    /** Of a state, among what was found for a way if that covers it. */
    void
    search_own_state(const double *u);

    void
    search_own_way(const SurfaceMotion &motion);

    /** Remembers what is searched. */
    void
    keep(Searched &searched, const SurfaceMotion &motion) const;

    /** Less than between the tool and the body on a whole way [m]. */
    double
    least_distance(const Tool &tool, const Searched &searched) const;

    const ContactSurface &surface;
    const std::vector<Tool> &tools;
    const double reach; ///< [m]
    const ContactParameters::Bodies bodies;
    const double margin; ///< [m]

    AllCandidates lists;
    std::vector<Searched> searched_of_tools;

    /** Of a way there are many more of the surface with itself than of a state. */
    Candidates own_of_state, own_of_way;
    Searched searched_own_state, searched_own_way;
    std::vector<Arrow> start, end; ///< at hand [m]
  };
} // namespace Supple

#endif
