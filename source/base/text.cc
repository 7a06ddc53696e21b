#include <supple/base/text.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace Supple
{
  namespace
  {
    std::string
    in_small_letters(std::string text)
    {
      std::transform(text.begin(), text.end(), text.begin(), [](const unsigned char letter) {
        return std::tolower(letter);
      });
      return text;
    }


    /** How many letters must be inserted, left out or exchanged to make one text of the other. */
    std::size_t
    distance(const std::string &one, const std::string &other)
    {
      // Of the beginning of the one to each beginning of the other.
      std::vector<std::size_t> row(other.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 0; i < one.size(); ++i)
        {
          std::size_t diagonal = row[0]++;
          for (std::size_t j = 0; j < other.size(); ++j)
            {
              const std::size_t exchanged = diagonal + (one[i] != other[j]);
              diagonal                    = row[j + 1];
              row[j + 1]                  = std::min({row[j] + 1, row[j + 1] + 1, exchanged});
            }
        }
      return row.back();
    }
  } // namespace


  std::string
  did_you_mean(const std::string &given, const std::vector<std::string> &known)
  {
    const std::string small   = in_small_letters(given);
    const std::size_t at_most = std::min<std::size_t>(2, small.size() / 3);
    std::size_t smallest      = 3;
    std::vector<std::string> nearest;
    for (const std::string &name : known)
      {
        const std::string other = in_small_letters(name);
        const bool begins       = small.size() > 1 && other.rfind(small, 0) == 0;
        const std::size_t far   = begins ? 1 : distance(small, other);
        if (far > smallest || (far > at_most && !begins))
          continue;
        if (far < smallest)
          nearest.clear();
        smallest = far;
        nearest.push_back(name);
      }
    return nearest.size() == 1 ? "; did you mean '" + nearest.front() + "'?" : ".";
  }
} // namespace Supple
