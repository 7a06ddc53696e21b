#include <supple/mesh/vtu_arrays.h>

#include <supple/base/error.h>
#include <supple/base/packed_number.h>

#include <zlib.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>

namespace Supple
{
  namespace
  {
    /** An array's name, for messages. */
    std::string
    name_of(const XmlElement &array)
    {
      return "the array " + array.attribute("Name");
    }


    /** Six bits of base64; -1 for what is no digit. */
    int
    digit(const char letter)
    {
      static const std::string digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      const auto found = digits.find(letter);
      return found == std::string::npos ? -1 : static_cast<int>(found);
    }


    /** Bytes that are taken from a text one after the other, raw or in base64. */
    class Bytes
    {
    public:
      Bytes(const std::string &text, const std::size_t begin, const bool is_base64, std::string of)
        : text(text)
        , position(begin)
        , is_base64(is_base64)
        , of(std::move(of))
      {
      }

      /** @throws InputError if there are fewer */
      std::string
      take(const std::size_t n)
      {
        if (n > text.size()) // before memory is asked for
          refuse();
        if (!is_base64)
          {
            if (position > text.size() || text.size() - position < n)
              refuse();
            position += n;
            return text.substr(position - n, n);
          }
        while (decoded.size() - taken < n)
          decode_four();
        taken += n;
        return decoded.substr(taken - n, n);
      }

    private:
      const std::string &text;
      std::size_t position;
      bool is_base64;
      std::string of, decoded;
      std::size_t taken = 0;

      [[noreturn]] void
      refuse() const
      {
        throw InputError(of + " ends before all its numbers are there.");
      }

      /** What is packed in two goes has padding in between. */
      void
      decode_four()
      {
        std::uint32_t bits    = 0;
        unsigned int n_digits = 0, n_letters = 0;
        for (; n_letters < 4; ++position)
          {
            if (position >= text.size())
              refuse();
            const char letter = text[position];
            if (std::isspace(static_cast<unsigned char>(letter)))
              continue;
            ++n_letters;
            bits <<= 6;
            if (letter == '=')
              continue;
            if (digit(letter) < 0)
              throw InputError(of + " is not in base64 ('" + std::string(1, letter) + "').");
            bits |= digit(letter);
            ++n_digits;
          }
        for (unsigned int byte = 0; byte + 1 < n_digits; ++byte)
          decoded.push_back(static_cast<char>(bits >> (16 - 8 * byte)));
      }
    };


    template <class Number>
    std::vector<double>
    numbers_as(const std::string &bytes, const bool swapped)
    {
      std::vector<double> values(bytes.size() / sizeof(Number));
      for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = packed_number<Number>(&bytes[i * sizeof(Number)], swapped);
      return values;
    }


    std::vector<double>
    numbers_of(const std::string &bytes, const XmlElement &array, const bool swapped)
    {
      const std::string type = array.attribute("type");
      if (type == "Float64")
        return numbers_as<double>(bytes, swapped);
      if (type == "Float32")
        return numbers_as<float>(bytes, swapped);
      if (type == "Int64")
        return numbers_as<std::int64_t>(bytes, swapped);
      if (type == "UInt64")
        return numbers_as<std::uint64_t>(bytes, swapped);
      if (type == "Int32")
        return numbers_as<std::int32_t>(bytes, swapped);
      if (type == "UInt32")
        return numbers_as<std::uint32_t>(bytes, swapped);
      if (type == "Int16")
        return numbers_as<std::int16_t>(bytes, swapped);
      if (type == "UInt16")
        return numbers_as<std::uint16_t>(bytes, swapped);
      if (type == "Int8")
        return numbers_as<std::int8_t>(bytes, swapped);
      if (type == "UInt8")
        return numbers_as<std::uint8_t>(bytes, swapped);
      throw InputError(name_of(array) + " has numbers of the type '" + type +
                       "', which are not read.");
    }


    std::vector<double>
    written_numbers(const XmlElement &array)
    {
      std::vector<double> values;
      for (const char *from = array.text.c_str(); *from != '\0';)
        {
          if (std::isspace(static_cast<unsigned char>(*from)))
            {
              ++from;
              continue;
            }
          char *end          = nullptr;
          const double value = std::strtod(from, &end);
          if (end == from)
            throw InputError("in " + name_of(array) + " a number is '" +
                             std::string(from)
                               .substr(0, std::string(from).find_first_of(" \t\r\n"))
                               .substr(0, 20) +
                             "'.");
          values.push_back(value);
          from = end;
        }
      return values;
    }


    std::string
    unpacked(const std::string &block, const std::size_t size, const std::string &of)
    {
      // zlib packs at most about a thousand bytes into one.
      if (size > 1100 * block.size() + 1000)
        throw InputError("a block of " + of + " is damaged.");
      std::string bytes(size, '\0');
      uLongf n = size;
      if (uncompress(reinterpret_cast<Bytef *>(bytes.data()),
                     &n,
                     reinterpret_cast<const Bytef *>(block.data()),
                     block.size()) != Z_OK ||
          n != size)
        throw InputError("a block of " + of + " can't be unpacked.");
      return bytes;
    }
  } // namespace


  VtuArrays::VtuArrays(const XmlElement &file, std::string appended, const bool is_base64)
    : appended(std::move(appended))
    , is_base64(is_base64)
    , swapped(file.attribute("byte_order") == "BigEndian")
    , packed(!file.attribute("compressor").empty())
    , wide_header(file.attribute("header_type") == "UInt64")
  {
    const std::string compressor = file.attribute("compressor");
    if (packed && compressor != "vtkZLibDataCompressor")
      throw InputError("its arrays are packed by " + compressor +
                       "; those of vtkZLibDataCompressor alone, and unpacked ones, are read. Save "
                       "it anew (in ParaView: Save Data, Compressor Type ZLib).");
  }


  std::vector<double>
  VtuArrays::values(const XmlElement &array) const
  {
    const std::string format = array.attribute("format");
    if (format == "ascii")
      return written_numbers(array);
    const bool is_appended = format == "appended";
    if (!is_appended && format != "binary")
      throw InputError(name_of(array) + " has the unknown format '" + format + "'.");
    const std::size_t begin =
      is_appended ? std::strtoul(array.attribute("offset").c_str(), nullptr, 10) : 0;
    Bytes bytes(is_appended ? appended : array.text,
                begin,
                !is_appended || is_base64,
                name_of(array));
    const auto size = [&]() -> std::size_t {
      if (wide_header)
        return packed_number<std::uint64_t>(bytes.take(8).data(), swapped);
      return packed_number<std::uint32_t>(bytes.take(4).data(), swapped);
    };
    if (!packed)
      return numbers_of(bytes.take(size()), array, swapped);

    const std::size_t n_blocks = size(), block_size = size(), last_size = size();
    std::vector<std::size_t> packed_sizes;
    for (std::size_t b = 0; b < n_blocks; ++b)
      packed_sizes.push_back(size());
    std::string content;
    for (std::size_t b = 0; b < n_blocks; ++b)
      content += unpacked(bytes.take(packed_sizes[b]),
                          b + 1 == n_blocks && last_size > 0 ? last_size : block_size,
                          name_of(array));
    return numbers_of(content, array, swapped);
  }
} // namespace Supple
