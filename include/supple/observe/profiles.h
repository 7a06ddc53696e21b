#ifndef supple_profiles_h
#define supple_profiles_h

#include <supple/mechanics/body.h>
#include <supple/observe/probe_parameters.h>

#include <string>
#include <vector>

namespace Supple
{
  /** Shapes of boundaries, as the rows of profile_NAME.csv: one for each vertex of the boundary. */
  class Profiles
  {
  public:
    /** @throws InputError if a profile is written wrongly or the body has no such boundary; @p
     * scene knows where the entries were set */
    Profiles(const Body &body, const ProbeParameters &parameters, const ParameterFile &scene);

    bool
    empty() const
    {
      return profiles.empty();
    }

    std::vector<std::string>
    names() const;

    static std::vector<std::string>
    column_names();

    /** The number of a profile; as many as there are if none has this name. */
    unsigned int
    number(const std::string &name) const;

    /**
     * Rows of one profile, on the first process. Vertices of a plane body stand in the order of
     * their x at rest, others in that of their distance from the center at rest.
     */
    std::vector<std::vector<double>>
    rows(unsigned int profile, unsigned int step, double time, const Vector &displacement) const;

  private:
    struct Profile
    {
      std::string name;
      std::vector<unsigned int> nodes; ///< owned by this process
    };

    /** From the center, seen from above [m]. */
    double
    distance(const dealii::Point<3> &point) const;

    const Body &body;
    const dealii::Point<3> center;
    std::vector<Profile> profiles;
  };
} // namespace Supple

#endif
