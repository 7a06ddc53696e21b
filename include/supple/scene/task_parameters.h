#ifndef supple_task_parameters_h
#define supple_task_parameters_h

#include <supple/scene/parameters.h>

#include <string>
#include <vector>

namespace Supple
{
  /** Parts of a text set apart by @p separator outside of brackets. Doubled, the separator is an
   * operator of an expression and does not count. */
  std::vector<std::string>
  split_outside_brackets(const std::string &text, char separator);


  /** "Section/Entry=value | Section/Entry=value", taken apart. @param place of what is wrong in it
   */
  std::vector<Override>
  override_list(const std::string &text, const std::string &place);


  /**
   * What files have in common that ask for many runs of one scene, a study and an identification:
   * they have one subsection and no other, and name the scene in it.
   */
  struct TaskParameters
  {
    std::string scene; ///< parameter file, as written; relative to the folder of this one
    std::string overrides;

    std::string name;                   ///< of the file, without folder and ending
    std::vector<Override> command_line; ///< what is set in all runs beside the overrides

    /** The scene with the overrides, those of the command line, and last @p more.
     * @throws InputError */
    Parameters
    read_scene(const std::vector<Override> &more = {}) const;

    /** The scene's file and the overrides, for a report. */
    std::string
    scene_in_words() const;

    /** A file it names, from where the program was started. */
    std::string
    path(const std::string &as_written) const;

    /** Where an entry got its value, to begin a message with. */
    std::string
    place(const std::string &entry) const;

    /** Where results go unless the command line says otherwise: output/ and the name. */
    std::string
    output_folder() const;

  protected:
    explicit TaskParameters(const std::string &subsection);

    /** Gives all entries to @p prm. Of the overrides, those of the own subsection change it and
     * all others go to the scene. @throws InputError */
    void
    parse(dealii::ParameterHandler &prm,
          const std::string &file,
          const std::vector<Override> &overrides);

    /** The same of a task that has no file but that of its scene. @throws InputError */
    void
    parse_for_scene(dealii::ParameterHandler &prm,
                    const std::string &scene_file,
                    const std::vector<Override> &overrides);

  private:
    void
    parse_rest(dealii::ParameterHandler &prm, const std::vector<Override> &overrides);

    std::string subsection;
    ParameterFile file;
  };
} // namespace Supple

#endif
