#ifndef supple_probes_h
#define supple_probes_h

#include <supple/mechanics/configuration.h>
#include <supple/mechanics/constraint_parameters.h>
#include <supple/observe/probe_parameters.h>

#include <map>
#include <string>
#include <vector>

namespace Supple
{
  /** Followed vertices, boundaries, regions and motions: what stands in probes.csv. */
  class Probes
  {
  public:
    /** @throws InputError if a probe is written wrongly or selects nothing; @p scene knows where
     * the entries were set */
    Probes(const Body &body,
           const ProbeParameters &parameters,
           const Motions &motions,
           const ParameterFile &scene);

    bool
    empty() const
    {
      return probes.empty();
    }

    std::vector<std::string>
    column_names() const;

    /** Displacement [m], velocity [m/s] and reaction [N] of each probe, nine numbers each. */
    std::vector<double>
    values(const State &state, const Vector &reactions) const;

    /** A component of the displacement of a probe: the sum of these entries times a weight. */
    struct Component
    {
      std::string name;               ///< as in column_names()
      std::vector<unsigned int> dofs; ///< owned by this process
      double weight;                  ///< one over the number of vertices
    };

    /** Three for each probe, one after the other. */
    std::vector<Component>
    displacement_components() const;

    /** A line for each probe: which vertex was taken and how far it is, or how many vertices it
     * has. */
    std::vector<std::string>
    descriptions() const;

    /** Where at rest the nodes are that points choose, by the names of the probes [m]. */
    const std::map<std::string, dealii::Point<3>> &
    places_of_points() const
    {
      return chosen;
    }

    /** Which points are outside of the body, in sentences. */
    const std::vector<std::string> &
    warnings() const
    {
      return points_outside;
    }

  private:
    struct Probe
    {
      std::string name;
      std::string description;
      std::vector<unsigned int> nodes; ///< owned by this process
      unsigned int n_nodes;            ///< on all processes
    };

    /** What a motion moves is followed too: its reaction is the force that the motion takes. */
    void
    add_motion(const std::string &of, unsigned int motion, const ParameterFile &scene);

    void
    add_point(const std::string &name, const std::string &text, const std::string &origin);

    void
    add_vertex(const std::string &name, const std::string &text, const std::string &origin);

    void
    add_nodes(const std::string &name, const std::string &what, const std::vector<bool> &nodes);

    void
    add(const std::string &name, const std::vector<bool> &nodes, const std::string &description);

    const Body &body;
    std::vector<Probe> probes;
    std::map<std::string, dealii::Point<3>> chosen; ///< some before, all at last
    std::vector<std::string> points_outside;
  };
} // namespace Supple

#endif
