#include <supple/live/words.h>

#include <supple/base/error.h>

#include <cmath>
#include <cstdlib>

namespace Supple
{
  using dealii::Tensor;

  Words::Words(const std::string &text)
    : text(text)
    , words(text)
  {
  }


  std::string
  Words::word(const std::string &what)
  {
    std::string found;
    if (!(words >> found))
      refuse(what + " is missing");
    return found;
  }


  void
  Words::expect(const std::string &wanted)
  {
    if (const std::string found = word("'" + wanted + "'"); found != wanted)
      refuse("found '" + found + "' where '" + wanted + "' must be");
  }


  double
  Words::number(const std::string &what)
  {
    const std::string found = word(what);
    char *end;
    const double value = std::strtod(found.c_str(), &end);
    if (*end != '\0' || !std::isfinite(value))
      refuse(what + " is '" + found + "', not a finite number");
    return value;
  }


  unsigned int
  Words::vertex()
  {
    constexpr double most = 4e9;

    const double value = number("the index of a vertex");
    if (value < 0. || value != std::floor(value) || value > most)
      refuse("the index of a vertex must be a whole number");
    return static_cast<unsigned int>(value);
  }


  Tensor<1, 3>
  Words::place()
  {
    Tensor<1, 3> place;
    for (unsigned int i = 0; i < 3; ++i)
      place[i] = number(std::string("coordinate ") + "xyz"[i]);
    return place;
  }


  double
  Words::duration()
  {
    expect("over");
    const double duration = number("a duration");
    if (duration <= 0.)
      refuse("a duration must be greater than 0");
    return duration;
  }


  std::string
  Words::rest()
  {
    std::string rest;
    std::getline(words >> std::ws, rest);
    return rest;
  }


  void
  Words::expect_end()
  {
    if (const std::string more = rest(); !more.empty())
      refuse("nothing more may follow, and there is '" + more + "'");
  }


  void
  Words::refuse(const std::string &why) const
  {
    throw InputError("\"" + text + "\": " + why + ".");
  }
} // namespace Supple
