#ifndef supple_parameter_file_h
#define supple_parameter_file_h

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>
#include <vector>

namespace Supple
{
  /** "Section/Entry=value", set on top of a parameter file, and who says so. */
  struct Override
  {
    std::string text;
    std::string place = "--set"; ///< or file:line of a study

    /** "Section/Entry"; of another text what is before its "=". */
    std::string
    entry() const;

    /** @throws InputError that it would change nothing, for each run of a @p task sets its entry,
     * at a place */
    [[noreturn]] void
    refuse(const std::string &task, const std::string &set_at) const;
  };


  /**
   * The text of a parameter file, and for each of its entries where it is set. What is wrong is
   * told with file, line, entry, what was found and what would be right.
   */
  class ParameterFile
  {
  public:
    ParameterFile() = default;

    /** @throws InputError if there is no such file, or nothing in it */
    explicit ParameterFile(const std::string &file);

    /** Its outermost subsections, and at which file:line they begin. */
    std::map<std::string, std::string>
    sections() const;

    /**
     * Gives all entries, and then the overrides, to @p prm, in which they are declared.
     * @throws InputError
     */
    void
    parse(dealii::ParameterHandler &prm, const std::vector<Override> &overrides);

    /** Where an entry ("Section/Entry") got its value: file:line, "--set", or the file where it is
     * not set. @throws std::logic_error if parse() knew no such entry: a name that is misspelled in
     * the program */
    std::string
    place(const std::string &entry) const;

    /** The same, and the value, or that it is not set in the scene: to begin a message with.
     * @throws std::logic_error as place() */
    std::string
    origin(const std::string &entry) const;

    /** Whether the scene gives an entry another value than it has by default. @throws
     * std::logic_error as place() */
    bool
    changes(const std::string &entry) const;

    /** The value of an entry, as it is written or as it is by default. @throws std::logic_error as
     * place() */
    std::string
    value(const std::string &entry) const;

    /** The name of the file without folder and ending. */
    std::string
    name() const;

    std::string
    folder() const;

    /**
     * Whether a file has a subsection that stands alone: Study or Identification, and then no
     * other.
     * @throws InputError if there are others beside it
     */
    static bool
    has_alone(const std::string &file, const std::string &section);

    /** Where entries and the outermost subsections stand. */
    struct Lines
    {
      std::map<std::string, std::string> entries;  ///< "Section/Entry" -> file:line
      std::map<std::string, std::string> sections; ///< "Section" -> file:line
    };

  private:
    void
    apply(dealii::ParameterHandler &prm, const Override &override);

    void
    require_declared(const std::string &entry) const;

    std::string file, text;
    Lines lines; ///< with those of included files
    std::map<std::string, std::string>
      defaults; ///< all entries with their defaults, once they are parsed
    std::map<std::string, std::string> places; ///< entry -> file:line or who else set it
    std::map<std::string, std::string> values; ///< entry -> value as text
  };
} // namespace Supple

#endif
