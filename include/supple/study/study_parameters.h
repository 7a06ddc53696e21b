#ifndef supple_study_parameters_h
#define supple_study_parameters_h

#include <supple/scene/task_parameters.h>

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

    void
    declare(dealii::ParameterHandler &prm);

  private:
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
