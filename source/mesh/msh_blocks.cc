#include <supple/mesh/msh_blocks.h>

#include <supple/base/error.h>
#include <supple/base/files.h>
#include <supple/base/packed_number.h>

#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <unordered_map>

namespace Supple
{
  namespace
  {
    class MshBlocks
    {
    public:
      MshBlocks(const std::string &file, const MshFormat &format)
        : format(format)
        , is_old(format.version < 4.1)
        , text(content_of(file))
      {
      }

      void
      check_nodes()
      {
        if (!find("$Nodes"))
          return;
        const auto [n_blocks, n] = read_counts();
        std::size_t n_found      = 0;
        for (std::size_t block = 0; block < n_blocks; ++block)
          n_found += check_nodes_of_block();
        require("nodes", n, n_found);
      }

      /** @return how many there are; 0 if not all kinds are known */
      std::size_t
      check_elements()
      {
        if (!find("$Elements"))
          return 0;
        const auto [n_blocks, n] = read_counts();
        std::size_t n_found      = 0;
        for (std::size_t block = 0; block < n_blocks; ++block)
          {
            const Block head       = read_head();
            const unsigned n_nodes = n_nodes_of_kind(head.kind);
            if (n_nodes == 0)
              return 0;
            for (std::size_t e = 0; e < head.n; ++e)
              for (unsigned int i = 0; i <= n_nodes; ++i)
                number_of_item();
            n_found += head.n;
          }
        require("elements", n, n_found);
        return n_found;
      }

    private:
      struct Block
      {
        long dimension, kind;
        std::size_t n;
      };

      const MshFormat format;
      const bool is_old; ///< version 4.0
      const std::string text;
      std::size_t position = 0;
      std::unordered_map<std::size_t, dealii::Point<3>> places;

      /** Goes to the line after the one that begins a section. */
      bool
      find(const std::string &head)
      {
        for (position = 0; (position = text.find("\n" + head, position)) != std::string::npos;)
          {
            position += head.size() + 1;
            const auto end = text.find('\n', position);
            if (end != std::string::npos && text.find_first_not_of(" \t\r", position) == end)
              {
                position = end + 1;
                return true;
              }
          }
        return false;
      }

      template <class Number>
      Number
      next()
      {
        if (!format.binary)
          {
            char *end          = nullptr;
            const double value = std::strtod(text.c_str() + position, &end);
            if (end == text.c_str() + position)
              throw InputError("of $Nodes or $Elements not all numbers are there.");
            position = end - text.c_str();
            return static_cast<Number>(value);
          }
        if (text.size() - position < sizeof(Number))
          throw InputError("the file ends before all that it announces is there.");
        position += sizeof(Number);
        return packed_number<Number>(&text[position - sizeof(Number)], format.swapped);
      }

      std::size_t
      number_of_item()
      {
        return is_old ? next<std::int32_t>() : next<std::uint64_t>();
      }

      /** Of blocks, and of items in all of them. */
      std::pair<std::size_t, std::size_t>
      read_counts()
      {
        const std::size_t n_blocks = next<std::uint64_t>(), n = next<std::uint64_t>();
        if (!is_old) // the least and the largest number
          for (unsigned int i = 0; i < 2; ++i)
            next<std::uint64_t>();
        return {n_blocks, n};
      }

      Block
      read_head()
      {
        const long first = next<std::int32_t>(), second = next<std::int32_t>();
        const long kind = next<std::int32_t>();
        return {is_old ? second : first, kind, next<std::uint64_t>()};
      }

      dealii::Point<3>
      read_place(const long n_parameters)
      {
        dealii::Point<3> place;
        for (unsigned int d = 0; d < 3; ++d)
          place[d] = next<double>();
        for (long i = 0; i < n_parameters; ++i)
          next<double>();
        return place;
      }

      /** Version 4.1 has the numbers of all nodes before their places. */
      std::size_t
      check_nodes_of_block()
      {
        const Block head        = read_head();
        const long n_parameters = head.kind != 0 ? head.dimension : 0;
        std::vector<std::size_t> numbers;
        for (std::size_t i = 0; i < head.n && !is_old; ++i)
          numbers.push_back(number_of_item());
        for (std::size_t i = 0; i < head.n; ++i)
          {
            const std::size_t number     = is_old ? number_of_item() : numbers[i];
            const dealii::Point<3> place = read_place(n_parameters);
            const auto [found, is_new]   = places.emplace(number, place);
            if (!is_new && found->second != place)
              throw InputError("the node " + std::to_string(number) +
                               " is given twice, at two places.");
          }
        return head.n;
      }

      void
      require(const std::string &of, const std::size_t announced, const std::size_t found)
      {
        while (position < text.size() && std::isspace(static_cast<unsigned char>(text[position])))
          ++position;
        const bool has_more = position < text.size() && text[position] != '$';
        if (found != announced || has_more)
          throw InputError("the file announces " + std::to_string(announced) + " " + of +
                           ", but has " + (has_more ? "more" : std::to_string(found)) + ".");
      }
    };
  } // namespace


  std::size_t
  check_msh_blocks(const std::string &file, const MshFormat &format)
  {
    MshBlocks blocks(file, format);
    blocks.check_nodes();
    return blocks.check_elements();
  }
} // namespace Supple
