#ifndef supple_words_h
#define supple_words_h

#include <deal.II/base/tensor.h>

#include <sstream>
#include <string>

namespace Supple
{
  /** The words of a deed or a command, taken one after the other. What is wrong in them is told
   * with all of them. */
  class Words
  {
  public:
    explicit Words(const std::string &text);

    /** @throws InputError that @p what is missing */
    std::string
    word(const std::string &what);

    /** Takes this word. @throws InputError if it is another one */
    void
    expect(const std::string &wanted);

    /** @throws InputError if it is no finite number */
    double
    number(const std::string &what);

    /** The index of a vertex. @throws InputError if it is no whole number */
    unsigned int
    vertex();

    /** Three coordinates [m]. @throws InputError */
    dealii::Tensor<1, 3>
    place();

    /** The word "over" and a time above 0 [s]. @throws InputError */
    double
    duration();

    /** What is left. */
    std::string
    rest();

    /** @throws InputError if something is left */
    void
    expect_end();

    /** @throws InputError */
    [[noreturn]] void
    refuse(const std::string &why) const;

  private:
    const std::string text;
    std::istringstream words;
  };
} // namespace Supple

#endif
