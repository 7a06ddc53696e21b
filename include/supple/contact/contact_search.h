#ifndef supple_contact_search_h
#define supple_contact_search_h

#include <supple/contact/candidates.h>

namespace Supple
{
  /** Candidates of each tool, and those of the surface with itself. */
  struct AllCandidates
  {
    std::vector<Candidates> of_tools;
    Candidates own;
  };


  /**
   * Finds what may touch. The candidates of a state serve for others too, until something has moved
   * by more than a margin: most states of a slow motion need no search.
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

    /** All that is within the reach of the barriers. Valid until called again.
     * @param u displacement of all local nodes [m] */
    const AllCandidates &
    near(const double *u, const std::vector<Pose> &poses);

    /** All whose gaps fall below the reach somewhere on a way. Valid until something is called
     * again. @param way of all local nodes [m] */
    const AllCandidates &
    on_way(const double *u, const double *way, const std::vector<ToolMotion> &tools);

    /** All faces whose distance may be less than a margin beside the reach. */
    Candidates
    own(const double *u, double margin) const;

  private:
    /** How much distances to a tool may have changed since its search [m].
     * @param way of all local nodes [m]; null: none */
    double
    change(unsigned int tool, const double *u, const double *way, const Pose &pose) const;

    double
    own_change(const double *u, const double *way) const;

    const ContactSurface &surface;
    const std::vector<Tool> &tools;
    const double reach; ///< [m]
    const ContactParameters::Bodies bodies;
    const double margin; ///< [m]

    AllCandidates lists, lists_of_way;

    /** Where all was when they were found; of each tool, and last of the surface alone. */
    std::vector<std::vector<Arrow>> places; ///< displacements of the nodes of the surface [m]
    std::vector<Pose> poses;
  };
} // namespace Supple

#endif
