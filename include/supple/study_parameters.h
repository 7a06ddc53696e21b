#ifndef supple_study_parameters_h
#define supple_study_parameters_h

#include <supple/parameter_file.h>

#include <string>
#include <vector>

namespace Supple
{
  /** What a study file says: subsection Study, and nothing else. */
  struct StudyParameters
  {
    std::string scene; ///< parameter file, as written; relative to the folder of the study
    std::string overrides;

    // One of these three says what is compared.
    std::string methods;
    std::string levels;
    std::string cases;

    std::string variants;
    std::string reference;
    std::string exact;
    std::string quantities = "probes";
    std::string columns;
    std::string right_if;
    unsigned int repeats        = 3;
    std::vector<double> targets = {0.1, 0.01, 0.001};
    bool histories              = true;

    std::string name;                   ///< of the file, without folder and ending
    std::vector<Override> command_line; ///< what is set in all runs beside the overrides

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

    /** The scene's file, from where the program was started. */
    std::string
    scene_file() const;

    /** Where an entry of subsection Study got its value, to begin a message with. */
    std::string
    place(const std::string &entry) const;

  private:
    void
    declare_runs(dealii::ParameterHandler &prm);

    void
    declare_errors(dealii::ParameterHandler &prm);

    void
    check() const;

    ParameterFile file;
  };
} // namespace Supple

#endif
