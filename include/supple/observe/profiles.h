#ifndef supple_profiles_h
#define supple_profiles_h

#include <supple/base/csv_file.h>
#include <supple/mechanics/body.h>
#include <supple/observe/probe_parameters.h>

#include <nlohmann/json_fwd.hpp>

#include <memory>
#include <string>
#include <vector>

namespace Supple
{
  /** Shapes of boundaries: profile_NAME.csv has a row for each vertex of the boundary at each of
   * the steps that are wanted. */
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

    /** Makes the files, or goes on with those of load(); on the first process alone.
     * @throws WriteError */
    void
    open(const std::string &folder, bool resumed);

    /** What a checkpoint has to keep of it, on the first process. */
    nlohmann::json
    save() const;

    void
    load(const nlohmann::json &saved);

    /** Writes the state, unless it was written already; always, or if it is the turn of this step.
     * @throws WriteError on the first process */
    void
    write(unsigned int step, double time, const Vector &displacement, bool always);

  private:
    struct Profile
    {
      std::string name;
      std::vector<unsigned int> nodes; ///< owned by this process
      unsigned long n_rows = 0;        ///< written; counts on the first process
      std::unique_ptr<CsvFile> file;
    };

    /** From the center, seen from above [m]. */
    double
    distance(const dealii::Point<3> &point) const;

    const Body &body;
    const dealii::Point<3> center;
    const unsigned int every;
    std::vector<Profile> profiles;
    bool written                   = false;
    unsigned int last_written_step = 0;
  };
} // namespace Supple

#endif
