#ifndef supple_study_parameters_h
#define supple_study_parameters_h

#include <supple/scene/task_parameters.h>

#include <functional>
#include <string>
#include <vector>

namespace Supple
{
  /** What a study file says: subsection Study, and nothing else. */
  struct StudyParameters : TaskParameters
  {
    // One of these three says what is compared, or methods and levels together.
    std::string methods;
    std::string levels;
    std::string cases;

    std::string reference_level; ///< with methods and levels

    std::string aim; ///< as written; then one run is looked for, and nothing is compared
    std::string aim_of;
    bool aim_with_mesh = false; ///< the error in space is part of the aim
    std::string variants;
    std::string reference;
    std::string exact;
    std::string quantities = "probes";
    std::string columns;
    std::string right_if;
    unsigned int repeats        = 3;
    std::vector<double> targets = {0.1, 0.01, 0.001};
    bool histories              = true;

    StudyParameters();

    /** Whether a file is a study and not a scene: it has a subsection Study. @throws InputError */
    static bool
    is_study(const std::string &file);

    /**
     * Reads a study. Overrides of subsection Study change it, all others go to its runs.
     * @throws InputError
     */
    static StudyParameters
    read(const std::string &file, const std::vector<Override> &overrides);

    /**
     * The aim of a scene that is no study: its run is looked for.
     * @param overrides among them Study/Aim. Those of subsection Study change the search, all
     * others go to its runs.
     * @throws InputError
     */
    static StudyParameters
    aim_of_scene(const std::string &file, const std::vector<Override> &overrides);

    /** The aim as a part of what the error is relative to. @throws InputError if it is no
     * percentage, or makes no sense */
    double
    relative_aim() const;

    void
    declare(dealii::ParameterHandler &prm);

  private:
    /** Those that @p parse gives to the entries. @throws InputError */
    static StudyParameters
    checked(const std::function<void(StudyParameters &, dealii::ParameterHandler &)> &parse);

    void
    declare_aim(dealii::ParameterHandler &prm);

    /** @throws InputError */
    void
    check_aim() const;

    void
    declare_runs(dealii::ParameterHandler &prm);

    /** What the runs are measured against. */
    void
    declare_references(dealii::ParameterHandler &prm);

    void
    declare_errors(dealii::ParameterHandler &prm);

    void
    check() const;
  };
} // namespace Supple

#endif
