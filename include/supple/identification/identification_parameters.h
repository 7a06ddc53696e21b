#ifndef supple_identification_parameters_h
#define supple_identification_parameters_h

#include <supple/identification/measurements.h>
#include <supple/identification/surface_response.h>
#include <supple/scene/task_parameters.h>

#include <string>
#include <vector>

namespace Supple
{
  /** What an identification file says: subsection Identification, and nothing else. All lengths in
   * it are in its unit. */
  struct IdentificationParameters : TaskParameters
  {
    enum class Unit
    {
      millimetre,
      metre
    };

    /** How the errors of all sets become one number. */
    enum class Total
    {
      sum,
      maximum,
      root_of_squares
    };

    std::string profile = "skin"; ///< name of one of the scene's profiles
    std::string measurements;     ///< CSV file, as written
    std::vector<unsigned int> sets;
    Unit unit = Unit::millimetre;

    std::vector<double> thicknesses;
    std::vector<double> ratios;
    SurfaceComparison comparison;
    std::vector<double> start_depths;

    bool fit         = false;
    Total fitted     = Total::root_of_squares;
    double tolerance = 0.1;

    std::vector<MeasuredSet> measured; ///< the sets that count

    IdentificationParameters();

    /** Whether a file is an identification and not a scene. @throws InputError */
    static bool
    is_identification(const std::string &file);

    /**
     * Reads an identification. Overrides of its subsection change it, all others go to the scene.
     * @throws InputError
     */
    static IdentificationParameters
    read(const std::string &file, const std::vector<Override> &overrides);

    void
    declare(dealii::ParameterHandler &prm);

    /** [m] */
    double
    unit_length() const;

    /** "mm" or "m" */
    std::string
    unit_name() const;

    /** The names of the totals, in their order. */
    static std::vector<std::string>
    total_names();

  private:
    void
    declare_comparison(dealii::ParameterHandler &prm);

    void
    declare_fit(dealii::ParameterHandler &prm);

    void
    check() const;

    /** What is set in each run can't be set on the command line. */
    void
    check_command_line() const;

    void
    check_start_depths() const;
  };
} // namespace Supple

#endif
